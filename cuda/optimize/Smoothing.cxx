// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Smoothing.h"

#include "backend/HostDevice.h"
#include "backend/Simd.h"
#include "backend/SlidingRows.h"

#include <algorithm>
#include <cstring>

namespace limpid
{
namespace
{
/// A row of numbers with one padding value on either side.
struct PaddedRow
{
  float* values;

  static Index Length(int count) { return Index(count) + 2; }
};

/// Sums over the voxels of one column along z with the weights 1, 2, 1, for each x.
struct ColumnSums
{
  PaddedRow changes; ///< [1/length]
  PaddedRow weights; ///< sums of the weights of filled voxels
  bool moved;        ///< whether any change is not zero
};

/// Adds a row of voxels to the sums of its columns. Returns whether any voxel of it has changed.
LIMPID_MULTIVERSION
bool AddRow(const float* __restrict base, const float* __restrict last, float weight, int count,
  float* __restrict changes, float* __restrict weights)
{
  int moved = 0;
  for (int x = 0; x < count; ++x)
  {
    const float change = last[x] - base[x];
    const bool filled = (base[x] > 0) | (last[x] > 0);
    changes[x + 1] += weight * change; // 0 where the voxel is empty
    weights[x + 1] += filled ? weight : 0.0f;
    moved |= change != 0 ? 1 : 0;
  }
  return moved != 0;
}

/// Computes the pull at a row, from the column sums below, at and above it.
LIMPID_MULTIVERSION
void WriteRow(const SmoothedNode& node, const ColumnSums* const (&columns)[3], Index first)
{
  const SmoothedNode body = node;
  const float* __restrict below = columns[0]->changes.values;
  const float* __restrict at = columns[1]->changes.values;
  const float* __restrict above = columns[2]->changes.values;
  const float* __restrict weightsBelow = columns[0]->weights.values;
  const float* __restrict weightsAt = columns[1]->weights.values;
  const float* __restrict weightsAbove = columns[2]->weights.values;
  const float own = NeighborWeight(0, 0, 0);
  LIMPID_IVDEP // the pull may be written in place of the derivative
    for (int x = 0; x < body.nodes.x; ++x)
  {
    const auto around = [x](const float* row) { return row[x] + 2 * row[x + 1] + row[x + 2]; };
    const Index voxel = first + x;
    const float change = body.last[voxel] - body.base[voxel];
    const float sum = around(below) + 2 * around(at) + around(above) - own * change;
    const float weights = around(weightsBelow) + 2 * around(weightsAt) + around(weightsAbove) -
      (body.IsFilled(voxel) ? own : 0.0f);
    body.Write(voxel, weights > 0 ? sum / weights : change);
  }
}

/// Computes the pull at a row without changes around it.
void WriteUnmoved(const SmoothedNode& body, Index first)
{
  const auto bytes = std::size_t(body.nodes.x) * sizeof(float);
  if (body.lagged == body.pull)
  {
    return;
  }
  if (body.lagged)
  {
    std::memcpy(body.pull + first, body.lagged + first, bytes);
  }
  else
  {
    std::memset(body.pull + first, 0, bytes);
  }
}

/// Computes the pull at the rows of one slice, see ForSlidingRows.
class SliceColumns
{
public:
  SliceColumns(const SmoothedNode& body, int slice)
    : Body(body)
    , Slice(slice)
  {
    const Index length = PaddedRow::Length(body.nodes.x);
    float* memory = ThreadScratch(static_cast<std::size_t>(6 * length));
    for (ColumnSums& sums : this->Kept)
    {
      sums.changes.values = memory;
      sums.weights.values = memory + length;
      memory += 2 * length;
    }
  }

  /// Sums the columns of row `y`, which may be outside of the grid.
  void Enter(int y)
  {
    ColumnSums& sums = this->Kept[PlaceOf(y)];
    std::fill_n(sums.changes.values, 2 * PaddedRow::Length(this->Body.nodes.x), 0.0f);
    sums.moved = false;
    const Int3& nodes = this->Body.nodes;
    for (int dz = -1; dz <= 1 && y >= 0 && y < nodes.y; ++dz)
    {
      const int z = this->Slice + dz;
      if (z >= 0 && z < nodes.z)
      {
        const Index first = (Index(z) * nodes.y + y) * nodes.x;
        const bool moved = AddRow(this->Body.base + first, this->Body.last + first,
          dz == 0 ? 2.0f : 1.0f, nodes.x, sums.changes.values, sums.weights.values);
        sums.moved = sums.moved || moved;
      }
    }
  }

  void Visit(int y) const
  {
    const ColumnSums* const columns[3] = { &this->Kept[PlaceOf(y - 1)], &this->Kept[PlaceOf(y)],
      &this->Kept[PlaceOf(y + 1)] };
    const Index first = (Index(this->Slice) * this->Body.nodes.y + y) * this->Body.nodes.x;
    if (columns[0]->moved || columns[1]->moved || columns[2]->moved)
    {
      WriteRow(this->Body, columns, first);
    }
    else
    {
      WriteUnmoved(this->Body, first);
    }
  }

private:
  static std::size_t PlaceOf(int y)
  {
    const int place = PlaceOfRow(y);
    return static_cast<std::size_t>(place);
  }

  const SmoothedNode& Body;
  int Slice;
  ColumnSums Kept[3];
};
}

void FindPull(HostDevice&, const SmoothedNode& body, const Range<int>& slices)
{
  ForSlidingRows(body.nodes.y, slices, [&](int slice) { return SliceColumns(body, slice); });
}
}
