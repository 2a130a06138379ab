// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/SliceWindow.h"

#include "backend/Backend.h"
#include "sweep/RankBands.h"
#include "sweep/Registers.h"

#include <algorithm>
#include <numeric>

namespace limpid
{
namespace
{
constexpr int slicesPerSlab = 16;  // floats in a cache line of 64 bytes
constexpr int mostBehind = 2;      // slices that sweeps read behind a slab
constexpr int columnsPerTile = 16; // cache lines that a tile of columns reads again and again
}

std::vector<Range<int>> SlabsOf(const FaceFrustum& frustum)
{
  if (frustum.axisW != 0)
  {
    return { { 0, frustum.SliceCount() } };
  }
  std::vector<Range<int>> slabs;
  for (int s = 0; s < frustum.SliceCount(); ++s)
  {
    const int node = frustum.SliceAt(s).node;
    const int first = slabs.empty() ? -1 : frustum.SliceAt(slabs.back().begin).node;
    if (first >= 0 && first / slicesPerSlab == node / slicesPerSlab)
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

std::shared_ptr<SlabMemory> SlabPool::Take(const FaceFrustum& frustum)
{
  for (const std::shared_ptr<SlabMemory>& memory : this->All)
  {
    if (memory.use_count() == 1)
    {
      return memory;
    }
  }
  this->All.push_back(std::make_shared<SlabMemory>());
  const Index slice = Index(frustum.nodesV) * frustum.nodesU;
  this->All.back()->values = NodeValues((slicesPerSlab + mostBehind) * slice);
  this->All.back()->rows.resize(std::size_t(frustum.nodesV));
  return this->All.back();
}

SliceWindow::SliceWindow(const FaceFrustum& frustum, const Occupancy* occupancy, SlabPool& pool,
  float* field, const FieldUse& use)
  : Source(&frustum)
  , Occupied(occupancy)
  , Field(field)
  , Use(use)
  , Transposed(frustum.axisW == 0)
  , Columns(frustum.nodesU)
  , Rows(frustum.nodesV)
  , StrideV(frustum.strideV)
  , StrideW(frustum.strideW)
  , Pool(&pool)
{
}

/// Node indices along the depth axis of the slices [begin, end).
Range<int> SliceWindow::NodesOf(int begin, int end) const
{
  Range<int> nodes;
  for (int s = begin; s < end; ++s)
  {
    const Slice& slice = this->Source->SliceAt(s);
    const int node = slice.node < 0 ? slice.nodes[0] : slice.node;
    nodes = Hull(nodes, { node, node + 1 });
  }
  return nodes;
}

/// Of `rows` those that the rank needs at any of these nodes.
std::vector<int> SliceWindow::RowsOfRank(const Range<int>& rows, const Range<int>& nodes) const
{
  std::vector<int> some(std::size_t(std::max(rows.Length(), 0)));
  std::iota(some.begin(), some.end(), rows.begin);
  if (!this->Bands)
  {
    return some;
  }
  std::vector<char> isNeeded(std::size_t(this->Rows), 0);
  for (int node = nodes.begin; node < nodes.end; ++node)
  {
    const Range<int> needed = this->Bands->VoxelsNeeded(this->Bands->Ranks().Rank(), node);
    std::fill(isNeeded.begin() + needed.begin, isNeeded.begin() + needed.end, char(1));
  }
  some.erase(std::remove_if(some.begin(), some.end(),
               [&isNeeded](int row) { return !isNeeded[std::size_t(row)]; }),
    some.end());
  return some;
}

Range<int> SliceWindow::HullOf(int begin, int end, Range<int> Slice::*part) const
{
  Range<int> hull;
  for (int s = begin; s < end; ++s)
  {
    hull = Hull(hull, this->Source->SliceAt(s).*part);
  }
  return hull;
}

/// Of `columns` of row `v` those that are not known to be 0 on all slices of these nodes.
Range<int> SliceWindow::FilledIn(const Range<int>& nodes, int v, const Range<int>& columns) const
{
  if (!this->Occupied)
  {
    return columns;
  }
  Range<int> hull;
  for (int node = nodes.begin; node < nodes.end; ++node)
  {
    hull = Hull(hull, SpansOf(*this->Source, *this->Occupied, node)[v].filled);
  }
  const Range<int> filled = Intersection(hull, columns);
  return filled.Empty() ? Range<int>{ columns.begin, columns.begin } : filled;
}

void SliceWindow::Load(const Range<int>& slab)
{
  if (!this->Transposed || this->Empty())
  {
    return;
  }
  const int end = std::min(slab.end + this->Use.behind, this->Source->SliceCount());
  const Range<int> nodes = this->NodesOf(slab.begin, end);
  const Range<int> columns = this->HullOf(slab.begin, end, &Slice::touchedColumns);
  const std::vector<int> rows =
    this->RowsOfRank(this->HullOf(slab.begin, end, &Slice::touchedRows), nodes);
  const Index slice = Index(this->Rows) * this->Columns;
  const Index pitch = this->StrideV / this->Columns; // nodes along x
  this->First = nodes.begin;
  if (!this->Memory)
  {
    this->Memory = this->Pool->Take(*this->Source);
    this->Slices = this->Memory->values.Data();
  }
  // Slices along x, columns along y, rows along z.
  ParallelFor(static_cast<Index>(rows.size()),
    [&](Index row)
    {
      const int v = rows[std::size_t(row)];
      const float* source = this->Field + this->StrideV * v + nodes.begin;
      float* target = this->Slices + Index(v) * this->Columns;
      const Range<int> filled = this->FilledIn(nodes, v, columns);
      this->ClearRow(v, filled, nodes.Length());
      for (int tile = filled.begin; tile < filled.end; tile += columnsPerTile)
      {
        const int last = std::min(tile + columnsPerTile, filled.end);
        for (int k = 0; k < nodes.Length(); ++k)
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
void SliceWindow::ClearRow(int v, const Range<int>& kept, int slices)
{
  SlabMemory::Written& written = this->Memory->rows[std::size_t(v)];
  const Index slice = Index(this->Rows) * this->Columns;
  for (int k = 0; k < written.slices; ++k)
  {
    float* row = this->Slices + k * slice + Index(v) * this->Columns;
    const Range<int> old = written.columns;
    const Range<int> stays = k < slices && !kept.Empty() ? kept : Range<int>{ old.end, old.end };
    std::fill(row + old.begin, row + std::max(std::min(stays.begin, old.end), old.begin), 0.0f);
    std::fill(row + std::min(std::max(stays.end, old.begin), old.end), row + old.end, 0.0f);
  }
  // Whole registers are written, see WholeRegisters.
  const Range<int> wide{ std::max(kept.begin - registerLanes, 0),
    std::min(kept.end + registerLanes, this->Columns) };
  written = kept.Empty() ? SlabMemory::Written{} : SlabMemory::Written{ wide, slices };
}

void SliceWindow::Store(const Range<int>& slab)
{
  if (!this->Transposed || !this->Use.writes)
  {
    return;
  }
  const Range<int> nodes = this->NodesOf(slab.begin, slab.end);
  const Range<int> columns = this->HullOf(slab.begin, slab.end, &Slice::ownedColumns);
  const std::vector<int> rows =
    this->RowsOfRank(this->HullOf(slab.begin, slab.end, &Slice::ownedRows), nodes);
  const Index slice = Index(this->Rows) * this->Columns;
  const Index pitch = this->StrideV / this->Columns;
  ParallelFor(static_cast<Index>(rows.size()),
    [&](Index row)
    {
      const Index v = rows[std::size_t(row)];
      float* target = this->Field + this->StrideV * v + nodes.begin;
      const float* source = this->Slices + (nodes.begin - this->First) * slice + v * this->Columns;
      const Range<int> filled = this->FilledIn(nodes, static_cast<int>(v), columns);
      for (int u = filled.begin; u < filled.end; ++u)
      {
        for (int k = 0; k < nodes.Length(); ++k)
        {
          target[pitch * u + k] = source[k * slice + u];
        }
      }
    });
}
}
