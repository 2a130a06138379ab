// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_OccupiedRays_h
#define limpid_sweep_OccupiedRays_h

#include "scene/Occupancy.h"
#include "sweep/ColumnSpans.h"
#include "sweep/PlanOutline.h"

#include <memory>
#include <vector>

namespace limpid
{
/**
 * For every slice and row of rays near it: the columns of rays that are interpolated from filled or
 * important voxels of the slice. Also includes rays that touch such voxels anywhere in
 * the two layers next to the slice, where no ray moves by more than one voxel.
 */
class OccupiedRays
{
public:
  OccupiedRays(const PlannedFrustum& frustum, const Occupancy& occupancy);

  ColumnSpans Filled(int slice) const { return this->All().Filled(this->Plan, slice); }
  ColumnSpans Important(int slice) const { return this->All().Important(this->Plan, slice); }

private:
  struct Memory;

  TouchingRays All() const { return { this->Spans.get(), this->Plan.activeRays.rowLength }; }

  void FindOnSlice(
    const PlannedFrustum& frustum, const Occupancy& occupancy, int slice, Memory& memory);

  const PlannedFrustum& Plan;
  std::unique_ptr<int[]> Spans; ///< see TouchingRays
};
}

#endif
