// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Levels.h"

#include "backend/Backend.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
/// Along one axis: every target node is a weighted mean of consecutive source nodes.
struct AxisFilter
{
  std::vector<int> first;
  std::vector<std::vector<float>> weights;
};

/// Hat functions of the target nodes, as wide as the coarser of the two spacings.
AxisFilter MakeFilter(int sourceNodes, int targetNodes)
{
  AxisFilter filter;
  const double ratio = targetNodes > 1 ? (sourceNodes - 1.0) / (targetNodes - 1.0) : 1.0;
  const double width = std::max(ratio, 1.0);
  for (int target = 0; target < targetNodes; ++target)
  {
    const double centre = target * ratio;
    const int low = std::max(0, static_cast<int>(std::ceil(centre - width)));
    const int high = std::min(sourceNodes - 1, static_cast<int>(std::floor(centre + width)));
    std::vector<float> weights;
    double sum = 0;
    for (int source = low; source <= high; ++source)
    {
      const double weight = std::max(0.0, 1.0 - std::abs(source - centre) / width);
      weights.push_back(static_cast<float>(weight));
      sum += weight;
    }
    for (float& weight : weights)
    {
      weight = static_cast<float>(weight / sum);
    }
    filter.first.push_back(low);
    filter.weights.push_back(std::move(weights));
  }
  return filter;
}

/// Filters one axis of a field; `nodes` is updated to the new size.
std::vector<float> FilterAxis(const std::vector<float>& field, Int3& nodes, int axis, int target)
{
  const AxisFilter filter = MakeFilter(nodes[axis], target);
  Int3 size = nodes;
  size[axis] = target;
  std::vector<float> result(std::size_t(Index(size.x) * size.y * size.z));
  const Index stride = axis == 0 ? 1 : (axis == 1 ? nodes.x : Index(nodes.x) * nodes.y);
  const Int3 from = nodes;
  ParallelFor(Index(size.y) * size.z, 16,
    [&](Index row)
    {
      const int y = static_cast<int>(row % size.y);
      const int z = static_cast<int>(row / size.y);
      for (int x = 0; x < size.x; ++x)
      {
        Int3 node(x, y, z);
        const auto at = std::size_t(node[axis]);
        node[axis] = filter.first[at];
        const float* source = field.data() + (Index(node.z) * from.y + node.y) * from.x + node.x;
        float sum = 0;
        for (const float weight : filter.weights[at])
        {
          sum += weight * *source;
          source += stride;
        }
        result[std::size_t(row * size.x + x)] = sum;
      }
    });
  nodes = size;
  return result;
}

std::vector<float> Resample(const Grid& from, const float* field, const Grid& to)
{
  std::vector<float> values(field, field + from.NodeCount());
  Int3 nodes = from.nodes;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (nodes[axis] != to.nodes[axis])
    {
      values = FilterAxis(values, nodes, axis, to.nodes[axis]);
    }
  }
  return values;
}
}

Grid CoarseGrid(const Grid& grid, int factor)
{
  Grid coarse = grid;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int cells = grid.nodes[axis] - 1;
    const int coarseCells = cells > 0 ? std::max(1, (cells + factor - 1) / factor) : 0;
    coarse.nodes[axis] = coarseCells + 1;
    coarse.spacing[axis] =
      cells > 0 ? grid.spacing[axis] * cells / coarseCells : grid.spacing[axis];
  }
  return coarse;
}

std::vector<float> Restrict(const Grid& fine, const float* field, const Grid& coarse)
{
  return Resample(fine, field, coarse);
}

std::vector<float> Prolong(const Grid& coarse, const float* field, const Grid& fine)
{
  return Resample(coarse, field, fine);
}
}
