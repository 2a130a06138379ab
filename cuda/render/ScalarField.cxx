// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/ScalarField.h"

#include "backend/Backend.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
/// Returns the mean of the finite values among the 26 neighbours of a node; `otherwise` if there is
/// none.
float NeighbourMean(const Int3& nodes, const float* values, const Int3& at, float otherwise)
{
  double sum = 0;
  int count = 0;
  for (int k = std::max(at.z - 1, 0); k <= std::min(at.z + 1, nodes.z - 1); ++k)
  {
    for (int j = std::max(at.y - 1, 0); j <= std::min(at.y + 1, nodes.y - 1); ++j)
    {
      for (int i = std::max(at.x - 1, 0); i <= std::min(at.x + 1, nodes.x - 1); ++i)
      {
        const float value = values[i + nodes.x * (j + Index(nodes.y) * k)];
        if (std::isfinite(value))
        {
          sum += value;
          ++count;
        }
      }
    }
  }
  return count > 0 ? static_cast<float>(sum / count) : otherwise;
}
}

std::vector<float> FloatsOf(const ScalarNodes& scalars, Index count)
{
  std::vector<float> floats(static_cast<std::size_t>(count));
  ParallelFor(count, 65536, [&](Index node) { floats[std::size_t(node)] = scalars.At(node); });
  return floats;
}

ScalarField::ScalarField(const Grid& grid, const ScalarNodes& nodes, const float* shares)
  : values(nodes)
{
  const Index count = grid.NodeCount();
  if (shares)
  {
    this->filled.assign(shares, shares + count);
  }
  if (nodes.Bits() < 32)
  {
    return;
  }
  const float* scalars = nodes.Floats();
  const double bad = ParallelBlockSum(count,
    [&](Index begin, Index end)
    {
      Index unusable = 0;
      for (Index node = begin; node < end; ++node)
      {
        unusable += std::isfinite(scalars[node]) ? 0 : 1;
      }
      return static_cast<double>(unusable);
    });
  if (!(bad > 0))
  {
    return;
  }
  this->mended.assign(scalars, scalars + count);
  if (!shares)
  {
    this->filled.assign(std::size_t(count), 1.0f);
  }
  const float* finite =
    std::find_if(scalars, scalars + count, [](float value) { return std::isfinite(value); });
  const float otherwise = finite < scalars + count ? *finite : 0.0f;
  ParallelFor(grid.nodes.z,
    [&](Index k)
    {
      for (int j = 0; j < grid.nodes.y; ++j)
      {
        for (int i = 0; i < grid.nodes.x; ++i)
        {
          const Index node = i + grid.nodes.x * (j + grid.nodes.y * k);
          if (!std::isfinite(scalars[node]))
          {
            this->filled[std::size_t(node)] = 0;
            this->mended[std::size_t(node)] =
              NeighbourMean(grid.nodes, scalars, { i, j, int(k) }, otherwise);
          }
        }
      }
    });
  this->values = this->mended.data();
}
}
