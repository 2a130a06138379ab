// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_PlanSweep_h
#define limpid_sweep_PlanSweep_h

#include "scene/Occupancy.h"
#include "sweep/PlanOutline.h"

#include <vector>

namespace limpid
{
/// Returns the frusta that cover a grid as seen from a source; none if the grid has no volume.
std::vector<PlannedFrustum> PlanSweep(const Grid& grid, const Occupancy& occupancy,
  const RaySource& source, const PlanSettings& settings);

/// Fills the tables of which OutlineSweep has made the outline.
void FillPlan(PlannedFrustum& frustum, const Occupancy& occupancy);

/// Computes, for each of some sources of a map and one past the last, the first target whose first
/// source is this one or a later one.
void FindFirstTargets(const int* index, int targets, const Range<int>& sources, int* first);
}

#endif
