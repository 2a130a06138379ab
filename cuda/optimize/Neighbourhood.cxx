// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Neighbourhood.h"

#include <algorithm>

namespace limpid
{
namespace
{
/// A box with the nodes beside it, as far as the grid goes.
NodeBox WithNeighbours(const NodeBox& box, const Int3& nodes)
{
  NodeBox wide = box;
  for (int axis = 0; axis < 3 && !box.Empty(); ++axis)
  {
    Range<int>& along = wide.along[std::size_t(axis)];
    along = { std::max(along.begin - 1, 0), std::min(along.end + 1, nodes[axis]) };
  }
  return wide;
}
}

Neighbourhood::Neighbourhood(const Communicator& ranks, const Grid& grid,
  const std::vector<NodeBox>& boxes, const std::vector<NodeBox>& owned)
  : All(&ranks)
  , Nodes(grid)
  , Own(boxes[std::size_t(ranks.Rank())])
  , Had(RegionsOf(owned))
{
  for (const NodeBox& box : boxes)
  {
    this->Needed.push_back({ WithNeighbours(box, grid.nodes) });
  }
  this->Box = this->Needed[std::size_t(ranks.Rank())].front();
  this->Nodes.nodes = this->Box.Size();
}

NodeValues Neighbourhood::Extended(const float* field) const
{
  NodeValues values(this->Box.Count());
  Spread(*this->All, FieldView::Part(const_cast<float*>(field), this->Own), this->Had,
    FieldView::Part(values.Data(), this->Box), this->Needed);
  return values;
}

NodeValues Neighbourhood::Inside(const float* field) const
{
  NodeValues values(this->Own.Count());
  CopyNodes(this->Own, FieldView::Part(const_cast<float*>(field), this->Box),
    FieldView::Part(values.Data(), this->Own));
  return values;
}
}
