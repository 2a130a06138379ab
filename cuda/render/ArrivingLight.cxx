// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/ArrivingLight.h"

#include "distributed/ExchangePlan.h"

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

/// Returns the boxes of all ranks with the nodes around them.
std::vector<NodeBox> BoxesAround(const ScenePiece& piece, const Grid& whole, double length)
{
  const Vec3& spacing = whole.spacing;
  const double cells = std::ceil(length / std::min({ spacing.x, spacing.y, spacing.z })) + 1;
  const int most = std::max({ whole.nodes.x, whole.nodes.y, whole.nodes.z });
  std::vector<NodeBox> boxes;
  for (const NodeBox& box : piece.boxes)
  {
    boxes.push_back(box.Grown(static_cast<int>(std::min(cells, double(most))), whole.nodes));
  }
  return boxes;
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

FieldAround::FieldAround(
  const ScenePiece& piece, const Grid& whole, const ArrivingNode& body, const float* field)
{
  const std::vector<NodeBox> boxes = BoxesAround(piece, whole, body.ownLength);
  this->box = boxes[std::size_t(piece.ranks->Rank())];
  this->values.resize(std::size_t(this->box.Count()));
  Spread(*piece.ranks, FieldView::Part(const_cast<float*>(field), piece.nodes),
    RegionsOf(piece.owned), FieldView::Part(this->values.data(), this->box), RegionsOf(boxes));
}
}
