// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Neighbourhood_h
#define limpid_optimize_Neighbourhood_h

#include "distributed/Communicator.h"
#include "scene/FieldView.h"
#include "scene/Grid.h"
#include "scene/NodeValues.h"

#include <vector>

namespace limpid
{
/// A rank's box of nodes plus one layer of ghost nodes, as a grid of its own. Operations that
/// depend on neighbours give the same values at the nodes of the box as on the whole grid.
class Neighbourhood
{
public:
  /// `boxes`: boxes of all ranks, which may overlap; `owned`: disjoint boxes, see ScenePiece.
  /// `ranks` must outlive this object.
  Neighbourhood(const Communicator& ranks, const Grid& grid, const std::vector<NodeBox>& boxes,
    const std::vector<NodeBox>& owned);

  const Grid& Around() const { return this->Nodes; }
  bool Empty() const { return this->Box.Empty(); }

  /// Returns a field of the box, extended by ghost values. Collective.
  NodeValues Extended(const float* field) const;

  /// Returns the part of an extended field inside the box.
  NodeValues Inside(const float* field) const;

private:
  const Communicator* All;
  Grid Nodes;
  NodeBox Own;
  NodeBox Box; ///< with the ghost nodes
  std::vector<NodeBox> Owned;
  std::vector<NodeBox> Wanted; ///< [rank]: boxes with the ghost nodes
};
}

#endif
