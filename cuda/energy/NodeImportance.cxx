// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "energy/NodeImportance.h"

#include "backend/Backend.h"
#include "backend/Simd.h"

#include <algorithm>

namespace limpid
{
namespace
{
/// Weights of the neighbours of node `k` along an axis of `nodes` nodes: the integrals of the
/// node's hat times those of its neighbours, divided by the integral of its own.
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

/// A row and its neighbours along one axis; on the border the row itself stands in.
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
}

std::vector<float> NodeImportance(const Grid& grid, const float* importance)
{
  const int nx = grid.nodes.x;
  const int ny = grid.nodes.y;
  const int nz = grid.nodes.z;
  const Index slice = Index(nx) * ny;
  std::vector<float> mean(static_cast<std::size_t>(grid.NodeCount()));
  ParallelFor(nz,
    [&](Index z)
    {
      float* blended = ThreadScratch(std::size_t(nx));
      const float* source = importance + z * slice;
      for (int y = 0; y < ny; ++y)
      {
        const float* row = source + Index(y) * nx;
        WeighRows(
          y > 0 ? row - nx : row, row, y + 1 < ny ? row + nx : row, TapsOf(y, ny), nx, blended);
        WeighAlongRow(blended, nx, mean.data() + z * slice + Index(y) * nx);
      }
    });
  ParallelFor(ny,
    [&](Index y)
    {
      float* below = ThreadScratch(2 * std::size_t(nx));
      float* own = below + nx;
      float* row = mean.data() + y * nx;
      std::copy_n(row, nx, below);
      for (int z = 0; z < nz; ++z, row += slice)
      {
        std::copy_n(row, nx, own);
        WeighRows(below, own, z + 1 < nz ? row + slice : own, TapsOf(z, nz), nx, row);
        std::swap(below, own);
      }
    });
  return mean;
}

std::vector<float> NodeImportanceOfFilled(
  const Grid& grid, const float* baseExtinction, const float* importance)
{
  std::vector<float> mean = NodeImportance(grid, importance);
  ParallelFor(grid.NodeCount(), 65536,
    [&](Index node)
    {
      if (!(baseExtinction[node] > 0) && !(importance[node] > 0))
      {
        mean[std::size_t(node)] = 0;
      }
    });
  return mean;
}
}
