// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The columns of rays that touch voxels, row by row and slice by slice.

#ifndef limpid_sweep_ColumnSpans_h
#define limpid_sweep_ColumnSpans_h

#include "sweep/FaceFrustum.h"

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

  LIMPID_HD LIMPID_INLINE Range<int> At(int row) const
  {
    return { this->begins[row], this->ends[row] };
  }

  LIMPID_HD LIMPID_INLINE void Put(int row, const Range<int>& columns) const
  {
    this->begins[row] = columns.begin;
    this->ends[row] = columns.end;
  }
};

/// The columns of rays that touch filled and important voxels on each slice, in the rows that the
/// slice describes (OccupiedRays).
struct TouchingRays
{
  int* values; ///< [slice][begin and end of filled, of important][row]
  Index rows;  ///< largest number of rows that a slice describes

  static Index CountFor(const FaceFrustum& frustum)
  {
    return 4 * Index(frustum.SliceCount()) * frustum.activeRays.rowLength;
  }

  /// The results have an entry per row, also of those that the slice does not describe.
  LIMPID_HD LIMPID_INLINE ColumnSpans Filled(const FaceFrustum& frustum, int s) const
  {
    return this->Of(frustum, s, 0);
  }

  LIMPID_HD LIMPID_INLINE ColumnSpans Important(const FaceFrustum& frustum, int s) const
  {
    return this->Of(frustum, s, 2);
  }

private:
  LIMPID_HD LIMPID_INLINE ColumnSpans Of(const FaceFrustum& frustum, int s, int kind) const
  {
    int* first =
      this->values + (4 * Index(s) + kind) * this->rows - frustum.SliceAt(s).rayRows.begin;
    return { first, first + this->rows };
  }
};

/// The spans of columns of rays that touch the filled and the important voxels of a row of voxels.
/// Ends are stored as negatives, so that minima give the hull of two rows.
struct Reach
{
  int least[4];

  LIMPID_HD LIMPID_INLINE void Include(const Reach& other)
  {
    for (int k = 0; k < 4; ++k)
    {
      this->least[k] = other.least[k] < this->least[k] ? other.least[k] : this->least[k];
    }
  }
};

constexpr Reach outOfReach{ { noColumn, noColumn, noColumn, noColumn } };

/// Returns the rows of voxels that a row of rays touches, at least four: from one before the
/// previous row of rays to two behind the next one. The first and the last row extend to the
/// border, and may go beyond it, where there is nothing. `rows`: number of all rows of rays;
/// `floorOf(row)`: floor of its position; `lastVoxel`: last row of voxels.
template <class FloorOf>
LIMPID_HD LIMPID_INLINE Range<int> RowsTouchedBy(
  int row, int rows, const FloorOf& floorOf, int lastVoxel)
{
  const int from = row > 0 ? floorOf(row - 1) - 1 : 0;
  const int to = row + 1 < rows ? floorOf(row + 1) + 2 : lastVoxel;
  const int low = row > 0 || from < to - 3 ? from : to - 3;
  const int high = row + 1 < rows || to > low + 3 ? to : low + 3;
  return { low, high + 1 };
}
}

#endif
