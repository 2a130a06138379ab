// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_SlidingRows_h
#define limpid_backend_SlidingRows_h

#include "backend/Backend.h"
#include "math/Range.h"

#include <algorithm>

namespace limpid
{
/// Where the window below keeps what belongs to row `y` >= -1: three rows are there at a time.
inline int PlaceOfRow(int y)
{
  return (y + 3) % 3;
}

/**
 * Visits all rows of some slices of a grid in parallel, with what was made of the rows beside them.
 * A slice is visited in runs of rows: makeWindow(slice) begins one, window.Enter(y) makes what
 * belongs to row `y`, which may lie one beyond the grid, and window.Visit(y) visits a row when it
 * and those beside it were entered last.
 */
template <class MakeWindow>
void ForSlidingRows(int rows, const Range<int>& slices, const MakeWindow& makeWindow)
{
  constexpr int rowsPerRun = 32;
  const Index runs = (rows + rowsPerRun - 1) / rowsPerRun; // of a slice
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
