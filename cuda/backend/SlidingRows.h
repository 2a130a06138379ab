// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_SlidingRows_h
#define limpid_backend_SlidingRows_h

#include "backend/Backend.h"
#include "math/Range.h"

#include <algorithm>

namespace limpid
{
/// Index in the sliding window for row `y` >= -1; the window holds three rows.
inline int PlaceOfRow(int y)
{
  return (y + 3) % 3;
}

/**
 * Visits all rows of some slices of a grid in parallel, with data computed from neighbouring rows.
 * A slice is visited in runs of rows: makeWindow(slice) starts a run and window.Enter(y) computes
 * the data of row `y`, which may be one row outside of the grid. window.Visit(y) visits a row
 * after it and its neighbours have been entered.
 */
template <class MakeWindow>
void ForSlidingRows(int rows, const Range<int>& slices, const MakeWindow& makeWindow)
{
  constexpr int rowsPerRun = 32;
  const Index runs = (rows + rowsPerRun - 1) / rowsPerRun; // runs per slice
  ParallelFor(runs * slices.Length(),
    [&](Index run)
    {
      const int begin = static_cast<int>(run % runs) * rowsPerRun;
      const int end = std::min(begin + rowsPerRun, rows);
      auto window = makeWindow(slices.begin + static_cast<int>(run / runs));
      window.Enter(begin - 1);
      window.Enter(begin);
      for (int y = begin; y < end; ++y)
      {
        window.Enter(y + 1);
        window.Visit(y);
      }
    });
}
}

#endif
