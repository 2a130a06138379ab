// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/ActiveSpans.h"

#include "backend/Backend.h"
#include "backend/Simd.h"
#include "sweep/OccupiedRays.h"
#include "sweep/Registers.h"
#include "sweep/SliceReaders.h"

#include <algorithm>
#include <vector>

namespace limpid
{
namespace
{
/// Extends spans of columns by the spans on another slice.
LIMPID_MULTIVERSION
void ExtendRows(const ColumnSpans& by, int count, const ColumnSpans& spans)
{
  const int* __restrict otherBegins = by.begins;
  const int* __restrict otherEnds = by.ends;
  int* __restrict begins = spans.begins;
  int* __restrict ends = spans.ends;
  for (int i = 0; i < count; ++i)
  {
    begins[i] = otherBegins[i] < begins[i] ? otherBegins[i] : begins[i];
    ends[i] = otherEnds[i] > ends[i] ? otherEnds[i] : ends[i];
  }
}

/// Rays that have not entered the box at a given depth.
struct Outside
{
  Range<int> columns;      ///< columns that are outside in all rows
  const float* rowEntries; ///< in rows that enter behind the depth, all columns are outside
  float depth;
};

/// Extends `needed` by the carried spans, then restricts these to rays still outside the box.
LIMPID_MULTIVERSION
void CarryRows(const Outside& outside, int count, int columns, const ColumnSpans& carried,
  Range<int>* __restrict needed)
{
  int* __restrict begins = carried.begins;
  int* __restrict ends = carried.ends;
  const float* __restrict entries = outside.rowEntries;
  const float depth = outside.depth;
  const Range<int> some = outside.columns;
  for (int i = 0; i < count; ++i)
  {
    const bool any = needed[i].begin < needed[i].end;
    const int begin = any && needed[i].begin < begins[i] ? needed[i].begin : begins[i];
    const int end = any && needed[i].end > ends[i] ? needed[i].end : ends[i];
    needed[i].begin = begin;
    needed[i].end = end;
    const bool all = entries[i] > depth;
    const int low = all ? 0 : some.begin;
    const int high = all ? columns : some.end;
    const int first = begin > low ? begin : low;
    const int last = end < high ? end : high;
    begins[i] = first < last ? first : noColumn;
    ends[i] = first < last ? last : -noColumn;
  }
}

/// Restricts `active` to the columns of `near` that touch filled voxels in front of a layer or
/// behind it, and widens it to whole registers of `columns`.
LIMPID_MULTIVERSION
void CutRows(const ColumnSpans& front, const ColumnSpans& back, int count, const Range<int>& near,
  const Range<int>& columns, Range<int>* __restrict active)
{
  const int* __restrict frontBegins = front.begins;
  const int* __restrict frontEnds = front.ends;
  const int* __restrict backBegins = back.begins;
  const int* __restrict backEnds = back.ends;
  const Range<int> all = columns;
  const Range<int> some = near;
  for (int i = 0; i < count; ++i)
  {
    const int begin = frontBegins[i] < backBegins[i] ? frontBegins[i] : backBegins[i];
    const int end = frontEnds[i] > backEnds[i] ? frontEnds[i] : backEnds[i];
    const Range<int> both = Intersection(Intersection(active[i], some), { begin, end });
    const Range<int> whole = WholeRegisters(both, all);
    active[i].begin = both.Empty() ? 0 : whole.begin;
    active[i].end = both.Empty() ? 0 : whole.end;
  }
}

/// The hull of the rays that are visited.
struct VisitedRays
{
  Range<int> columns;
  Range<int> rows;
};

LIMPID_MULTIVERSION
VisitedRays ExtentOf(const Range<int>* active, int count)
{
  int begin = noColumn;
  int end = -noColumn;
  int firstRow = noColumn;
  int lastRow = -noColumn;
  for (int i = 0; i < count; ++i)
  {
    const bool some = active[i].begin < active[i].end;
    const int first = some ? active[i].begin : noColumn;
    const int last = some ? active[i].end : -noColumn;
    const int early = some ? i : noColumn;
    const int late = some ? i : -noColumn;
    begin = first < begin ? first : begin;
    end = last > end ? last : end;
    firstRow = early < firstRow ? early : firstRow;
    lastRow = late > lastRow ? late : lastRow;
  }
  return { { begin, end }, { firstRow, lastRow + 1 } };
}

/// Finds the active spans of a frustum.
class ActiveSpanFinder
{
public:
  ActiveSpanFinder(PlannedFrustum& frustum, const Occupancy& occupancy)
    : Target(frustum)
    , Skips(occupancy.Skips())
    , Slices(frustum.SliceCount())
    , Occupied(frustum, occupancy)
    , Blocks((frustum.rows + rowsPerBlock - 1) / rowsPerBlock)
    , Extents(std::size_t(this->Blocks))
  {
  }

  void Find()
  {
    this->FindFirstRows();
    this->ForBlocks([&](Index block, const Range<int>& rows)
      { this->FollowToFront(this->Target.LayersOfBlock(block), rows); });
    this->ForBlocks(
      [&](Index block, const Range<int>& rows)
      {
        Extent& extent = this->Extents[std::size_t(block)];
        extent.slices = this->Target.LayersOfBlock(block);
        this->Activate(extent.slices, rows);
        this->FollowToBack(rows, extent);
      });
    this->FindTouched();
  }

private:
  /// What a block of rows visits.
  struct Extent
  {
    Range<int> slices;             ///< those that describe any row of the block
    std::vector<VisitedRays> rays; ///< per slice of these
  };

  /// Calls visit(block, rows) for all blocks of rows, in parallel.
  template <class Visit>
  void ForBlocks(const Visit& visit)
  {
    ParallelFor(this->Blocks,
      [&](Index block)
      {
        const int first = static_cast<int>(block) * rowsPerBlock;
        visit(block, Range<int>{ first, std::min(first + rowsPerBlock, this->Target.rows) });
      });
  }

  Range<int>* ActiveOf(int s, int row)
  {
    return this->Target.Room(this->Target.activeRays, s) +
      (row - this->Target.SliceAt(s).rayRows.begin);
  }

  /// Those of some rows that a slice describes.
  Range<int> RowsOn(int s, const Range<int>& rows) const
  {
    const Range<int> some = Intersection(rows, this->Target.SliceAt(s).rayRows);
    return some.Empty() ? Range<int>{} : some;
  }

  static ColumnSpans From(const ColumnSpans& spans, Index row)
  {
    return { spans.begins + row, spans.ends + row };
  }

  /// Extends the important spans of each slice by those of all slices behind it.
  void FollowToFront(const Range<int>& slices, const Range<int>& rows)
  {
    for (int s = slices.end - 2; s >= slices.begin; --s)
    {
      const Range<int> both = this->RowsOn(s + 1, this->RowsOn(s, rows));
      ExtendRows(From(this->Occupied.Important(s + 1), both.begin), both.Length(),
        From(this->Occupied.Important(s), both.begin));
    }
  }

  /// Finds the first row of voxels that reads each row of rays, see FaceFrustum::firstVoxels.
  void FindFirstRows()
  {
    const int perSlice = this->Target.activeRays.rowLength + 1;
    this->FirstRows.resize(std::size_t(this->Slices) * std::size_t(perSlice));
    ParallelFor(this->Slices,
      [&](Index s)
      {
        if (this->IsRead(static_cast<int>(s)))
        {
          FindFirstTargets(this->Target.Row(this->Target.voxelRows, s).index, this->Target.nodesV,
            this->Target.SliceAt(s).rayRows, this->FirstRows.data() + s * perSlice);
        }
      });
  }

  /// Whether voxels of a slice read rays.
  bool IsRead(int s) const { return this->Target.HasVoxels() && this->Target.SliceAt(s).node >= 0; }

  /// Finds the active columns of every row: the needed ones, and all rays whose transmittance
  /// voxels read together with them. Rays that are active on a slice stay active on all slices in
  /// front of it.
  void Activate(const Range<int>& slices, const Range<int>& rows)
  {
    for (int s = slices.end - 1; s >= slices.begin; --s)
    {
      const Range<int> here = this->RowsOn(s, rows);
      if (!this->Skips)
      {
        std::fill_n(
          this->ActiveOf(s, here.begin), here.Length(), this->Target.SliceAt(s).rayColumns);
        continue;
      }
      const Range<int> behind = s + 1 < this->Slices ? this->RowsOn(s + 1, here) : Range<int>{};
      Range<int>* active = this->ActiveOf(s, 0);
      const ColumnSpans needed = this->Occupied.Important(s);
      for (int row = here.begin; row < here.end; ++row)
      {
        const Range<int> own{ needed.begins[row], needed.ends[row] };
        active[row] = behind.Contains(row) ? Hull(own, *this->ActiveOf(s + 1, row)) : own;
      }
      if (this->IsRead(s))
      {
        const SliceReaders readers = this->ReadersOf(s);
        for (int row = here.begin; row < here.end; ++row)
        {
          active[row] = Hull(active[row], readers.ReadWithNeeded(row));
        }
      }
    }
  }

  SliceReaders ReadersOf(int s) const
  {
    return { this->Target, s,
      this->FirstRows.data() + Index(s) * (this->Target.activeRays.rowLength + 1),
      this->Occupied.Important(s) };
  }

  /// Keeps rays that are needed in front of the box active until they enter it, because their
  /// optical depth counts from the entry (RaySteps.h).
  void FollowToBack(const Range<int>& rows, Extent& extent)
  {
    int begins[rowsPerBlock];
    int ends[rowsPerBlock];
    std::fill_n(begins, rowsPerBlock, noColumn);
    std::fill_n(ends, rowsPerBlock, -noColumn);
    const ColumnSpans carried{ begins, ends };
    for (int s = extent.slices.begin; s < extent.slices.end; ++s)
    {
      const Range<int> here = this->RowsOn(s, rows);
      const int next = std::min(s + 1, this->Slices - 1);
      const Range<int> both = this->RowsOn(next, here);
      const Slice& behind = this->Target.SliceAt(next);
      const Outside outside{ behind.outsideColumns,
        this->Target.Row(this->Target.rowEntry) + here.begin, behind.RelativeDepth() };
      CarryRows(outside, here.Length(), this->Target.columns,
        From(carried, here.begin - rows.begin), this->ActiveOf(s, here.begin));
      this->Cut(s, s, { here.begin, both.Empty() ? here.end : both.begin });
      this->Cut(s, next, both);
      this->Cut(s, s, { both.Empty() ? here.end : both.end, here.end });
      const VisitedRays rays = ExtentOf(this->ActiveOf(s, here.begin), here.Length());
      extent.rays.push_back(
        { rays.columns, { here.begin + rays.rows.begin, here.begin + rays.rows.end } });
    }
  }

  /// Restricts the active columns of some rows to those near the box that touch filled voxels on
  /// slice `s` or on slice `next`.
  void Cut(int s, int next, const Range<int>& rows)
  {
    const Slice& slice = this->Target.SliceAt(s);
    for (int row = rows.begin; row < rows.end; ++row)
    {
      if (!slice.nearRows.Contains(row))
      {
        *this->ActiveOf(s, row) = {};
      }
    }
    const Range<int> near = Intersection(rows, slice.nearRows);
    if (!near.Empty())
    {
      CutRows(From(this->Occupied.Filled(s), near.begin),
        From(this->Occupied.Filled(next), near.begin), near.Length(), slice.nearColumns,
        slice.rayColumns, this->ActiveOf(s, near.begin));
    }
  }

  /// Finds the voxels that a sweep reads or writes on each slice.
  void FindTouched()
  {
    Slice* slices = this->Target.Room(this->Target.slices);
    for (int s = 0; s < this->Slices; ++s)
    {
      slices[s].touchedColumns = slices[s].ownedColumns;
      slices[s].touchedRows = slices[s].ownedRows;
    }
    std::vector<VisitedRays> visited(std::size_t(this->Slices));
    for (const Extent& extent : this->Extents)
    {
      for (std::size_t i = 0; i < extent.rays.size(); ++i)
      {
        VisitedRays& rays = visited[std::size_t(extent.slices.begin) + i];
        rays.columns = Hull(rays.columns, extent.rays[i].columns);
        rays.rows = Hull(rays.rows, extent.rays[i].rows);
      }
    }
    for (int s = 0; s + 1 < this->Slices; ++s)
    {
      const Range<int>& columns = visited[std::size_t(s)].columns;
      const Range<int>& rows = visited[std::size_t(s)].rows;
      for (int plane = 2 * s; plane < 2 * s + 2; ++plane)
      {
        const int* columnIndex = this->Target.PlaneColumns(plane).index;
        const int* rowIndex = this->Target.PlaneRows(plane).index;
        for (Slice* slice : { &slices[s], &slices[s + 1] })
        {
          slice->touchedColumns =
            Hull(slice->touchedColumns, SourcesOf(columnIndex, columns, this->Target.nodesU));
          slice->touchedRows =
            Hull(slice->touchedRows, SourcesOf(rowIndex, rows, this->Target.nodesV));
        }
      }
    }
  }

  /// Returns the voxels that a range of rays reads on a plane of a layer, widened by one voxel on
  /// either side, as layers are also sampled at other points (ResolvedRay).
  static Range<int> SourcesOf(const int* index, const Range<int>& rays, int voxels)
  {
    return rays.Empty()
      ? Range<int>{}
      : Grown(Range<int>{ index[rays.begin], index[rays.end - 1] + 2 }, 1, voxels);
  }

  PlannedFrustum& Target;
  bool Skips;
  int Slices;
  OccupiedRays Occupied;
  Index Blocks;
  std::vector<Extent> Extents; ///< [block]
  std::vector<int> FirstRows;  ///< [slice][row of Slice::rayRows]
};
}

void FindActiveSpans(PlannedFrustum& frustum, const Occupancy& occupancy)
{
  ActiveSpanFinder(frustum, occupancy).Find();
}
}
