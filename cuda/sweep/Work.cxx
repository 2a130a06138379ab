// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/Work.h"

#include "backend/Backend.h"

#include <algorithm>

namespace limpid
{
namespace
{
/// Rays that voxels in `voxels` are interpolated from, or that touch these voxels anywhere in the
/// layers on both sides of a slice, where no ray moves by more than one voxel. `nodes`: floor of
/// the rays' positions on the slice, ascending.
Interval RaysThatTouch(const Interval& voxels, const std::vector<int>& nodes)
{
  if (voxels.Empty())
  {
    return {};
  }
  const auto begin = std::lower_bound(nodes.begin(), nodes.end(), voxels.begin - 2);
  const auto end = std::upper_bound(nodes.begin(), nodes.end(), voxels.end);
  const int first = static_cast<int>(begin - nodes.begin()) - 1;
  const int last = static_cast<int>(end - nodes.begin()) + 1;
  return { std::max(0, first), std::min(static_cast<int>(nodes.size()), last) };
}

/// Finds what the rays of a pyramid have to visit, see Station::work.
class WorkFinder
{
public:
  WorkFinder(Pyramid& pyramid, const Occupancy& occupancy, const Lateral& u, const Lateral& v)
    : Target(pyramid)
    , Source(occupancy)
    , Columns(u)
    , RowsOfRays(v)
    , Rows(std::size_t(pyramid.rows))
  {
  }

  void Find()
  {
    const std::size_t count = this->Target.stations.size();
    std::vector<std::vector<Interval>> filled(count, std::vector<Interval>(this->Rows));
    std::vector<std::vector<Interval>> needed(count, std::vector<Interval>(this->Rows));
    ParallelFor(static_cast<Index>(count),
      [&](Index station)
      {
        this->FindOccupied(
          std::size_t(station), filled[std::size_t(station)], needed[std::size_t(station)]);
      });
    const Interval all{ 0, this->Target.columns };
    if (!this->Source.Skips())
    {
      for (std::vector<Interval>& rows : needed)
      {
        std::fill(rows.begin(), rows.end(), all);
      }
    }
    else
    {
      FollowToFront(needed);
      for (std::vector<Interval>& rows : needed)
      {
        rows = this->Widened(rows);
      }
      this->FollowToEntry(needed);
    }
    for (std::size_t s = 0; s < count; ++s)
    {
      Station& station = this->Target.stations[s];
      station.work.resize(this->Rows);
      for (std::size_t row = 0; row < this->Rows; ++row)
      {
        const Interval touched =
          s + 1 < count ? Hull(filled[s][row], filled[s + 1][row]) : filled[s][row];
        station.work[row] = FilledRegisters(Intersection(needed[s][row], touched), all);
      }
    }
    this->FindTouched();
  }

private:
  /// Voxels that a sweep reads or writes on each slice.
  void FindTouched() const
  {
    std::vector<Station>& stations = this->Target.stations;
    for (Station& station : stations)
    {
      station.touchedColumns = station.ownedColumns;
      station.touchedRows = station.ownedRows;
    }
    for (std::size_t s = 0; s + 1 < stations.size(); ++s)
    {
      Interval rows;
      Interval columns;
      for (int row = 0; row < this->Target.rows; ++row)
      {
        const Interval& work = stations[s].work[std::size_t(row)];
        columns = Hull(columns, work);
        rows = work.Empty() ? rows : Hull(rows, { row, row + 1 });
      }
      for (const Plane& plane : stations[s].planes)
      {
        for (Station* station : { &stations[s], &stations[s + 1] })
        {
          station->touchedColumns =
            Hull(station->touchedColumns, SourcesOf(plane.rayColumns, columns));
          station->touchedRows = Hull(station->touchedRows, SourcesOf(plane.rayRows, rows));
        }
      }
    }
  }

  /// Sources that the targets in an interval of a map with ascending indices read.
  static Interval SourcesOf(const LinearMap& map, const Interval& targets)
  {
    return targets.Empty() ? Interval{}
                           : Interval{ map.index[std::size_t(targets.begin)],
                               map.index[std::size_t(targets.end) - 1] + 2 };
  }

  void FindOccupied(
    std::size_t s, std::vector<Interval>& filled, std::vector<Interval>& important) const
  {
    const Station& station = this->Target.stations[s];
    if (station.slice < 0)
    {
      // All rays start in the eye's cell; whatever it holds, the piece is short.
      std::fill(filled.begin(), filled.end(), Interval{ 0, this->Target.columns });
      return;
    }
    const std::vector<int> nodes = this->RowsOfRays.RayNodes(station.depth);
    const std::vector<int> columnNodes = this->Columns.RayNodes(station.depth);
    const int rowCount = this->Target.rows;
    const int lastVoxel = this->Target.nodesV - 1;
    for (int row = 0; row < rowCount; ++row)
    {
      const int low = row > 0 ? nodes[std::size_t(row - 1)] - 1 : 0;
      const int high = row + 1 < rowCount ? nodes[std::size_t(row) + 1] + 2 : lastVoxel;
      Interval filledVoxels;
      Interval importantVoxels;
      for (int v = std::max(low, 0); v <= std::min(high, lastVoxel); ++v)
      {
        const Occupancy::Spans& spans = SpansOf(this->Target, this->Source, station.slice, v);
        filledVoxels = Hull(filledVoxels, spans.filled);
        importantVoxels = Hull(importantVoxels, spans.important);
      }
      filled[std::size_t(row)] = RaysThatTouch(filledVoxels, columnNodes);
      important[std::size_t(row)] = RaysThatTouch(importantVoxels, columnNodes);
    }
  }

  /// What is important on a slice is at stake on all slices in front of it.
  static void FollowToFront(std::vector<std::vector<Interval>>& needed)
  {
    for (std::size_t s = needed.size(); s-- > 1;)
    {
      for (std::size_t row = 0; row < needed[s].size(); ++row)
      {
        needed[s - 1][row] = Hull(needed[s - 1][row], needed[s][row]);
      }
    }
  }

  /// A ray that is needed before it has entered the box is needed until it has: its optical depth
  /// there is counted from the entry (Rows.h).
  void FollowToEntry(std::vector<std::vector<Interval>>& needed) const
  {
    for (std::size_t s = 0; s + 1 < needed.size(); ++s)
    {
      const float depth = this->Target.stations[s + 1].relativeDepth;
      const Interval outside = this->ColumnsOutside(depth);
      for (std::size_t row = 0; row < this->Rows; ++row)
      {
        const Interval columns = needed[s][row];
        const bool rowOutside = this->Target.rowAxis.entry[row] > depth;
        needed[s + 1][row] =
          Hull(needed[s + 1][row], rowOutside ? columns : Intersection(columns, outside));
      }
    }
  }

  /// Columns of rays that enter the box in u behind a depth. They are neighbours, as these rays all
  /// come from the same side.
  Interval ColumnsOutside(float depth) const
  {
    const std::vector<float>& entry = this->Target.columnAxis.entry;
    Interval outside;
    for (int column = 0; column < this->Target.columns; ++column)
    {
      outside =
        entry[std::size_t(column)] > depth ? Hull(outside, { column, column + 1 }) : outside;
    }
    return outside;
  }

  /// One ray more on every side: voxels there read these rays, too.
  std::vector<Interval> Widened(const std::vector<Interval>& rows) const
  {
    std::vector<Interval> wider(rows.size());
    for (std::size_t row = 0; row < rows.size(); ++row)
    {
      Interval hull = rows[row];
      hull = row > 0 ? Hull(hull, rows[row - 1]) : hull;
      hull = row + 1 < rows.size() ? Hull(hull, rows[row + 1]) : hull;
      if (!hull.Empty())
      {
        hull = { std::max(hull.begin - 1, 0), std::min(hull.end + 1, this->Target.columns) };
      }
      wider[row] = hull;
    }
    return wider;
  }

  Pyramid& Target;
  const Occupancy& Source;
  const Lateral& Columns;
  const Lateral& RowsOfRays;
  std::size_t Rows;
};
}

void FindWork(Pyramid& pyramid, const Occupancy& occupancy, const Lateral& u, const Lateral& v)
{
  WorkFinder(pyramid, occupancy, u, v).Find();
}
}
