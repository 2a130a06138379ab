// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SweepCounts.h"

#include "PlanSweep.h"

#include "backend/Backend.h"
#include "sweep/VoxelSpans.h"

#include <algorithm>
#include <numeric>

namespace limpid::benchmark
{
double CountOf(const NodeSet& nodes)
{
  return std::accumulate(nodes.begin(), nodes.end(), 0.0);
}

void Add(const NodeSet& more, NodeSet& nodes)
{
  std::transform(nodes.begin(), nodes.end(), more.begin(), nodes.begin(),
    [](unsigned char a, unsigned char b) { return static_cast<unsigned char>(a | b); });
}

SweepCounts CountSweep(const Problem& problem, const RaySource& source)
{
  const Index strides[3] = { 1, problem.grid.nodes.x,
    Index(problem.grid.nodes.x) * problem.grid.nodes.y };
  const NodeSet none(std::size_t(problem.grid.NodeCount()), 0);
  SweepCounts counts{ 0, none, 0, none };
  const std::vector<PlannedFrustum> frusta =
    PlanSweep(problem.grid, *problem.occupancy, source, { problem.settings.rayDensity });
  for (const PlannedFrustum& frustum : frusta)
  {
    const auto mark = [&](int node, int v, const Range<int>& columns, NodeSet& nodes)
    {
      const Index row = strides[frustum.axisW] * node + strides[frustum.axisV] * v;
      for (int u = columns.begin; u < columns.end; ++u)
      {
        nodes[std::size_t(row + strides[frustum.axisU] * u)] = 1;
      }
    };
    NodeSet read = none;
    for (int s = 0; s <= frustum.lastSlice; ++s)
    {
      const Slice& slice = frustum.SliceAt(s);
      for (int v = slice.ownedRows.begin; slice.node >= 0 && v < slice.ownedRows.end; ++v)
      {
        const Range<int> filled =
          SpansOf(frustum, problem.occupancy->Along(frustum.axisU), slice.node)[v].filled;
        mark(slice.node, v, Intersection(frustum.ActiveVoxels(s, v), filled), counts.updated);
      }
      for (int row = 0; s < frustum.lastSlice && row < frustum.rows; ++row)
      {
        const Range<int> active = frustum.ActiveRays(s, row);
        if (active.Empty())
        {
          continue;
        }
        counts.samples += active.Length();
        for (const int plane : { 2 * s, 2 * s + 1 }) // of the layer behind the slice
        {
          const int* index = frustum.PlaneColumns(plane).index;
          const Range<int> columns{ index[active.begin], index[active.end - 1] + 2 };
          const int v = frustum.PlaneRows(plane).index[row];
          for (const int node : slice.nodes)
          {
            mark(node, v, columns, read);
            mark(node, v + 1, columns, read);
          }
        }
      }
    }
    counts.readAgain += &frustum == &frusta.back() ? 0.0 : CountOf(read);
    Add(read, counts.read);
  }
  return counts;
}

NodeSet FilledNodes(const Problem& problem)
{
  const Int3 count = problem.grid.nodes;
  NodeSet nodes(std::size_t(problem.grid.NodeCount()), 0);
  ParallelFor(Index(count.y) * count.z,
    [&](Index line)
    {
      const auto y = static_cast<int>(line % count.y);
      const auto z = static_cast<int>(line / count.y);
      const Range<int> filled = problem.occupancy->Row(0, y, z).filled;
      const auto first = nodes.begin() + line * count.x;
      std::fill(first + filled.begin, first + std::max(filled.begin, filled.end), 1);
    });
  return nodes;
}
}
