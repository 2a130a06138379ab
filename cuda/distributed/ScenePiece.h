// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_distributed_ScenePiece_h
#define limpid_distributed_ScenePiece_h

#include "distributed/Communicator.h"
#include "scene/Grid.h"
#include "scene/NodeBox.h"

#include <memory>
#include <vector>

namespace limpid
{
/// The nodes whose field values a rank keeps, given that the rays of several sources need them.
enum class FieldPlaces
{
  Chosen,          ///< the first of these that needs little more memory than an even share
  BesideAllRays,   ///< the nodes beside its rays of every source
  BesideFirstRays, ///< those of the first source; for sweeps of others, slices are sent when needed
  InSlabs          ///< one slab per rank, sent for all sweeps: an even share, and the slowest
};

/// The decomposition of a scene: one box of nodes per rank. Arrays of a rank have only the nodes of
/// its box, first axis fastest. Boxes may be empty and may overlap; nodes in no box are empty.
struct ScenePiece
{
  std::shared_ptr<const Communicator> ranks;
  NodeBox nodes;              ///< box of this rank
  std::vector<NodeBox> boxes; ///< boxes of all ranks

  /// The nodes that each rank owns, as disjoint parts of the boxes. Where boxes overlap by layers,
  /// each rank owns half of the layers.
  std::vector<NodeBox> owned;

  FieldPlaces places = FieldPlaces::Chosen; ///< equal on all ranks

  /// The decomposition of a process that works alone: it has all nodes.
  static std::shared_ptr<const ScenePiece> Whole(const Grid& grid);

  /// One slab per rank, see EvenSlabs.
  static ScenePiece Slabs(std::shared_ptr<const Communicator> among, const Grid& grid);

  /// Broadcasts the boxes. Throws JointError on all ranks if a box is not within the grid, or if
  /// boxes overlap such that owned parts cannot be boxes.
  ScenePiece(std::shared_ptr<const Communicator> among, const Grid& grid, const NodeBox& own);

  /// The nodes that this rank owns.
  const NodeBox& Owned() const { return this->owned[std::size_t(this->ranks->Rank())]; }

  /// Returns the maximum over all ranks of a non-negative number. Collective.
  float LargestOf(float here) const { return this->ranks->LargestOf(here); }

  /// Whether this process works alone and has all nodes of the grid.
  bool IsWhole() const { return this->ranks->IsAlone() && this->nodes == this->all; }

private:
  ScenePiece() = default;

  NodeBox all; ///< of the grid
};

/// Returns a decomposition, or that of a process that works alone for null.
inline std::shared_ptr<const ScenePiece> OrWhole(
  const std::shared_ptr<const ScenePiece>& piece, const Grid& grid)
{
  return piece ? piece : ScenePiece::Whole(grid);
}

/// Returns pieces of the owned nodes plus this number of ghost nodes on every side, clipped to the
/// grid. A rank that owns nothing gets two nodes along each axis for its own use.
std::shared_ptr<const ScenePiece> Grown(const ScenePiece& piece, const Grid& grid, int nodes);

/// Returns the decomposition of another grid over the same box: every rank has the nodes that lie
/// in what it owns of `piece`. Collective.
std::shared_ptr<const ScenePiece> PieceOn(
  const ScenePiece& piece, const Grid& from, const Grid& to);

/// Return the grid of a box of nodes, and of this rank's box.
Grid GridOf(const NodeBox& box, const Grid& whole);
Grid GridOf(const ScenePiece& piece, const Grid& whole);

/// Returns whether every rank has the same box in both. Null, which means one rank with everything,
/// equals null.
bool HaveSameBoxes(const ScenePiece* one, const ScenePiece* other);
}

#endif
