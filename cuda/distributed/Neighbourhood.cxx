// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "distributed/Neighbourhood.h"

#include "distributed/ExchangePlan.h"

#include <utility>

namespace limpid
{
std::vector<NodeBox> WithGhosts(const std::vector<NodeBox>& boxes, int layers, const Int3& nodes)
{
  std::vector<NodeBox> grown;
  grown.reserve(boxes.size());
  for (const NodeBox& box : boxes)
  {
    grown.push_back(box.Grown(layers, nodes));
  }
  return grown;
}

FieldInBox FieldIn(const ScenePiece& piece, const std::vector<NodeBox>& wanted, const float* field)
{
  const NodeBox& box = wanted[std::size_t(piece.ranks->Rank())];
  if (piece.ranks->IsAlone() && box == piece.nodes)
  {
    return FieldInBox(field);
  }
  NodeValues values(box.Count());
  Spread(*piece.ranks, FieldView::Part(const_cast<float*>(field), piece.nodes),
    RegionsOf(piece.owned), FieldView::Part(values.Data(), box), RegionsOf(wanted));
  return FieldInBox(std::move(values));
}

Neighbourhood::Neighbourhood(const ScenePiece& piece, const Grid& grid, int layers)
  : Piece(&piece)
  , Nodes(grid)
  , Wanted(WithGhosts(piece.boxes, layers, grid.nodes))
{
  this->Nodes.nodes = this->Box().Size();
}

const NodeBox& Neighbourhood::Box() const
{
  return this->Wanted[std::size_t(this->Piece->ranks->Rank())];
}

NodeValues Neighbourhood::Inside(NodeValues&& field) const
{
  const NodeBox& own = this->Piece->nodes;
  const NodeBox& extended = this->Box();
  if (own == extended)
  {
    return std::move(field);
  }
  NodeValues values(own.Count());
  CopyNodes(own, FieldView::Part(field.Data(), extended), FieldView::Part(values.Data(), own));
  return values;
}
}
