// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/SliceWindow.h"

#include "backend/Backend.h"
#include "sweep/BandDecomposition.h"
#include "sweep/Registers.h"

#include <algorithm>
#include <numeric>

namespace limpid
{
namespace
{
constexpr int columnsPerTile = 16; // number of columns per tile, whose cache lines are reused

/// Returns the distance between copied slices, padded so that rows use different cache sets.
Index PitchOf(const FaceFrustum& frustum)
{
  constexpr Index lineOfCache = 16;
  return Index(frustum.nodesV) * frustum.nodesU + lineOfCache;
}
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
  this->All.back()->values =
    NodeValues((mostSlicesInFront + slicesCopied + mostSlicesBehind) * PitchOf(frustum));
  this->All.back()->rows.resize(std::size_t(frustum.nodesV));
  return this->All.back();
}

SliceWindow::SliceWindow(const FaceFrustum& frustum, const BandDecomposition& bands,
  const SlabExchange* delivery, const Occupancy* occupancy, SlabPool& pool, float* field,
  const FieldUse& use)
  : Source(&frustum)
  , Bands(&bands)
  , Delivery(delivery)
  , Occupied(occupancy)
  , Field(field)
  , Use(use)
  , IsCopied(frustum.axisW == 0 || delivery)
  , Columns(frustum.nodesU)
  , Rows(frustum.nodesV)
  , Pitch(PitchOf(frustum))
  , StrideV(frustum.strideV)
  , StrideW(frustum.strideW)
  , Pool(&pool)
{
}

/// Returns the rows out of `rows` that the rank needs at any of these nodes.
std::vector<int> SliceWindow::RowsOfRank(const Range<int>& rows, const Range<int>& nodes) const
{
  std::vector<int> some(std::size_t(std::max(rows.Length(), 0)));
  std::iota(some.begin(), some.end(), rows.begin);
  std::vector<char> isNeeded(std::size_t(this->Rows), 0);
  for (int node = nodes.begin; node < nodes.end; ++node)
  {
    const Range<int> needed = Grown(this->Bands->VoxelsNeeded(this->Bands->Ranks().Rank(), node),
      this->Delivery ? this->Delivery->Margin() : 0, this->Rows);
    std::fill(isNeeded.begin() + needed.begin, isNeeded.begin() + needed.end, char(1));
  }
  some.erase(std::remove_if(some.begin(), some.end(),
               [&isNeeded](int row) { return !isNeeded[std::size_t(row)]; }),
    some.end());
  return some;
}

/// Returns the part of `columns` in row `v` that is not known to be 0 on all slices of these
/// nodes.
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
  if (!this->IsCopied || this->Empty())
  {
    return;
  }
  const int inFront = this->Delivery ? mostSlicesInFront : this->Use.inFront;
  const int behind = this->Delivery ? mostSlicesBehind : this->Use.behind;
  const Range<int> slices{ std::max(slab.begin - inFront, 0),
    std::min(slab.end + behind, this->Source->SliceCount()) };
  const Range<int> nodes = NodesOf(*this->Source, slices);
  const int margin = this->Delivery ? this->Delivery->Margin() : 0;
  const Range<int> columns =
    Grown(HullOf(*this->Source, slices, &Slice::touchedColumns), margin, this->Columns);
  const std::vector<int> rows = this->RowsOfRank(
    Grown(HullOf(*this->Source, slices, &Slice::touchedRows), margin, this->Rows), nodes);
  this->First = nodes.begin;
  if (!this->Memory)
  {
    this->Memory = this->Pool->Take(*this->Source);
    this->Slices = this->Memory->values.Data();
  }
  ParallelFor(static_cast<Index>(rows.size()),
    [&](Index row)
    {
      const int v = rows[std::size_t(row)];
      const Range<int> filled = this->FilledIn(nodes, v, columns);
      if (this->Delivery)
      {
        this->ClearRow(v, Range<int>{}, 0);
        this->ClearRow(v, filled, nodes.Length()); // `filled` will have been written
      }
      else
      {
        this->ClearRow(v, filled, nodes.Length());
        this->TransposeRow(v, filled, nodes);
      }
    });
}

/// Copies with slices along x, columns along y and rows along z.
void SliceWindow::TransposeRow(int v, const Range<int>& columns, const Range<int>& nodes)
{
  const Index pitch = this->StrideV / this->Columns; // nodes along x
  const float* source = this->Field + this->StrideV * v + nodes.begin;
  float* target = this->Slices + Index(v) * this->Columns;
  for (int tile = columns.begin; tile < columns.end; tile += columnsPerTile)
  {
    const int last = std::min(tile + columnsPerTile, columns.end);
    for (int k = 0; k < nodes.Length(); ++k)
    {
      for (int u = tile; u < last; ++u)
      {
        target[k * this->Pitch + u] = source[pitch * u + k];
      }
    }
  }
}

SlabExchange::Field SliceWindow::Delivered() const
{
  FieldView view{ this->Slices - this->First * this->Pitch, {} };
  view.stride[std::size_t(this->Source->axisU)] = 1;
  view.stride[std::size_t(this->Source->axisV)] = this->Columns;
  view.stride[std::size_t(this->Source->axisW)] = this->Pitch;
  return { this->Field, view };
}

/// Clears what was written in a row, except `kept` on the first `slices` slices, which will be
/// overwritten.
void SliceWindow::ClearRow(int v, const Range<int>& kept, int slices)
{
  SlabMemory::Written& written = this->Memory->rows[std::size_t(v)];
  for (int k = 0; k < written.slices; ++k)
  {
    float* row = this->Slices + k * this->Pitch + Index(v) * this->Columns;
    const Range<int> old = written.columns;
    const Range<int> stays = k < slices && !kept.Empty() ? kept : Range<int>{ old.end, old.end };
    std::fill(row + old.begin, row + std::max(std::min(stays.begin, old.end), old.begin), 0.0f);
    std::fill(row + std::min(std::max(stays.end, old.begin), old.end), row + old.end, 0.0f);
  }
  // Writes cover whole vector registers, see WholeRegisters.
  const Range<int> wide{ std::max(kept.begin - registerLanes, 0),
    std::min(kept.end + registerLanes, this->Columns) };
  written = kept.Empty() ? SlabMemory::Written{} : SlabMemory::Written{ wide, slices };
}

void SliceWindow::Store(const Range<int>& slab)
{
  if (!this->IsCopied || this->Delivery || !this->Use.writes)
  {
    return;
  }
  const Range<int> nodes = NodesOf(*this->Source, slab);
  const Range<int> columns = HullOf(*this->Source, slab, &Slice::ownedColumns);
  const std::vector<int> rows =
    this->RowsOfRank(HullOf(*this->Source, slab, &Slice::ownedRows), nodes);
  const Index pitch = this->StrideV / this->Columns;
  ParallelFor(static_cast<Index>(rows.size()),
    [&](Index row)
    {
      const Index v = rows[std::size_t(row)];
      float* target = this->Field + this->StrideV * v + nodes.begin;
      const float* source =
        this->Slices + (nodes.begin - this->First) * this->Pitch + v * this->Columns;
      const Range<int> filled = this->FilledIn(nodes, static_cast<int>(v), columns);
      for (int u = filled.begin; u < filled.end; ++u)
      {
        for (int k = 0; k < nodes.Length(); ++k)
        {
          target[pitch * u + k] = source[k * this->Pitch + u];
        }
      }
    });
}
}
