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
/// A pyramid's slices and rows as nodes of the grid.
class Marker
{
public:
  Marker(const Grid& grid, const Pyramid& pyramid)
    : Source(pyramid)
  {
    const Index strides[3] = { 1, grid.nodes.x, Index(grid.nodes.x) * grid.nodes.y };
    this->StrideU = strides[pyramid.axisU];
    this->StrideV = strides[pyramid.axisV];
    this->StrideW = strides[pyramid.axisW];
  }

  void Mark(int slice, int v, const Interval& columns, NodeSet& nodes) const
  {
    for (int u = columns.begin; u < columns.end; ++u)
    {
      nodes[std::size_t(this->StrideW * slice + this->StrideV * v + this->StrideU * u)] = 1;
    }
  }

  /// What a row of rays reads in the layer behind a station.
  void MarkRead(const Station& station, int row, NodeSet& nodes) const
  {
    const Interval& work = station.work[std::size_t(row)];
    if (work.Empty())
    {
      return;
    }
    for (const Plane& plane : station.planes)
    {
      const std::vector<int>& index = plane.rayColumns.index;
      const Interval columns{ index[std::size_t(work.begin)],
        index[std::size_t(work.end) - 1] + 2 };
      const int v = plane.rayRows.index[std::size_t(row)];
      for (const int slice : plane.slices)
      {
        this->Mark(slice, v, columns, nodes);
        this->Mark(slice, v + 1, columns, nodes);
      }
    }
  }

  void MarkUpdated(const Station& station, const Occupancy& occupancy, NodeSet& nodes) const
  {
    if (station.slice < 0)
    {
      return;
    }
    for (int v = station.ownedRows.begin; v < station.ownedRows.end; ++v)
    {
      const Interval filled = SpansOf(this->Source, occupancy, station.slice, v).filled;
      const Interval seen = this->Source.VoxelColumns(station, v);
      this->Mark(
        station.slice, v, Intersection(Intersection(seen, station.ownedColumns), filled), nodes);
    }
  }

private:
  const Pyramid& Source;
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

SweepCounts CountSweep(const Problem& problem, const Eye& eye)
{
  const NodeSet none(std::size_t(problem.grid.NodeCount()), 0);
  SweepCounts counts{ 0, none, 0, none };
  const std::vector<Pyramid> pyramids =
    PlanSweep(problem.grid, *problem.occupancy, eye, problem.settings.rayDensity);
  for (const Pyramid& pyramid : pyramids)
  {
    const Marker marker(problem.grid, pyramid);
    NodeSet read = none;
    for (int s = 0; s <= pyramid.LastStation(); ++s)
    {
      const Station& station = pyramid.stations[std::size_t(s)];
      marker.MarkUpdated(station, *problem.occupancy, counts.updated);
      for (int row = 0; s < pyramid.LastStation() && row < pyramid.rows; ++row)
      {
        const Interval& work = station.work[std::size_t(row)];
        counts.samples += std::max(0, work.end - work.begin);
        marker.MarkRead(station, row, read);
      }
    }
    counts.readAgain += &pyramid == &pyramids.back() ? 0.0 : CountOf(read);
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
      const Interval filled = problem.occupancy->Row(0, y, z).filled;
      const auto first = nodes.begin() + line * count.x;
      std::fill(first + filled.begin, first + std::max(filled.begin, filled.end), 1);
    });
  return nodes;
}
}
