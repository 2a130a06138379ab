// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_OccupiedRays_h
#define limpid_sweep_OccupiedRays_h

#include "sweep/PlanSweep.h"

#include <memory>
#include <vector>

namespace limpid
{
/// An empty span of columns begins here and ends at minus this, so that hulls are minima of begins
/// and maxima of ends.
constexpr int noColumn = 1 << 29;

/// Spans of columns of rays, one per row of rays: first columns, and those behind the last ones.
struct ColumnSpans
{
  int* begins;
  int* ends;
};

/**
 * For every slice and row of rays of a frustum: the columns of rays that are interpolated from
 * filled or from important voxels of the slice, or that touch such voxels anywhere in the layers
 * on both sides of it, where no ray moves by more than one voxel.
 */
class OccupiedRays
{
public:
  OccupiedRays(const PlannedFrustum& frustum, const Occupancy& occupancy);

  ColumnSpans Filled(int slice) const { return this->At(4 * Index(slice)); }
  ColumnSpans Important(int slice) const { return this->At(4 * Index(slice) + 2); }

private:
  struct Memory;

  ColumnSpans At(Index row) const
  {
    int* first = this->Spans.get() + row * this->Rows;
    return { first, first + this->Rows };
  }

  void FindOnSlice(
    const PlannedFrustum& frustum, const Occupancy& occupancy, int slice, Memory& memory);

  Index Rows;
  std::unique_ptr<int[]> Spans; ///< [slice][begin and end of filled, of important][row]
};
}

#endif
