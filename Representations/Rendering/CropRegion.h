// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_CropRegion_h
#define limpid_CropRegion_h

#include "scene/Grid.h"

#include <array>
#include <vector>

namespace limpid
{
/// The part of space that is left in, in data coordinates.
struct CropRegion
{
  /// Half-spaces: inside where dot(plane, (x, y, z, 1)) >= 0. They cut the rays of pictures.
  std::vector<glm::dvec4> planes;

  /// Two planes across each axis, which make 27 regions, and a bit for each that is left in, x
  /// fastest, as in vtkVolumeMapper. Points outside are empty.
  bool hasRegions = false;
  std::array<double, 6> limits{ {} };
  int regions = 0;

  bool IsEverything() const { return this->planes.empty() && !this->hasRegions; }

  /// Whether a point is inside of the regions, and of the planes moved outward by `reach`, in
  /// edges of the grid's cells.
  bool Contains(const Grid& grid, const Vec3& index, double reach) const;

  bool operator==(const CropRegion& other) const;
};
}

#endif
