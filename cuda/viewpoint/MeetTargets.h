// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_viewpoint_MeetTargets_h
#define limpid_viewpoint_MeetTargets_h

#include "optimize/Solver.h"

#include <memory>
#include <string>
#include <vector>

namespace limpid
{
/// A scene whose importance is that of structures.
struct LabelledScene
{
  SceneFields fields;
  float* importance; ///< fields.importance, which is replaced
  const Structures& structures;
  const StructureRow* rows; ///< row of the structure of each node
};

/// What a search for targets has found.
struct TargetsFound
{
  Structures structures;               ///< with the importances that were found
  std::vector<StructureShares> shares; ///< of all structures; empty if they are not known
  std::string text;                    ///< see TextOfTargets
  std::string warning;                 ///< about targets that are not met; may be empty
  int runs = 1;                        ///< that were made, with the first
};

/**
 * Optimises again with other importances until all structures are visible as much as their targets
 * ask, or no further run helps, see TargetSearch. Method::Optimized only. For targets that are
 * refused, it says from where most of the structure could be seen.
 *
 * `solver`: the result with the importances given; becomes that with the importances found, which
 * are then those of the scene. `previous`: as in Solver, for the further runs. `progress` is used
 * as in Solver::Run, for all further runs together. Collective.
 */
TargetsFound MeetTargets(const LabelledScene& scene, const CarriedChange& previous,
  const Progress& progress, std::unique_ptr<Solver>& solver);
}

#endif
