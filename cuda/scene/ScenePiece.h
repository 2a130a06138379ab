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
/// What a rank has of a scene that several ranks share.
struct ScenePiece
{
  std::shared_ptr<const Communicator> ranks;
  NodeBox nodes;                ///< may be empty
  std::vector<NodeBox> ofRanks; ///< the nodes of all of them, of which no two have any in common

  /// Tells all ranks what they have. Throws limpid::Error on all of them where pieces overlap or
  /// are not within the grid.
  ScenePiece(std::shared_ptr<const Communicator> all, const Grid& grid, const NodeBox& own);
};
}

#endif
