// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "scene/Occupancy.h"

#include "backend/Backend.h"
#include "backend/Simd.h"

#include <algorithm>
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

Occupancy::Occupancy(
  const Grid& grid, std::vector<Spans> alongX, std::vector<Spans> alongY, Index filled, bool skip)
  : Nodes(grid.nodes)
  , Skip(skip)
  , Filled(filled)
  , AlongX(std::move(alongX))
  , AlongY(std::move(alongY))
{
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
  this->AlongX = { Spans{ x, x } };
  this->AlongY = { Spans{ y, y } };
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
