// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "scene/ImageGrid.h"

#include <cmath>

namespace limpid
{
namespace
{
/// Tolerance of rounding in double precision, which results of NearestOrthonormal satisfy.
constexpr double noRounding = 1e-12;

/// Returns the orthonormal matrix nearest to one that is almost orthonormal: the factor U of the
/// polar decomposition M = U P, by Newton's iteration M <- (M + M^-T) / 2. Every step squares the
/// distance: three steps take it from 2e-3 to below 1e-20.
Mat3 NearestOrthonormal(Mat3 matrix)
{
  for (int step = 0; step < 3; ++step)
  {
    matrix = 0.5 * (matrix + glm::transpose(glm::inverse(matrix)));
  }
  return matrix;
}
}

double DistanceFromOrthonormal(const Mat3& matrix)
{
  const Mat3 product = glm::transpose(matrix) * matrix;
  double distance = 0;
  for (int column = 0; column < 3; ++column)
  {
    for (int row = 0; row < 3; ++row)
    {
      const double entry = std::abs(product[column][row] - (column == row ? 1.0 : 0.0));
      distance = std::isnan(distance) || entry <= distance ? distance : entry; // keeps NaN
    }
  }
  return distance;
}

Grid ImageGrid(const Int3& nodes, const Vec3& origin, const Vec3& spacing, const Mat3& direction)
{
  Grid grid{ nodes, origin, spacing, direction };
  const double distance = DistanceFromOrthonormal(direction);
  if (distance > noRounding && distance <= mostRounding)
  {
    grid.direction = NearestOrthonormal(direction);
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    if (spacing[axis] < 0)
    {
      grid.spacing[axis] = -spacing[axis];
      grid.direction[axis] = -grid.direction[axis];
    }
  }
  grid.Require();
  return grid;
}
}
