// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Neighbourhood.h"

#include "distributed/ExchangePlan.h"

namespace limpid
{
Neighbourhood::Neighbourhood(const Communicator& ranks, const Grid& grid,
  const std::vector<NodeBox>& boxes, const std::vector<NodeBox>& owned)
  : All(&ranks)
  , Nodes(grid)
  , Own(boxes[std::size_t(ranks.Rank())])
  , Owned(owned)
  , Wanted(WithGhosts(boxes, 1, grid.nodes))
{
  this->Box = this->Wanted[std::size_t(ranks.Rank())];
  this->Nodes.nodes = this->Box.Size();
}

NodeValues Neighbourhood::Extended(const float* field) const
{
  return FieldIn(*this->All, this->Own, this->Owned, this->Wanted, field);
}

NodeValues Neighbourhood::Inside(const float* field) const
{
  NodeValues values(this->Own.Count());
  CopyNodes(this->Own, FieldView::Part(const_cast<float*>(field), this->Box),
    FieldView::Part(values.Data(), this->Own));
  return values;
}
}
