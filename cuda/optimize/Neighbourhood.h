// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Neighbourhood_h
#define limpid_optimize_Neighbourhood_h

#include "scene/Grid.h"
#include "scene/NodeValues.h"
#include "sweep/RankRegions.h"

#include <vector>

namespace limpid
{
/// A rank's box of nodes with the nodes beside it, whose values other ranks have: a grid of its
/// own, on which what depends on neighbours is found for the nodes of the box as it is on the
/// whole.
class Neighbourhood
{
public:
  /// `boxes`: of all ranks; `owned`: whose values count where they overlap, see ScenePiece. The
  /// ranks have to stay.
  Neighbourhood(const Communicator& ranks, const Grid& grid, const std::vector<NodeBox>& boxes,
    const std::vector<NodeBox>& owned);

  const Grid& Around() const { return this->Nodes; }
  bool Empty() const { return this->Box.Empty(); }

  /// A field of the box, with what is beside it. All ranks have to ask.
  NodeValues Extended(const float* field) const;

  /// The box of a field of that grid.
  NodeValues Inside(const float* field) const;

private:
  const Communicator* All;
  Grid Nodes;
  NodeBox Own;
  NodeBox Box; ///< with the nodes beside it
  std::vector<Region> Had;
  std::vector<Region> Needed;
};
}

#endif
