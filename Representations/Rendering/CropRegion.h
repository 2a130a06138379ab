// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_CropRegion_h
#define limpid_CropRegion_h

#include "scene/Grid.h"

#include <array>
#include <vector>

namespace limpid
{
/// The part of space that is not cropped, in data coordinates.
struct CropRegion
{
  /// Half-spaces: a point is inside if dot(plane, (x, y, z, 1)) >= 0. They cut the rays of
  /// pictures.
  std::vector<glm::dvec4> planes;

  /// Two planes across each axis divide space into 27 regions, x fastest, as in vtkVolumeMapper.
  /// The flags have one bit per region, set if it is kept. Points outside become empty.
  bool hasRegions = false;
  std::array<double, 6> limits{ {} };
  int regions = 0;

  bool IsEverything() const { return this->planes.empty() && !this->hasRegions; }

  /// Returns whether a point is inside the regions and the half-spaces, whose planes are first
  /// moved outward by `reach` [edges of the grid's cells].
  bool Contains(const Grid& grid, const Vec3& index, double reach) const;

  bool operator==(const CropRegion& other) const;
};
}

#endif
