// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/Occupancy.h"

#include "backend/Backend.h"
#include "backend/Simd.h"

#include <algorithm>

namespace limpid
{
namespace
{
struct ColumnEnds
{
  int* filledBegin;
  int* filledEnd;
  int* importantBegin;
  int* importantEnd;
};

/// Extends the spans of the columns by row `y`, which is empty but in `span`.
LIMPID_MULTIVERSION
void MarkColumns(const float* __restrict extinction, const float* __restrict importance,
  const Interval& span, int y, const ColumnEnds& ends)
{
  int* __restrict filledBegin = ends.filledBegin;
  int* __restrict filledEnd = ends.filledEnd;
  int* __restrict importantBegin = ends.importantBegin;
  int* __restrict importantEnd = ends.importantEnd;
  const Interval columns = span;
  for (int x = columns.begin; x < columns.end; ++x)
  {
    const bool important = importance[x] > 0;
    const bool filled = important | (extinction[x] > 0);
    // An end of 0 means that the span has not begun.
    filledBegin[x] = filled & (filledEnd[x] == 0) ? y : filledBegin[x];
    filledEnd[x] = filled ? y + 1 : filledEnd[x];
    importantBegin[x] = important & (importantEnd[x] == 0) ? y : importantBegin[x];
    importantEnd[x] = important ? y + 1 : importantEnd[x];
  }
}

/// Where a row of voxels is filled and important, and how many of them are filled.
struct RowContent
{
  Occupancy::Spans spans;
  int filled;
};

LIMPID_MULTIVERSION
RowContent ContentOf(
  const float* __restrict extinction, const float* __restrict importance, int count)
{
  int filledBegin = count;
  int filledLast = -1;
  int importantBegin = count;
  int importantLast = -1;
  int sum = 0;
  for (int x = 0; x < count; ++x)
  {
    const bool important = importance[x] > 0;
    const bool filled = important | (extinction[x] > 0);
    const int firstFilled = filled ? x : count;
    const int lastFilled = filled ? x : -1;
    const int firstImportant = important ? x : count;
    const int lastImportant = important ? x : -1;
    filledBegin = firstFilled < filledBegin ? firstFilled : filledBegin;
    filledLast = lastFilled > filledLast ? lastFilled : filledLast;
    importantBegin = firstImportant < importantBegin ? firstImportant : importantBegin;
    importantLast = lastImportant > importantLast ? lastImportant : importantLast;
    sum += filled ? 1 : 0;
  }
  const Interval filled{ filledBegin, filledLast + 1 };
  const Interval important{ importantBegin, importantLast + 1 };
  return { { filled.Empty() ? Interval{} : filled, important.Empty() ? Interval{} : important },
    sum };
}
}

Occupancy::Occupancy(
  const Grid& grid, const float* baseExtinction, const float* importance, bool skip)
  : Nodes(grid.nodes)
  , Skip(skip)
{
  const int nx = grid.nodes.x;
  const int ny = grid.nodes.y;
  const int nz = grid.nodes.z;
  this->AlongX.resize(std::size_t(ny) * nz);
  this->AlongY.resize(std::size_t(nx) * nz);
  std::vector<Index> filled(std::size_t(nz), 0);
  ParallelFor(nz,
    [&](Index z)
    {
      // Ends of the columns' spans, apart from each other for the sake of vector units.
      std::vector<int> ends(4 * std::size_t(nx), 0);
      const ColumnEnds columns{ ends.data(), ends.data() + nx, ends.data() + 2 * nx,
        ends.data() + 3 * nx };
      for (int y = 0; y < ny; ++y)
      {
        const Index first = (z * ny + y) * nx;
        const float* extinctionRow = baseExtinction + first;
        const float* importanceRow = importance + first;
        const RowContent row = ContentOf(extinctionRow, importanceRow, nx);
        filled[std::size_t(z)] += row.filled;
        this->AlongX[std::size_t(z) * ny + y] = row.spans;
        MarkColumns(extinctionRow, importanceRow, row.spans.filled, y, columns);
      }
      for (int x = 0; x < nx; ++x)
      {
        this->AlongY[std::size_t(z) * nx + x] = { { columns.filledBegin[x], columns.filledEnd[x] },
          { columns.importantBegin[x], columns.importantEnd[x] } };
      }
    });
  if (!skip)
  {
    std::fill(this->AlongX.begin(), this->AlongX.end(), Spans{ { 0, nx }, { 0, nx } });
    std::fill(this->AlongY.begin(), this->AlongY.end(), Spans{ { 0, ny }, { 0, ny } });
  }
  for (const Index count : filled)
  {
    this->Filled += count;
  }
}
}
