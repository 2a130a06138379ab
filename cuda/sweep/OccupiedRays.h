// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_OccupiedRays_h
#define limpid_sweep_OccupiedRays_h

#include "sweep/PlanSweep.h"

#include <memory>
#include <vector>

namespace limpid
{
/// An empty span of columns begins at this value and ends at its negative. The hull of spans is
/// then the minimum of the begins and the maximum of the ends.
constexpr int noColumn = 1 << 29;

/// Spans of columns, one per row of rays: first columns, and one past the last columns.
struct ColumnSpans
{
  int* begins;
  int* ends;
};

/**
 * For every slice and row of rays near it: the columns of rays that are interpolated from filled or
 * important voxels of the slice. Also includes rays that touch such voxels anywhere in
 * the two layers next to the slice, where no ray moves by more than one voxel.
 */
class OccupiedRays
{
public:
  OccupiedRays(const PlannedFrustum& frustum, const Occupancy& occupancy);

  ColumnSpans Filled(int slice) const { return this->At(slice, 0); }
  ColumnSpans Important(int slice) const { return this->At(slice, 2); }

private:
  struct Memory;

  /// Spans by row, of which the slice describes some.
  ColumnSpans At(int slice, int kind) const
  {
    int* first = this->Spans.get() + (4 * Index(slice) + kind) * this->Rows -
      this->Plan.SliceAt(slice).rayRows.begin;
    return { first, first + this->Rows };
  }

  void FindOnSlice(
    const PlannedFrustum& frustum, const Occupancy& occupancy, int slice, Memory& memory);

  const PlannedFrustum& Plan;
  Index Rows;                   ///< largest number of rows that a slice describes
  std::unique_ptr<int[]> Spans; ///< [slice][begin and end of filled, of important][row]
};
}

#endif
