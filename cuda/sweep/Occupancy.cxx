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

/// Extends the spans of the columns by row `y`. Returns the number of filled voxels in the row.
LIMPID_MULTIVERSION
int MarkColumns(const float* __restrict extinction, const float* __restrict importance, int count,
  int y, const ColumnEnds& ends)
{
  int* __restrict filledBegin = ends.filledBegin;
  int* __restrict filledEnd = ends.filledEnd;
  int* __restrict importantBegin = ends.importantBegin;
  int* __restrict importantEnd = ends.importantEnd;
  int sum = 0;
  for (int x = 0; x < count; ++x)
  {
    const bool important = importance[x] > 0;
    const bool filled = important | (extinction[x] > 0);
    // An end of 0 means that the span has not begun.
    filledBegin[x] = filled & (filledEnd[x] == 0) ? y : filledBegin[x];
    filledEnd[x] = filled ? y + 1 : filledEnd[x];
    importantBegin[x] = important & (importantEnd[x] == 0) ? y : importantBegin[x];
    importantEnd[x] = important ? y + 1 : importantEnd[x];
    sum += filled ? 1 : 0;
  }
  return sum;
}

/// From the first to the last index that is marked.
template <class Marked>
Interval SpanOf(int count, const Marked& marked)
{
  int begin = 0;
  while (begin < count && !marked(begin))
  {
    ++begin;
  }
  int end = count;
  while (end > begin && !marked(end - 1))
  {
    --end;
  }
  return begin < end ? Interval{ begin, end } : Interval{};
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
        filled[std::size_t(z)] += MarkColumns(extinctionRow, importanceRow, nx, y, columns);
        Spans& row = this->AlongX[std::size_t(z) * ny + y];
        row.filled =
          SpanOf(nx, [=](int x) { return extinctionRow[x] > 0 || importanceRow[x] > 0; });
        row.important = SpanOf(nx, [=](int x) { return importanceRow[x] > 0; });
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
