// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The rays that voxels read together with others, for the processor and for devices.

#ifndef limpid_sweep_SliceReaders_h
#define limpid_sweep_SliceReaders_h

#include "sweep/ColumnSpans.h"
#include "sweep/FaceFrustum.h"

namespace limpid
{
/// The voxels of a slice along one axis that read its rays.
class AxisReaders
{
public:
  Range<int> owned;    ///< voxels that the frustum owns
  Range<int> sides[2]; ///< owned voxels that are not between rays that enter in front

  /// `index`: of the map from voxels to rays; `firstVoxels`: see FaceFrustum::firstVoxels;
  /// `front`: rays that enter in front; `described`: rays that the slice describes.
  LIMPID_HD LIMPID_INLINE AxisReaders(const int* index, const int* firstVoxels, int nodes,
    const Range<int>& ownVoxels, const Range<int>& front, const Range<int>& described)
    : owned(ownVoxels)
    , FirstRays(index)
    , FirstVoxels(firstVoxels)
    , Nodes(nodes)
  {
    Range<int> inFront{ ownVoxels.end, ownVoxels.end };
    if (!front.Empty())
    {
      const Range<int> between{ this->FirstOf(front.begin, described),
        this->FirstOf(front.end - 1, described) };
      inFront = between.Empty() ? inFront : between;
    }
    this->sides[0] = Intersection(ownVoxels, Range<int>{ 0, inFront.begin });
    this->sides[1] = Intersection(ownVoxels, Range<int>{ inFront.end, nodes });
  }

  /// Returns the rays that a voxel reads together with any of `rays`. A voxel reads the rays
  /// around itself and around its neighbours (VoxelRow::FindSeen).
  LIMPID_HD LIMPID_INLINE Range<int> ReadWith(
    const Range<int>& rays, const Range<int>& voxels) const
  {
    const Range<int> read = Intersection(rays, this->ReadBy(voxels));
    if (read.Empty())
    {
      return {};
    }
    const int before = read.begin > 0 ? read.begin - 1 : 0;
    return this->ReadBy(Intersection(
      voxels, Range<int>{ this->FirstVoxels[before] - 1, this->FirstVoxels[read.end] + 1 }));
  }

private:
  LIMPID_HD LIMPID_INLINE int FirstOf(int ray, const Range<int>& described) const
  {
    const int notBefore = ray > described.begin ? ray : described.begin;
    return this->FirstVoxels[notBefore < described.end ? notBefore : described.end];
  }

  LIMPID_HD LIMPID_INLINE Range<int> ReadBy(const Range<int>& voxels) const
  {
    if (voxels.Empty())
    {
      return {};
    }
    const int first = voxels.begin > 0 ? voxels.begin - 1 : 0;
    const int last = voxels.end < this->Nodes ? voxels.end : this->Nodes - 1;
    return { this->FirstRays[first], this->FirstRays[last] + 2 };
  }

  const int* FirstRays;
  const int* FirstVoxels;
  int Nodes;
};

/// The voxels of a slice that read its rays.
class SliceReaders
{
public:
  /// `firstRows`: FaceFrustum::firstVoxels for rows; `needed`: rays that have importance behind
  /// them.
  LIMPID_HD LIMPID_INLINE SliceReaders(
    const FaceFrustum& frustum, int s, const int* firstRows, const ColumnSpans& needed)
    : SliceReaders(frustum, frustum.SliceAt(s), s, firstRows, needed)
  {
  }

  /// Returns the rays of a row whose transmittance voxels read together with needed rays. This
  /// matters between rays that enter through a side, even if such a ray sees nothing: there the
  /// mean over rays is scaled (VoxelRow::FindSeen).
  LIMPID_HD LIMPID_INLINE Range<int> ReadWithNeeded(int row) const
  {
    const Range<int> here = this->NeededBy(this->Rows.owned, row);
    Range<int> read;
    for (int side = 0; side < 2 && !here.Empty(); ++side)
    {
      const Range<int> there = this->NeededBy(this->Rows.sides[side], row);
      read = Hull(read, this->Columns.ReadWith(there, this->Columns.owned));
      read = Hull(read, this->Columns.ReadWith(here, this->Columns.sides[side]));
    }
    return read;
  }

private:
  LIMPID_HD LIMPID_INLINE SliceReaders(const FaceFrustum& frustum, const Slice& slice, int s,
    const int* firstRows, const ColumnSpans& needed)
    : Rows(frustum.Row(frustum.voxelRows, s).index, firstRows - slice.rayRows.begin, frustum.nodesV,
        slice.ownedRows, frustum.frontRows, slice.rayRows)
    , Columns(frustum.Row(frustum.voxelColumns, s).index, frustum.FirstVoxels(s), frustum.nodesU,
        slice.ownedColumns, frustum.frontColumns, slice.rayColumns)
    , Needed(needed)
  {
  }

  /// Returns the hull of the needed columns in all rows that voxels read together with this row.
  LIMPID_HD LIMPID_INLINE Range<int> NeededBy(const Range<int>& voxels, int row) const
  {
    const Range<int> read = this->Rows.ReadWith(Range<int>{ row, row + 1 }, voxels);
    Range<int> hull{ noColumn, -noColumn };
    for (int other = read.begin; other < read.end; ++other)
    {
      const int begin = this->Needed.begins[other];
      const int end = this->Needed.ends[other];
      hull = { begin < hull.begin ? begin : hull.begin, end > hull.end ? end : hull.end };
    }
    return hull;
  }

  AxisReaders Rows;
  AxisReaders Columns;
  ColumnSpans Needed;
};
}

#endif
