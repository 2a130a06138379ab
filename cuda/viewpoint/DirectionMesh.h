// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_viewpoint_DirectionMesh_h
#define limpid_viewpoint_DirectionMesh_h

#include "math/Vec.h"

#include <array>
#include <vector>

namespace limpid
{
/// Distinct unit vectors all over a sphere, and the triangles between them.
struct DirectionMesh
{
  std::vector<Vec3> directions;
  std::vector<std::array<int, 3>> triangles;

  /// Interpolates the values at directions linearly within triangles, at any unit vector.
  double At(const std::vector<double>& values, const Vec3& direction) const;

  /// Returns, for each direction, the directions that share a triangle with it.
  std::vector<std::vector<int>> Neighbours() const;
};
}

#endif
