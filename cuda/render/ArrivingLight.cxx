// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/ArrivingLight.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
double LargestOf(const Vec3& spacing)
{
  return std::max({ spacing.x, spacing.y, spacing.z });
}
}

ArrivingNode ArrivingOn(const Grid& grid, const Vec3& cell, const RaySource& light)
{
  ArrivingNode body{};
  body.cells = CellGrid(grid.nodes);
  body.size = body.nodes = grid.nodes;
  body.parallel = light.parallel;
  body.origin = light.origin;
  body.direction = light.direction;
  body.spacing = grid.spacing;
  body.surfaceLength = surfaceCells * LargestOf(grid.spacing);
  body.ownLength = std::max(ownCells * LargestOf(cell), body.surfaceLength);
  body.mostGiven = float(std::exp(mostOwnDepth));
  return body;
}

int ArrivingNode::LayersRead() const
{
  const Vec3& cell = this->spacing;
  const double layers = std::ceil(this->ownLength / std::min({ cell.x, cell.y, cell.z })) + 1;
  const int most = std::max({ this->nodes.x, this->nodes.y, this->nodes.z });
  return static_cast<int>(std::min(layers, double(most)));
}
}
