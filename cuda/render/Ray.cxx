// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/Ray.h"

namespace limpid
{
RayMaker::RayMaker(const Grid& grid, double stepLength, const View& view)
  : Direction(grid.direction)
  , Spacing(grid.spacing)
  , Origin(grid.origin)
  , Centre(grid.Centre())
  , LastNode(grid.nodes - 1)
  , Radius(grid.Radius())
  , StepLength(stepLength)
  , Width(view.width)
  , Height(view.height)
  , Jitter(view.jitter)
{
  glm::dmat4 worldToIndex(1.0);
  const Mat3 turn = glm::transpose(grid.direction);
  for (int column = 0; column < 3; ++column)
  {
    worldToIndex[column] = glm::dvec4(turn[column] / grid.spacing, 0.0);
  }
  worldToIndex[3] = glm::dvec4(grid.PointToIndex(Vec3(0.0)), 1.0);
  this->ClipToIndex = worldToIndex * view.clipToWorld;
}
}
