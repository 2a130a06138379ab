// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/Slices.h"

#include "backend/Backend.h"

#include <algorithm>

namespace limpid
{
namespace
{
constexpr int slicesPerSlab = 16;  // floats in a cache line of 64 bytes
constexpr int mostBehind = 2;      // stations that sweeps read behind a slab
constexpr int columnsPerTile = 16; // cache lines that a tile of columns reads again and again
}

std::vector<Slab> SlabsOf(const Pyramid& pyramid)
{
  const int stations = static_cast<int>(pyramid.stations.size());
  if (pyramid.axisW != 0)
  {
    return { { 0, stations } };
  }
  std::vector<Slab> slabs;
  for (int s = 0; s < stations; ++s)
  {
    const int slice = pyramid.stations[std::size_t(s)].slice;
    const bool sameLine = !slabs.empty() &&
      pyramid.stations[std::size_t(slabs.back().begin)].slice >= 0 &&
      pyramid.stations[std::size_t(slabs.back().begin)].slice / slicesPerSlab ==
        slice / slicesPerSlab;
    if (sameLine)
    {
      slabs.back().end = s + 1;
    }
    else
    {
      slabs.push_back({ s, s + 1 });
    }
  }
  return slabs;
}

std::shared_ptr<SlabMemory> SlabPool::Take(const Pyramid& pyramid)
{
  for (const std::shared_ptr<SlabMemory>& memory : this->All)
  {
    if (memory.use_count() == 1)
    {
      return memory;
    }
  }
  this->All.push_back(std::make_shared<SlabMemory>());
  const Index slice = Index(pyramid.nodesV) * pyramid.nodesU;
  this->All.back()->values = NodeValues((slicesPerSlab + mostBehind) * slice);
  this->All.back()->rows.resize(std::size_t(pyramid.nodesV));
  return this->All.back();
}

SliceWindow::SliceWindow(const Pyramid& pyramid, const Grid& grid, float* field, SlabPool& pool,
  const Occupancy* occupancy)
  : Source(&pyramid)
  , Occupied(occupancy)
  , Field(field)
  , Transposed(pyramid.axisW == 0)
  , Columns(pyramid.nodesU)
  , Rows(pyramid.nodesV)
  , Pool(&pool)
{
  const Index strides[3] = { 1, grid.nodes.x, Index(grid.nodes.x) * grid.nodes.y };
  this->StrideV = strides[pyramid.axisV];
  this->StrideW = strides[pyramid.axisW];
}

SliceWindow::Range SliceWindow::SlicesOf(int begin, int end) const
{
  int low = -1;
  int high = -1;
  for (int s = begin; s < end; ++s)
  {
    const Station& station = this->Source->stations[std::size_t(s)];
    const int slice = station.slice < 0 ? station.planes[0].slices[0] : station.slice;
    low = low < 0 ? slice : std::min(low, slice);
    high = std::max(high, slice);
  }
  return { std::max(low, 0), low < 0 ? 0 : high - low + 1 };
}

Interval SliceWindow::HullOf(int begin, int end, Interval Station::*part) const
{
  Interval hull;
  for (int s = begin; s < end; ++s)
  {
    hull = Hull(hull, this->Source->stations[std::size_t(s)].*part);
  }
  return hull;
}

/// Of `columns` of row `v` those that are not known to be 0 on all slices in a range.
Interval SliceWindow::FilledIn(const Range& slices, int v, const Interval& columns) const
{
  if (!this->Occupied)
  {
    return columns;
  }
  Interval hull;
  for (int k = 0; k < slices.count; ++k)
  {
    hull = Hull(hull, SpansOf(*this->Source, *this->Occupied, slices.first + k, v).filled);
  }
  const Interval filled = Intersection(hull, columns);
  return filled.Empty() ? Interval{ columns.begin, columns.begin } : filled;
}

void SliceWindow::Load(const Slab& slab, int behind)
{
  if (!this->Transposed)
  {
    return;
  }
  const int end = std::min(slab.end + behind, this->Source->LastStation() + 1);
  const Range range = this->SlicesOf(slab.begin, end);
  const Interval columns = this->HullOf(slab.begin, end, &Station::touchedColumns);
  const Interval rows = this->HullOf(slab.begin, end, &Station::touchedRows);
  const Index slice = Index(this->Rows) * this->Columns;
  const Index pitch = this->StrideV / this->Columns; // nodes along x
  this->First = range.first;
  if (!this->Memory)
  {
    this->Memory = this->Pool->Take(*this->Source);
    this->Slices = this->Memory->values.Data();
  }
  // Slices along x, columns along y, rows along z.
  ParallelFor(rows.end - rows.begin,
    [&](Index row)
    {
      const int v = rows.begin + static_cast<int>(row);
      const float* source = this->Field + this->StrideV * v + range.first;
      float* target = this->Slices + Index(v) * this->Columns;
      const Interval filled = this->FilledIn(range, v, columns);
      this->ClearRow(v, filled, range.count);
      for (int tile = filled.begin; tile < filled.end; tile += columnsPerTile)
      {
        const int last = std::min(tile + columnsPerTile, filled.end);
        for (int k = 0; k < range.count; ++k)
        {
          for (int u = tile; u < last; ++u)
          {
            target[k * slice + u] = source[pitch * u + k];
          }
        }
      }
    });
}

/// Makes 0 again what a row has been written in, but for `kept` of the first `slices`, which will
/// be overwritten.
void SliceWindow::ClearRow(int v, const Interval& kept, int slices)
{
  SlabMemory::Written& written = this->Memory->rows[std::size_t(v)];
  const Index slice = Index(this->Rows) * this->Columns;
  for (int k = 0; k < written.slices; ++k)
  {
    float* row = this->Slices + k * slice + Index(v) * this->Columns;
    const Interval old = written.columns;
    const Interval stays = k < slices && !kept.Empty() ? kept : Interval{ old.end, old.end };
    std::fill(row + old.begin, row + std::max(std::min(stays.begin, old.end), old.begin), 0.0f);
    std::fill(row + std::min(std::max(stays.end, old.begin), old.end), row + old.end, 0.0f);
  }
  // Whole registers are written, see FilledRegisters.
  const Interval wide{ std::max(kept.begin - registerLanes, 0),
    std::min(kept.end + registerLanes, this->Columns) };
  written = kept.Empty() ? SlabMemory::Written{} : SlabMemory::Written{ wide, slices };
}

void SliceWindow::Store(const Slab& slab)
{
  if (!this->Transposed)
  {
    return;
  }
  const Range range = this->SlicesOf(slab.begin, slab.end);
  const Interval columns = this->HullOf(slab.begin, slab.end, &Station::ownedColumns);
  const Interval rows = this->HullOf(slab.begin, slab.end, &Station::ownedRows);
  const Index slice = Index(this->Rows) * this->Columns;
  const Index pitch = this->StrideV / this->Columns;
  ParallelFor(rows.end - rows.begin,
    [&](Index row)
    {
      const Index v = rows.begin + row;
      float* target = this->Field + this->StrideV * v + range.first;
      const float* source = this->Slices + (range.first - this->First) * slice + v * this->Columns;
      const Interval filled = this->FilledIn(range, static_cast<int>(v), columns);
      for (int u = filled.begin; u < filled.end; ++u)
      {
        for (int k = 0; k < range.count; ++k)
        {
          target[pitch * u + k] = source[k * slice + u];
        }
      }
    });
}
}
