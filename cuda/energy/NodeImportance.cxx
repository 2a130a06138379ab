// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "energy/NodeImportance.h"

#include "backend/Backend.h"
#include "backend/Simd.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace limpid
{
namespace
{
/// Weights of node `k` and its neighbours along an axis of `nodes` nodes: integrals of the node's
/// hat times each hat, divided by the integral of its own hat.
struct Taps
{
  float below;
  float own;
  float above;
};

Taps TapsOf(int k, int nodes)
{
  if (nodes == 1)
  {
    return { 0.0f, 1.0f, 0.0f };
  }
  if (k == 0)
  {
    return { 0.0f, 2.0f / 3, 1.0f / 3 };
  }
  return k == nodes - 1 ? Taps{ 1.0f / 3, 2.0f / 3, 0.0f } : Taps{ 1.0f / 6, 2.0f / 3, 1.0f / 6 };
}

/// Averages a row and its neighbours along one axis; on the border the row itself is repeated.
LIMPID_MULTIVERSION
void WeighRows(const float* below, const float* own, const float* above, const Taps& taps,
  int count, float* __restrict out)
{
  for (int x = 0; x < count; ++x)
  {
    out[x] = taps.own * own[x] + (taps.below * below[x] + taps.above * above[x]);
  }
}

LIMPID_MULTIVERSION
void WeighAlongRow(const float* __restrict row, int count, float* __restrict out)
{
  const Taps inner = TapsOf(1, 3);
  for (int x = 1; x + 1 < count; ++x)
  {
    out[x] = inner.own * row[x] + (inner.below * row[x - 1] + inner.above * row[x + 1]);
  }
  const Taps first = TapsOf(0, count);
  const Taps last = TapsOf(count - 1, count);
  out[0] = first.own * row[0] + (count > 1 ? first.above * row[1] : 0.0f);
  out[count - 1] = count > 1 ? last.own * row[count - 1] + last.below * row[count - 2] : out[0];
}

/// Clears the mean at nodes without extinction and importance.
LIMPID_MULTIVERSION
void ClearEmpty(const float* __restrict baseExtinction, const float* __restrict importance,
  int count, float* __restrict mean)
{
  for (int x = 0; x < count; ++x)
  {
    const bool filled = (baseExtinction[x] > 0) | (importance[x] > 0);
    mean[x] = filled ? mean[x] : 0.0f;
  }
}

LIMPID_MULTIVERSION
bool IsZero(const float* __restrict row, int count)
{
  int other = 0;
  for (int x = 0; x < count; ++x)
  {
    other |= row[x] != 0 ? 1 : 0;
  }
  return !other;
}

constexpr int rowsPerTile = 32;
constexpr int slicesPerTile = 16;

/// A part of the grid whose slices fit into a small cache.
struct Tile
{
  Range<int> rows;
  Range<int> slices;
};

/// Means along x and y of the rows of a tile on one slice.
struct SliceMean
{
  float* values = nullptr;
  std::array<bool, rowsPerTile> zero{}; ///< [row]: whether all values are 0
};

class TileMean
{
public:
  TileMean(const Grid& grid, const float* baseExtinction, const float* importance, float* mean)
    : Nodes(grid.nodes)
    , BaseExtinction(baseExtinction)
    , Importance(importance)
    , Mean(mean)
  {
  }

  void Fill(const Tile& tile, const MeanRows& done) const
  {
    const std::size_t nx = std::size_t(this->Nodes.x);
    float* memory = ThreadScratch((3 * rowsPerTile + 1) * nx);
    SliceMean slices[3];
    for (std::size_t i = 0; i < 3; ++i)
    {
      slices[i].values = memory + (1 + i * rowsPerTile) * nx;
    }
    SliceMean* below = slices;
    SliceMean* own = slices + 1;
    SliceMean* above = slices + 2;
    this->FindMeanAcross(std::max(tile.slices.begin - 1, 0), tile.rows, memory, *below);
    this->FindMeanAcross(tile.slices.begin, tile.rows, memory, *own);
    for (int z = tile.slices.begin; z < tile.slices.end; ++z)
    {
      this->FindMeanAcross(std::min(z + 1, this->Nodes.z - 1), tile.rows, memory, *above);
      this->FindMean(z, tile.rows, *below, *own, *above);
      done(z, tile.rows);
      std::swap(below, own);
      std::swap(own, above);
    }
  }

private:
  Index RowAt(int y, int z) const { return (Index(z) * this->Nodes.y + y) * this->Nodes.x; }

  /// Computes means along x and y. `blended`: scratch memory for a row.
  void FindMeanAcross(int z, const Range<int>& rows, float* blended, SliceMean& mean) const
  {
    const int nx = this->Nodes.x;
    const int ny = this->Nodes.y;
    const float* slice = this->Importance + this->RowAt(0, z);
    const auto rowAt = [&](int y) { return slice + Index(std::min(std::max(y, 0), ny - 1)) * nx; };
    bool zeroBefore = IsZero(rowAt(rows.begin - 1), nx);
    bool zero = IsZero(rowAt(rows.begin), nx);
    for (int y = rows.begin; y < rows.end; ++y)
    {
      const bool zeroBehind = IsZero(rowAt(y + 1), nx);
      const int row = y - rows.begin;
      float* values = mean.values + Index(row) * nx;
      mean.zero[std::size_t(row)] = zeroBefore && zero && zeroBehind;
      if (mean.zero[std::size_t(row)])
      {
        std::fill_n(values, nx, 0.0f);
      }
      else
      {
        WeighRows(rowAt(y - 1), rowAt(y), rowAt(y + 1), TapsOf(y, ny), nx, blended);
        WeighAlongRow(blended, nx, values);
      }
      zeroBefore = zero;
      zero = zeroBehind;
    }
  }

  /// Computes means along z from the means of a slice and its neighbours.
  void FindMean(int z, const Range<int>& rows, const SliceMean& below, const SliceMean& own,
    const SliceMean& above) const
  {
    const int nx = this->Nodes.x;
    const Taps taps = TapsOf(z, this->Nodes.z);
    for (int y = rows.begin; y < rows.end; ++y)
    {
      const auto row = std::size_t(y - rows.begin);
      if (below.zero[row] && own.zero[row] && above.zero[row])
      {
        continue;
      }
      const Index first = this->RowAt(y, z);
      const Index at = Index(row) * nx;
      float* mean = this->Mean + first;
      WeighRows(below.values + at, own.values + at, above.values + at, taps, nx, mean);
      ClearEmpty(this->BaseExtinction + first, this->Importance + first, nx, mean);
    }
  }

  Int3 Nodes;
  const float* BaseExtinction;
  const float* Importance;
  float* Mean;
};
}

std::vector<float> NodeImportanceOfFilled(
  const Grid& grid, const float* baseExtinction, const float* importance)
{
  std::vector<float> mean(static_cast<std::size_t>(grid.NodeCount()));
  FillNodeImportanceOfFilled(
    grid, baseExtinction, importance, mean.data(), [](int, const Range<int>&) {});
  return mean;
}

void FillNodeImportanceOfFilled(const Grid& grid, const float* baseExtinction,
  const float* importance, float* zeros, const MeanRows& done)
{
  const Int3& nodes = grid.nodes;
  const TileMean body(grid, baseExtinction, importance, zeros);
  ParallelFor((nodes.z + slicesPerTile - 1) / slicesPerTile,
    [&](Index slab)
    {
      const int z = static_cast<int>(slab) * slicesPerTile;
      const Range<int> slices{ z, std::min(z + slicesPerTile, nodes.z) };
      for (int y = 0; y < nodes.y; y += rowsPerTile)
      {
        body.Fill({ { y, std::min(y + rowsPerTile, nodes.y) }, slices }, done);
      }
    });
}

void FillRowsOfImportantExtinction(const Grid& grid, const Range<int>& given,
  const Range<int>& slices, const float* baseExtinction, const float* importance, double* rows)
{
  const Int3& nodes = grid.nodes;
  Grid slab = grid;
  slab.nodes.z = given.Length();
  const std::vector<float> mean = NodeImportanceOfFilled(slab, baseExtinction, importance);
  // Integral of a node's hat along an axis [spacing].
  const auto hat = [](int k, int count) { return 0.5 * (int(k > 0) + int(k + 1 < count)); };
  ParallelFor(Index(slices.Length()) * nodes.y, 16,
    [&](Index number)
    {
      const int y = static_cast<int>(number % nodes.y);
      const int z = slices.begin + static_cast<int>(number / nodes.y);
      const Index first = (Index(z - given.begin) * nodes.y + y) * nodes.x;
      double sum = 0;
      for (int i = 0; i < nodes.x; ++i)
      {
        sum += hat(i, nodes.x) * double(baseExtinction[first + i]) *
          double(mean[std::size_t(first + i)]);
      }
      rows[Index(z) * nodes.y + y] = sum * hat(y, nodes.y) * hat(z, nodes.z);
    });
}

double SumOfRows(const Grid& grid, const std::vector<double>& rows)
{
  return grid.CellVolume() *
    ParallelBlockSum(static_cast<Index>(rows.size()),
      [&](Index begin, Index end)
      { return std::accumulate(rows.begin() + begin, rows.begin() + end, 0.0); });
}
}
