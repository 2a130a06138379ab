// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/SumRays.h"

#include "backend/Backend.h"

namespace limpid
{
void AddRays(const FaceFrustum& frustum, const Range<int>& rows, const float* values, ExactSum& sum)
{
  constexpr Index rowsPerTask = 16;
  constexpr int guard = 1; // guard rays on either side represent no part of the box, see
                           // FaceFrustum
  const float* columnShare = frustum.Row(frustum.columnShare);
  std::vector<double> sums(std::size_t(rows.Length()));
  ParallelFor(rows.Length(), rowsPerTask,
    [&](Index index)
    {
      const int row = rows.begin + static_cast<int>(index);
      const float* length = frustum.OfRow(frustum.length, row);
      const Range<int> columns =
        Intersection(frustum.ColumnsOf(row), { guard, frustum.columns - guard });
      const float* here = values + frustum.RayAt(0, row);
      double part = 0;
      for (int column = columns.begin; column < columns.end; ++column)
      {
        part += columnShare[column] / double(length[column]) * here[column];
      }
      const bool counts = row >= guard && row < frustum.rows - guard;
      sums[std::size_t(index)] = counts ? part * frustum.Row(frustum.rowShare)[row] : 0.0;
    });
  for (const double row : sums)
  {
    sum.Add(row);
  }
}
}
