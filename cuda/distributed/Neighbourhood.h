// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_distributed_Neighbourhood_h
#define limpid_distributed_Neighbourhood_h

#include "distributed/ScenePiece.h"
#include "scene/Grid.h"
#include "scene/NodeValues.h"

#include <vector>

namespace limpid
{
/// Values of a field in a box of nodes: copied, or borrowed where the field already has just these.
class FieldInBox
{
public:
  explicit FieldInBox(const float* borrowed)
    : Values(borrowed)
  {
  }
  explicit FieldInBox(NodeValues&& copied)
    : Own(std::move(copied))
    , Values(this->Own.Data())
  {
  }

  const float* Data() const { return this->Values; }

private:
  NodeValues Own;
  const float* Values;
};

/// Returns boxes with so many layers of ghost nodes on every side, clipped to a grid of `nodes`.
std::vector<NodeBox> WithGhosts(const std::vector<NodeBox>& boxes, int layers, const Int3& nodes);

/// Returns the values of a field in other boxes, from the ranks that own them. `field`: has the
/// nodes of the rank's box in `piece`; `wanted`: one box per rank. Collective.
FieldInBox FieldIn(const ScenePiece& piece, const std::vector<NodeBox>& wanted, const float* field);

/// A rank's box of nodes plus layers of ghost nodes, as a grid of its own. Operations that depend
/// on neighbours give the same values at the nodes of the box as on the whole grid.
class Neighbourhood
{
public:
  /// `piece` must outlive this object.
  Neighbourhood(const ScenePiece& piece, const Grid& grid, int layers = 1);

  const Grid& Around() const { return this->Nodes; }
  const NodeBox& Box() const; ///< with the ghost nodes
  bool Empty() const { return this->Nodes.NodeCount() == 0; }

  /// Returns a field of the box, extended by ghost values. Collective.
  FieldInBox Extended(const float* field) const
  {
    return FieldIn(*this->Piece, this->Wanted, field);
  }

  /// Returns the part of an extended field inside the box.
  NodeValues Inside(NodeValues&& field) const;

private:
  const ScenePiece* Piece;
  Grid Nodes;
  std::vector<NodeBox> Wanted; ///< [rank]: boxes with the ghost nodes
};
}

#endif
