// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/Slices.h"

#include "backend/Backend.h"

#include <algorithm>

namespace limpid
{
namespace
{
constexpr int slicesPerSlab = 16; // floats in a cache line of 64 bytes
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

SliceWindow::SliceWindow(const Pyramid& pyramid, const Grid& grid, float* field)
  : Source(&pyramid)
  , Field(field)
  , Transposed(pyramid.axisW == 0)
  , Columns(pyramid.nodesU)
  , Rows(pyramid.nodesV)
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

void SliceWindow::Load(const Slab& slab, int behind)
{
  if (!this->Transposed)
  {
    return;
  }
  const int last = this->Source->LastStation() + 1;
  const Range range = this->SlicesOf(slab.begin, std::min(slab.end + behind, last));
  this->First = range.first;
  this->Buffer.resize(std::size_t(range.count) * this->Rows * this->Columns);
  // Slices along x, columns along y, rows along z.
  ParallelFor(this->Rows,
    [&](Index v)
    {
      const Index pitch = this->StrideV / this->Columns; // nodes along x
      for (int u = 0; u < this->Columns; ++u)
      {
        const float* source = this->Field + this->StrideV * v + pitch * u + range.first;
        float* target = this->Buffer.data() + v * this->Columns + u;
        for (int slice = 0; slice < range.count; ++slice)
        {
          target[std::size_t(slice) * this->Rows * this->Columns] = source[slice];
        }
      }
    });
}

void SliceWindow::Store(const Slab& slab)
{
  if (!this->Transposed)
  {
    return;
  }
  const Range range = this->SlicesOf(slab.begin, slab.end);
  ParallelFor(this->Rows,
    [&](Index v)
    {
      const Index pitch = this->StrideV / this->Columns;
      for (int u = 0; u < this->Columns; ++u)
      {
        float* target = this->Field + this->StrideV * v + pitch * u + range.first;
        const float* source = this->Buffer.data() + v * this->Columns + u;
        for (int slice = 0; slice < range.count; ++slice)
        {
          target[slice] =
            source[std::size_t(range.first - this->First + slice) * this->Rows * this->Columns];
        }
      }
    });
}
}
