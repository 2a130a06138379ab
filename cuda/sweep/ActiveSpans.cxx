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

  /// `front`: rays that enter in front.
  AxisReaders(const int* indices, const int* first, int count, const Range<int>& ownVoxels,
    const Range<int>& front)
    : index(indices)
    , firstVoxels(first)
    , nodes(count)
    , owned(ownVoxels)
  {
    const Range<int> between =
      front.Empty() ? Range<int>{} : Range<int>{ first[front.begin], first[front.end - 1] };
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

/// Restricts `active` to columns that touch filled voxels in front of a layer or behind it.
LIMPID_MULTIVERSION
void CutRows(const ColumnSpans& front, const ColumnSpans& back, int count,
  const Range<int>& columns, Range<int>* __restrict active)
{
  const int* __restrict frontBegins = front.begins;
  const int* __restrict frontEnds = front.ends;
  const int* __restrict backBegins = back.begins;
  const int* __restrict backEnds = back.ends;
  const Range<int> all = columns;
  for (int i = 0; i < count; ++i)
  {
    const int begin = frontBegins[i] < backBegins[i] ? frontBegins[i] : backBegins[i];
    const int end = frontEnds[i] > backEnds[i] ? frontEnds[i] : backEnds[i];
    const Range<int> both = Intersection(active[i], { begin, end });
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
    , Extents(std::size_t(this->Blocks * frustum.SliceCount()))
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
        this->FollowToBack(rows, this->Extents.data() + block * this->Slices);
      });
    this->FindTouched();
  }

private:
  static constexpr int rowsPerBlock = 64;

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
    return this->Target.Room(this->Target.activeRays, s) + row;
  }

  static ColumnSpans From(const ColumnSpans& spans, int row)
  {
    return { spans.begins + row, spans.ends + row };
  }

  /// Extends the important spans of each slice by those of all slices behind it.
  void FollowToFront(const Range<int>& rows)
  {
    for (int s = this->Slices - 2; s >= 0; --s)
    {
      ExtendRows(From(this->Occupied.Important(s + 1), rows.begin), rows.end - rows.begin,
        From(this->Occupied.Important(s), rows.begin));
    }
  }

  /// Finds the first row of voxels that reads each row of rays, see FaceFrustum::firstVoxels.
  void FindFirstRows()
  {
    this->FirstRows.resize(std::size_t(this->Slices) * std::size_t(this->Target.rows + 1));
    ParallelFor(this->Slices,
      [&](Index s)
      {
        if (this->IsRead(static_cast<int>(s)))
        {
          FindFirstTargets(this->Target.Row(this->Target.voxelRows, s).index, this->Target.nodesV,
            this->Target.rows, this->FirstRows.data() + s * (this->Target.rows + 1));
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
    const int count = rows.end - rows.begin;
    if (!this->Skips)
    {
      for (int s = 0; s < this->Slices; ++s)
      {
        std::fill_n(this->ActiveOf(s, rows.begin), count, Range<int>{ 0, this->Target.columns });
      }
      return;
    }
    for (int s = this->Slices - 1; s >= 0; --s)
    {
      const Range<int>* behind = s + 1 < this->Slices ? this->ActiveOf(s + 1, 0) : nullptr;
      Range<int>* active = this->ActiveOf(s, 0);
      const ColumnSpans needed = this->Occupied.Important(s);
      for (int row = rows.begin; row < rows.end; ++row)
      {
        const Range<int> here{ needed.begins[row], needed.ends[row] };
        active[row] = behind ? Hull(here, behind[row]) : here;
      }
      if (this->IsRead(s))
      {
        const SliceReaders readers = this->ReadersOf(s);
        for (int row = rows.begin; row < rows.end; ++row)
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
    return { AxisReaders(frustum.Row(frustum.voxelRows, s).index,
               this->FirstRows.data() + Index(s) * (frustum.rows + 1), frustum.nodesV,
               slice.ownedRows, frustum.frontRows),
      AxisReaders(frustum.Row(frustum.voxelColumns, s).index, frustum.Row(frustum.firstVoxels, s),
        frustum.nodesU, slice.ownedColumns, frustum.frontColumns),
      this->Occupied.Important(s) };
  }

  /// Keeps rays that are needed in front of the box active until they enter it, because their
  /// optical depth counts from the entry (RaySteps.h). `extents`: per slice.
  void FollowToBack(const Range<int>& rows, VisitedRays* extents)
  {
    const int count = rows.end - rows.begin;
    const Range<int> columns{ 0, this->Target.columns };
    int begins[rowsPerBlock];
    int ends[rowsPerBlock];
    std::fill_n(begins, rowsPerBlock, noColumn);
    std::fill_n(ends, rowsPerBlock, -noColumn);
    const ColumnSpans carried{ begins, ends };
    for (int s = 0; s < this->Slices; ++s)
    {
      Range<int>* active = this->ActiveOf(s, rows.begin);
      const int next = std::min(s + 1, this->Slices - 1);
      const Outside outside{ this->Outsides[std::size_t(next)],
        this->Target.Row(this->Target.rowEntry) + rows.begin,
        this->Target.SliceAt(next).RelativeDepth() };
      CarryRows(outside, count, columns.end, carried, active);
      CutRows(From(this->Occupied.Filled(s), rows.begin),
        From(this->Occupied.Filled(next), rows.begin), count, columns, active);
      const VisitedRays extent = ExtentOf(active, count);
      extents[s] = { extent.columns,
        { rows.begin + extent.rows.begin, rows.begin + extent.rows.end } };
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
    for (int s = 0; s + 1 < this->Slices; ++s)
    {
      Range<int> rows;
      Range<int> columns;
      for (Index block = 0; block < this->Blocks; ++block)
      {
        const VisitedRays& extent = this->Extents[std::size_t(block * this->Slices + s)];
        columns = Hull(columns, extent.columns);
        rows = Hull(rows, extent.rows);
      }
      for (Index plane = 2 * Index(s); plane < 2 * Index(s) + 2; ++plane)
      {
        const int* columnIndex = this->Target.Row(this->Target.planeColumns, plane).index;
        const int* rowIndex = this->Target.Row(this->Target.planeRows, plane).index;
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
  std::vector<VisitedRays> Extents; ///< [block][slice]
  std::vector<int> FirstRows;       ///< [slice][row]
};
}

void FindActiveSpans(PlannedFrustum& frustum, const Occupancy& occupancy, Readers readers)
{
  ActiveSpanFinder(frustum, occupancy, readers).Find();
}
}
