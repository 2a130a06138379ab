// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SweepCounts.h"

#include "backend/Backend.h"
#include "sweep/Plan.h"

#include <algorithm>
#include <numeric>

namespace limpid::benchmark
{
namespace
{
/// A frustum's slices and rows as nodes of the grid.
class Marker
{
public:
  Marker(const Grid& grid, const FaceFrustum& frustum)
    : Source(frustum)
  {
    const Index strides[3] = { 1, grid.nodes.x, Index(grid.nodes.x) * grid.nodes.y };
    this->StrideU = strides[frustum.axisU];
    this->StrideV = strides[frustum.axisV];
    this->StrideW = strides[frustum.axisW];
  }

  void Mark(int slice, int v, const Range<int>& columns, NodeSet& nodes) const
  {
    for (int u = columns.begin; u < columns.end; ++u)
    {
      nodes[std::size_t(this->StrideW * slice + this->StrideV * v + this->StrideU * u)] = 1;
    }
  }

  /// What a row of rays reads in the layer behind a slice.
  void MarkRead(const Slice& slice, int row, NodeSet& nodes) const
  {
    const Range<int>& work = slice.work[std::size_t(row)];
    if (work.Empty())
    {
      return;
    }
    for (const Plane& plane : slice.planes)
    {
      const std::vector<int>& index = plane.rayColumns.index;
      const Range<int> columns{ index[std::size_t(work.begin)],
        index[std::size_t(work.end) - 1] + 2 };
      const int v = plane.rayRows.index[std::size_t(row)];
      for (const int node : plane.nodes)
      {
        this->Mark(node, v, columns, nodes);
        this->Mark(node, v + 1, columns, nodes);
      }
    }
  }

  void MarkUpdated(const Slice& slice, const Occupancy& occupancy, NodeSet& nodes) const
  {
    if (slice.node < 0)
    {
      return;
    }
    for (int v = slice.ownedRows.begin; v < slice.ownedRows.end; ++v)
    {
      const Range<int> filled = SpansOf(this->Source, occupancy, slice.node, v).filled;
      const Range<int> seen = this->Source.VoxelColumns(slice, v);
      this->Mark(
        slice.node, v, Intersection(Intersection(seen, slice.ownedColumns), filled), nodes);
    }
  }

private:
  const FaceFrustum& Source;
  Index StrideU;
  Index StrideV;
  Index StrideW;
};
}

double CountOf(const NodeSet& nodes)
{
  return std::accumulate(nodes.begin(), nodes.end(), 0.0);
}

void Add(const NodeSet& more, NodeSet& nodes)
{
  std::transform(nodes.begin(), nodes.end(), more.begin(), nodes.begin(),
    [](unsigned char a, unsigned char b) { return static_cast<unsigned char>(a | b); });
}

SweepCounts CountSweep(const Problem& problem, const RaySource& eye)
{
  const NodeSet none(std::size_t(problem.grid.NodeCount()), 0);
  SweepCounts counts{ 0, none, 0, none };
  const std::vector<FaceFrustum> frusta =
    PlanSweep(problem.grid, *problem.occupancy, eye, problem.settings.rayDensity);
  for (const FaceFrustum& frustum : frusta)
  {
    const Marker marker(problem.grid, frustum);
    NodeSet read = none;
    for (int s = 0; s <= frustum.LastSlice(); ++s)
    {
      const Slice& slice = frustum.slices[std::size_t(s)];
      marker.MarkUpdated(slice, *problem.occupancy, counts.updated);
      for (int row = 0; s < frustum.LastSlice() && row < frustum.rows; ++row)
      {
        const Range<int>& work = slice.work[std::size_t(row)];
        counts.samples += std::max(0, work.end - work.begin);
        marker.MarkRead(slice, row, read);
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
