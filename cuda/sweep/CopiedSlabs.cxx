// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/CopiedSlabs.h"

#include "sweep/BandDecomposition.h"
#include "sweep/PlanOutline.h"
#include "sweep/Registers.h"
#include "sweep/VoxelSpans.h"

#include <algorithm>

namespace limpid
{
namespace
{
constexpr int floatsInLine = 16; ///< in a cache line of 64 bytes
constexpr int slicesCopied = floatsInLine;

/// Returns slabs of so many slices that a transposed read uses whole cache lines.
std::vector<Range<int>> SlabsOf(const FaceFrustum& frustum)
{
  std::vector<Range<int>> slabs;
  for (int s = 0; s < frustum.SliceCount(); ++s)
  {
    const int node = frustum.SliceAt(s).node;
    const int first = slabs.empty() ? -1 : frustum.SliceAt(slabs.back().begin).node;
    if (first >= 0 && first / slicesCopied == node / slicesCopied)
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
}

SlabMemory::SlabMemory(const FaceFrustum& frustum)
  : columns(frustum.nodesU)
  , pitch(Index(frustum.nodesV) * frustum.nodesU + floatsInLine)
  , values((mostSlicesInFront + slicesCopied + mostSlicesBehind) * this->pitch)
  , rows(std::size_t(frustum.nodesV))
{
}

void SlabMemory::ClearRow(int v, const Range<int>& kept, int slices)
{
  Written& written = this->rows[std::size_t(v)];
  for (int k = 0; k < written.slices; ++k)
  {
    float* row = this->values.Data() + k * this->pitch + Index(v) * this->columns;
    const Range<int> old = written.columns;
    const Range<int> stays = k < slices && !kept.Empty() ? kept : Range<int>{ old.end, old.end };
    std::fill(row + old.begin, row + std::max(std::min(stays.begin, old.end), old.begin), 0.0f);
    std::fill(row + std::min(std::max(stays.end, old.begin), old.end), row + old.end, 0.0f);
  }
  // Writes cover whole vector registers, see WholeRegisters.
  const Range<int> wide{ std::max(kept.begin - registerLanes, 0),
    std::min(kept.end + registerLanes, this->columns) };
  written = kept.Empty() ? Written{} : Written{ wide, slices };
}

CopiedSlabs::CopiedSlabs(const FaceFrustum& frustum, const BandDecomposition& bands, int margin)
  : FieldSlabs(SlabsOf(frustum))
  , Frustum(frustum)
  , Bands(&bands)
  , Margin(margin)
{
}

SliceWindow CopiedSlabs::Open(float* field, const FieldUse& use)
{
  auto unused = std::find_if(this->Memory.begin(), this->Memory.end(),
    [](const std::shared_ptr<SlabMemory>& memory) { return memory.use_count() == 1; });
  if (unused == this->Memory.end())
  {
    unused = this->Memory.insert(unused, std::make_shared<SlabMemory>(this->Frustum));
  }
  SlabMemory& memory = **unused;
  return { field, use, memory.columns, this->Frustum.nodesV, memory.columns, memory.pitch,
    memory.values.Data(), *unused };
}

CopiedSlabs::Box CopiedSlabs::HullOf(
  const Range<int>& slices, Range<int> Slice::*columns, Range<int> Slice::*rows) const
{
  Box box;
  for (int s = slices.begin; s < slices.end; ++s)
  {
    const Slice& slice = this->Frustum.SliceAt(s);
    const int node = slice.node < 0 ? slice.nodes[0] : slice.node;
    box.columns = Hull(box.columns, slice.*columns);
    box.rows = Hull(box.rows, slice.*rows);
    box.nodes = Hull(box.nodes, { node, node + 1 });
  }
  box.columns = Grown(box.columns, this->Margin, this->Frustum.nodesU);
  box.rows = Grown(box.rows, this->Margin, this->Frustum.nodesV);
  return box;
}

std::vector<int> CopiedSlabs::RowsNeeded(const Box& box) const
{
  std::vector<char> isNeeded(std::size_t(this->Frustum.nodesV), 0);
  for (int node = box.nodes.begin; node < box.nodes.end; ++node)
  {
    const Range<int> needed =
      Grown(this->Bands->VoxelsNeededHere(node), this->Margin, this->Frustum.nodesV);
    std::fill(isNeeded.begin() + needed.begin, isNeeded.begin() + needed.end, char(1));
  }
  std::vector<int> rows;
  for (int v = box.rows.begin; v < box.rows.end; ++v)
  {
    if (isNeeded[std::size_t(v)])
    {
      rows.push_back(v);
    }
  }
  return rows;
}

/// Returns the part of a row that is not known to be 0 on all slices of a box.
Range<int> CopiedSlabs::FilledIn(const Box& box, int v, const Occupancy* occupancy) const
{
  if (!occupancy)
  {
    return box.columns;
  }
  Range<int> hull;
  for (int node = box.nodes.begin; node < box.nodes.end; ++node)
  {
    hull =
      Hull(hull, SpansOf(this->Frustum, occupancy->Along(this->Frustum.axisU), node)[v].filled);
  }
  const Range<int> filled = Intersection(hull, box.columns);
  return filled.Empty() ? Range<int>{ box.columns.begin, box.columns.begin } : filled;
}
}
