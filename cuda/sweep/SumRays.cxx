// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/SumRays.h"

namespace limpid
{
double SumOfRays(const FaceFrustum& frustum, const float* values)
{
  constexpr Index rowsPerTask = 16;
  const float* columnShare = frustum.Row(frustum.columnShare);
  std::vector<double> rows(std::size_t(frustum.rows));
  ParallelFor(frustum.rows, rowsPerTask,
    [&](Index row)
    {
      const float* length = frustum.Row(frustum.length, row);
      const float* here = values + row * frustum.columns;
      double part = 0;
      for (int column = 0; column < frustum.columns; ++column)
      {
        part += columnShare[column] / double(length[column]) * here[column];
      }
      rows[std::size_t(row)] = part * frustum.Row(frustum.rowShare)[row];
    });
  return frustum.cellMeasure * std::accumulate(rows.begin(), rows.end(), 0.0);
}
}
