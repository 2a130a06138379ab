// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_viewpoint_DirectionMesh_h
#define limpid_viewpoint_DirectionMesh_h

#include "math/Vec.h"

#include <array>
#include <vector>

namespace limpid
{
/// Directions of unit length all over a sphere, no two the same, and the triangles between them.
struct DirectionMesh
{
  std::vector<Vec3> directions;
  std::vector<std::array<int, 3>> triangles;

  /// The values at directions, linear within triangles; in any direction of unit length.
  double At(const std::vector<double>& values, const Vec3& direction) const;

  /// Numbers of the directions that share a triangle with each.
  std::vector<std::vector<int>> Neighbours() const;
};
}

#endif
