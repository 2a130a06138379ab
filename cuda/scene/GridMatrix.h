// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_scene_GridMatrix_h
#define limpid_scene_GridMatrix_h

#include "scene/Grid.h"

namespace limpid
{
/// Returns the matrix from homogeneous world coordinates to the index space of a grid.
inline glm::dmat4 WorldToIndex(const Grid& grid)
{
  glm::dmat4 matrix(1.0);
  const Mat3 turn = glm::transpose(grid.direction);
  for (int column = 0; column < 3; ++column)
  {
    matrix[column] = glm::dvec4(turn[column] / grid.spacing, 0.0);
  }
  matrix[3] = glm::dvec4(grid.PointToIndex(Vec3(0.0)), 1.0);
  return matrix;
}
}

#endif
