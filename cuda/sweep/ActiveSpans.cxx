// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/ActiveSpans.h"

#include "backend/Backend.h"
#include "backend/Simd.h"
#include "sweep/OccupiedRays.h"
#include "sweep/Registers.h"

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

/// The voxels of a slice along one axis that read its rays.
struct AxisReaders
{
  const int* index;       ///< of the map from voxels to rays
  const int* firstVoxels; ///< see FaceFrustum::firstVoxels
  int nodes;
  Range<int> owned;    ///< voxels that the frustum owns
  Range<int> sides[2]; ///< owned voxels that are not between rays that enter in front

  /// `front`: rays that enter in front; `described`: rays that the slice describes.
  AxisReaders(const int* indices, const int* first, int count, const Range<int>& ownVoxels,
    const Range<int>& front, const Range<int>& described)
    : index(indices)
    , firstVoxels(first)
    , nodes(count)
    , owned(ownVoxels)
  {
    const auto firstOf = [&](int ray)
    { return first[std::min(std::max(ray, described.begin), described.end)]; };
    const Range<int> between =
      front.Empty() ? Range<int>{} : Range<int>{ firstOf(front.begin), firstOf(front.end - 1) };
    const Range<int> inFront =
      between.Empty() ? Range<int>{ ownVoxels.end, ownVoxels.end } : between;
    this->sides[0] = Intersection(ownVoxels, { 0, inFront.begin });
    this->sides[1] = Intersection(ownVoxels, { inFront.end, count });
  }

  /// Returns the rays that a voxel reads together with any of `rays`. A voxel reads the rays
  /// around itself and around its neighbours (VoxelRow::FindSeen).
  Range<int> ReadWith(const Range<int>& rays, const Range<int>& voxels) const
  {
    const Range<int> read = Intersection(rays, this->ReadBy(voxels));
    if (read.Empty())
    {
      return {};
    }
    return this->ReadBy(Intersection(voxels,
      { this->firstVoxels[std::max(read.begin - 1, 0)] - 1, this->firstVoxels[read.end] + 1 }));
  }

private:
  Range<int> ReadBy(const Range<int>& voxels) const
  {
    return voxels.Empty() ? Range<int>{}
                          : Range<int>{ this->index[std::max(voxels.begin - 1, 0)],
                              this->index[std::min(voxels.end, this->nodes - 1)] + 2 };
  }
};

/// The voxels of a slice that read its rays.
struct SliceReaders
{
  AxisReaders rows;
  AxisReaders columns;
  ColumnSpans needed; ///< rays that have importance behind them

  /// Returns the rays of a row whose transmittance voxels read together with needed rays. This
  /// matters between rays that enter through a side, even if such a ray sees nothing: there the
  /// mean over rays is scaled (VoxelRow::FindSeen).
  Range<int> ReadWithNeeded(int row) const
  {
    const Range<int> here = this->NeededBy(this->rows.owned, row);
    Range<int> read;
    for (int side = 0; side < 2 && !here.Empty(); ++side)
    {
      const Range<int> there = this->NeededBy(this->rows.sides[side], row);
      read = Hull(read, this->columns.ReadWith(there, this->columns.owned));
      read = Hull(read, this->columns.ReadWith(here, this->columns.sides[side]));
    }
    return read;
  }

private:
  /// Returns the hull of the needed columns in all rows that voxels read together with this row.
  Range<int> NeededBy(const Range<int>& voxels, int row) const
  {
    const Range<int> read = this->rows.ReadWith({ row, row + 1 }, voxels);
    Range<int> hull{ noColumn, -noColumn };
    for (int other = read.begin; other < read.end; ++other)
    {
      hull = { std::min(hull.begin, this->needed.begins[other]),
        std::max(hull.end, this->needed.ends[other]) };
    }
    return hull;
  }
};

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
    const int begin = needed[i].begin < begins[i] ? needed[i].begin : begins[i];
    const int end = needed[i].end > ends[i] ? needed[i].end : ends[i];
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
  ActiveSpanFinder(PlannedFrustum& frustum, const Occupancy& occupancy, Readers readers)
    : Target(frustum)
    , ReadByVoxels(readers == Readers::RaysAndVoxels)
    , Skips(occupancy.Skips())
    , Slices(frustum.SliceCount())
    , Occupied(frustum, occupancy)
    , Outsides(this->FindOutsides())
    , Blocks((frustum.rows + rowsPerBlock - 1) / rowsPerBlock)
    , Extents(std::size_t(this->Blocks))
  {
  }

  void Find()
  {
    this->FindFirstRows();
    this->ForBlocks([&](Index, const Range<int>& rows) { this->FollowToFront(rows); });
    this->ForBlocks(
      [&](Index block, const Range<int>& rows)
      {
        this->Activate(rows);
        this->FollowToBack(rows, this->Extents[std::size_t(block)]);
      });
    this->FindTouched();
  }

private:
  static constexpr int rowsPerBlock = 64;

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

  /// Returns the columns of rays that enter the box in u behind each slice. They are contiguous,
  /// as these rays all come from the same side.
  std::vector<Range<int>> FindOutsides() const
  {
    const float* entry = this->Target.Row(this->Target.columnEntry);
    std::vector<Range<int>> outsides;
    Range<int> outside{ 0, this->Target.columns };
    for (int s = 0; s < this->Slices; ++s)
    {
      const float depth = this->Target.SliceAt(s).RelativeDepth();
      const auto inside = [&](int column) { return !(entry[column] > depth); };
      while (!outside.Empty() && inside(outside.begin))
      {
        ++outside.begin;
      }
      while (!outside.Empty() && inside(outside.end - 1))
      {
        --outside.end;
      }
      outsides.push_back(outside);
    }
    return outsides;
  }

  Range<int>* ActiveOf(int s, int row)
  {
    return this->Target.Room(this->Target.activeRays, s) +
      (row - this->Target.SliceAt(s).rayRows.begin);
  }

  /// Slices that describe any of some rows.
  Range<int> SlicesOf(const Range<int>& rows) const
  {
    Range<int> slices;
    for (int row = rows.begin; row < rows.end; ++row)
    {
      slices = Hull(slices, this->Target.LayersOf(row));
    }
    return slices;
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
  void FollowToFront(const Range<int>& rows)
  {
    const Range<int> slices = this->SlicesOf(rows);
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
  bool IsRead(int s) const { return this->ReadByVoxels && this->Target.SliceAt(s).node >= 0; }

  /// Finds the active columns of every row: the needed ones, and all rays whose transmittance
  /// voxels read together with them. Rays that are active on a slice stay active on all slices in
  /// front of it.
  void Activate(const Range<int>& rows)
  {
    const Range<int> slices = this->SlicesOf(rows);
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
    const FaceFrustum& frustum = this->Target;
    const Slice& slice = frustum.SliceAt(s);
    const int* firstRows =
      this->FirstRows.data() + Index(s) * (frustum.activeRays.rowLength + 1) - slice.rayRows.begin;
    return { AxisReaders(frustum.Row(frustum.voxelRows, s).index, firstRows, frustum.nodesV,
               slice.ownedRows, frustum.frontRows, slice.rayRows),
      AxisReaders(frustum.Row(frustum.voxelColumns, s).index, frustum.FirstVoxels(s),
        frustum.nodesU, slice.ownedColumns, frustum.frontColumns, slice.rayColumns),
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
    extent.slices = this->SlicesOf(rows);
    for (int s = extent.slices.begin; s < extent.slices.end; ++s)
    {
      const Range<int> here = this->RowsOn(s, rows);
      const int next = std::min(s + 1, this->Slices - 1);
      const Range<int> both = this->RowsOn(next, here);
      const Outside outside{ this->Outsides[std::size_t(next)],
        this->Target.Row(this->Target.rowEntry) + here.begin,
        this->Target.SliceAt(next).RelativeDepth() };
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
  bool ReadByVoxels;
  bool Skips;
  int Slices;
  OccupiedRays Occupied;
  std::vector<Range<int>> Outsides; ///< per slice
  Index Blocks;
  std::vector<Extent> Extents; ///< [block]
  std::vector<int> FirstRows;  ///< [slice][row of Slice::rayRows]
};
}

void FindActiveSpans(PlannedFrustum& frustum, const Occupancy& occupancy, Readers readers)
{
  ActiveSpanFinder(frustum, occupancy, readers).Find();
}
}
