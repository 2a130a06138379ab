// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/Occupancy.h"

#include "backend/Backend.h"
#include "backend/Communicator.h"
#include "backend/Simd.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

namespace limpid
{
namespace
{
/// Ends of the spans of each column of a slice.
struct ColumnSpanEnds
{
  int* filledBegin;
  int* filledEnd;
  int* importantBegin;
  int* importantEnd;
};

/// Extends the spans of the columns by row `y`, which is empty outside `span`.
LIMPID_MULTIVERSION
void MarkColumns(const float* __restrict extinction, const float* __restrict importance,
  const Range<int>& span, int y, const ColumnSpanEnds& ends)
{
  int* __restrict filledBegin = ends.filledBegin;
  int* __restrict filledEnd = ends.filledEnd;
  int* __restrict importantBegin = ends.importantBegin;
  int* __restrict importantEnd = ends.importantEnd;
  const Range<int> columns = span;
  for (int x = columns.begin; x < columns.end; ++x)
  {
    const bool important = importance[x] > 0;
    const bool filled = important | (extinction[x] > 0);
    // An end of 0 means that the span has not started.
    filledBegin[x] = (filled & (filledEnd[x] == 0)) ? y : filledBegin[x];
    filledEnd[x] = filled ? y + 1 : filledEnd[x];
    importantBegin[x] = (important & (importantEnd[x] == 0)) ? y : importantBegin[x];
    importantEnd[x] = important ? y + 1 : importantEnd[x];
  }
}

/// The filled and important ranges of a row of voxels, and the number of filled voxels.
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
  const Range<int> filled{ filledBegin, filledLast + 1 };
  const Range<int> important{ importantBegin, importantLast + 1 };
  return { { filled.Empty() ? Range<int>{} : filled, important.Empty() ? Range<int>{} : important },
    sum };
}
}

Occupancy::Occupancy(const Grid& grid)
  : Nodes(grid.nodes)
  , AlongX(std::size_t(grid.nodes.y) * std::size_t(grid.nodes.z))
  , AlongY(std::size_t(grid.nodes.x) * std::size_t(grid.nodes.z))
{
}

Occupancy::Occupancy(
  const Grid& grid, const float* baseExtinction, const float* importance, bool skip)
  : Occupancy(grid)
{
  OccupancyBuilder builder(grid);
  const Index slice = Index(grid.nodes.x) * grid.nodes.y;
  ParallelFor(grid.nodes.z,
    [&](Index z)
    {
      builder.Add(static_cast<int>(z), { 0, grid.nodes.y }, baseExtinction + z * slice,
        importance + z * slice);
    });
  *this = builder.Take(skip);
}

Occupancy::Occupancy(const Communicator& ranks, const Grid& grid, const NodeBox& box,
  const float* baseExtinction, const float* importance, bool skip)
  : Occupancy(grid)
{
  this->Skip = skip;
  std::int64_t filled = 0;
  const std::array<Range<int>, 3>& nodes = box.along;
  // Spans are stored as begins and negative ends, so that minima give the hull; initially empty.
  constexpr std::int32_t none = std::numeric_limits<std::int32_t>::max();
  const std::size_t rows = this->AlongX.size() + this->AlongY.size();
  std::vector<std::int32_t> ends(4 * rows, none);
  const auto put = [&ends](std::size_t row, const Spans& spans, int offset)
  {
    const Range<int> both[2] = { spans.filled, spans.important };
    for (std::size_t i = 0; i < 2; ++i)
    {
      if (!both[i].Empty())
      {
        ends[4 * row + 2 * i] = both[i].begin + offset;
        ends[4 * row + 2 * i + 1] = -(both[i].end + offset);
      }
    }
  };
  if (!box.Empty())
  {
    Grid part = grid;
    part.nodes = box.Size();
    const Occupancy here(part, baseExtinction, importance, true);
    filled = here.Filled;
    for (int k = nodes[2].begin; k < nodes[2].end; ++k)
    {
      for (int j = nodes[1].begin; j < nodes[1].end; ++j)
      {
        put(std::size_t(k) * this->Nodes.y + j, here.Row(0, j - nodes[1].begin, k - nodes[2].begin),
          nodes[0].begin);
      }
      for (int i = nodes[0].begin; i < nodes[0].end; ++i)
      {
        put(this->AlongX.size() + std::size_t(k) * this->Nodes.x + i,
          here.Row(1, i - nodes[0].begin, k - nodes[2].begin), nodes[1].begin);
      }
    }
  }
  ranks.TakeLeast(ends.data(), ends.size());
  ranks.Sum(&filled, 1);
  this->Filled = filled;
  const auto spanOf = [&ends](std::size_t at) {
    return ends[at] == none ? Range<int>{} : Range<int>{ ends[at], -ends[at + 1] };
  };
  for (std::size_t row = 0; row < rows; ++row)
  {
    Spans& spans =
      row < this->AlongX.size() ? this->AlongX[row] : this->AlongY[row - this->AlongX.size()];
    spans = { spanOf(4 * row), spanOf(4 * row + 2) };
  }
  if (!skip)
  {
    this->CountAll();
  }
}

/// Counts every voxel as occupied.
void Occupancy::CountAll()
{
  const Range<int> x{ 0, this->Nodes.x };
  const Range<int> y{ 0, this->Nodes.y };
  std::fill(this->AlongX.begin(), this->AlongX.end(), Spans{ x, x });
  std::fill(this->AlongY.begin(), this->AlongY.end(), Spans{ y, y });
}

OccupancyBuilder::OccupancyBuilder(const Grid& grid)
  : Made(grid)
  , ColumnEnds(std::size_t(grid.nodes.z))
  , Filled(std::size_t(grid.nodes.z), 0)
{
}

void OccupancyBuilder::Add(
  int slice, const Range<int>& rows, const float* extinction, const float* importance)
{
  const int nx = this->Made.Nodes.x;
  const int ny = this->Made.Nodes.y;
  const auto z = std::size_t(slice);
  std::vector<int>& ends = this->ColumnEnds[z];
  if (rows.begin == 0)
  {
    ends.assign(4 * std::size_t(nx), 0);
  }
  // The ends of the columns' spans, in separate arrays for vectorisation.
  const ColumnSpanEnds columns{ ends.data(), ends.data() + nx, ends.data() + 2 * nx,
    ends.data() + 3 * nx };
  for (int y = rows.begin; y < rows.end; ++y, extinction += nx, importance += nx)
  {
    const RowContent row = ContentOf(extinction, importance, nx);
    this->Filled[z] += row.filled;
    this->Made.AlongX[z * std::size_t(ny) + std::size_t(y)] = row.spans;
    MarkColumns(extinction, importance, row.spans.filled, y, columns);
  }
  if (rows.end < ny)
  {
    return;
  }
  for (int x = 0; x < nx; ++x)
  {
    this->Made.AlongY[z * std::size_t(nx) + std::size_t(x)] = { { columns.filledBegin[x],
                                                                  columns.filledEnd[x] },
      { columns.importantBegin[x], columns.importantEnd[x] } };
  }
  ends = {};
}

Occupancy OccupancyBuilder::Take(bool skip)
{
  for (const Index count : this->Filled)
  {
    this->Made.Filled += count;
  }
  this->Made.Skip = skip;
  if (!skip)
  {
    this->Made.CountAll();
  }
  return std::move(this->Made);
}
}
