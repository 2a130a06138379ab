// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_SceneStructures_h
#define limpid_optimize_SceneStructures_h

#include "energy/StructureLedger.h"
#include "optimize/PreparedScene.h"

#include <vector>

namespace limpid
{
/// Sets the importance of `count` nodes to that of their structures. `rows`: see below.
void FillImportance(
  const Structures& structures, const StructureRow* rows, Index count, float* importance);

/// Returns the rows of nodes of another grid over the same box, each that of the nearest node here.
/// `piece`: decomposition of the grid `from`; `rows`: row of the structure of each of its nodes
/// here; `wanted`: decomposition of the grid `to`.
std::vector<StructureRow> RowsOn(const ScenePiece& piece, const Grid& from,
  const StructureRow* rows, const ScenePiece& wanted, const Grid& to);

/// Returns what the cameras of a view see of each structure, as the mean over cameras; with the
/// samples of their scores. `rows`: row of the structure of each node; `extinction`: of the nodes
/// [1/length]. Costs about as much as ten scores, on the processor. Collective.
std::vector<StructureShares> SharesOfStructures(PreparedScene& scene, const Camera& camera,
  const Light& light, const Settings& settings, const Structures& structures,
  const StructureRow* rows, const float* extinction);
}

#endif
