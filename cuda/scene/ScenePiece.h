// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_scene_ScenePiece_h
#define limpid_scene_ScenePiece_h

#include "backend/Communicator.h"
#include "scene/Grid.h"
#include "scene/NodeBox.h"

#include <memory>
#include <vector>

namespace limpid
{
/// Where ranks have fields that the rays of several sources go through.
enum class FieldPlaces
{
  Chosen,          ///< the first of these that takes little more memory than a share
  BesideAllRays,   ///< a rank has the nodes beside its rays of every source
  BesideFirstRays, ///< of the first source; sweeps of others visit these, slices at a time
  InSlabs          ///< it has a slab, and all sweeps visit these: an even share, and the slowest
};

/// What ranks have of a scene that they share: of each a box of nodes, in arrays of these alone,
/// first axis fastest. Boxes may be empty and may overlap; what nobody has is empty.
struct ScenePiece
{
  std::shared_ptr<const Communicator> ranks;
  NodeBox nodes;              ///< of this rank
  std::vector<NodeBox> boxes; ///< of all ranks

  /// Whose values count where boxes overlap: parts of them of which no two have a node in common.
  /// Where they overlap by layers, each counts to the middle of these.
  std::vector<NodeBox> owned;

  FieldPlaces places = FieldPlaces::Chosen; ///< the same on all ranks

  /// Tells all ranks what they have. Throws JointError on all of them where a box is not within the
  /// grid, or boxes overlap so that no parts of them are boxes.
  ScenePiece(std::shared_ptr<const Communicator> all, const Grid& grid, const NodeBox& own);
};

/// Pieces of the nodes that ranks own and so many more on every side, as far as the grid goes; a
/// rank that owns none has two nodes along each axis for its own use.
std::shared_ptr<const ScenePiece> Grown(const ScenePiece& piece, const Grid& grid, int nodes);

/// The grid of a box of nodes, and of a rank's.
Grid GridOf(const NodeBox& box, const Grid& whole);
Grid GridOf(const ScenePiece& piece, const Grid& whole);

/// Whether every rank has the same box in both; nulls, where one has all, are the same.
bool HaveSameBoxes(const ScenePiece* one, const ScenePiece* other);
}

#endif
