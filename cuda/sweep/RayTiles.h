// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The rays of a frustum cut into tiles, for a sweep in which rays depend on the voxels behind
// (SweepTiles.h): the voxels that a tile finds on each slice.

#ifndef limpid_sweep_RayTiles_h
#define limpid_sweep_RayTiles_h

#include "backend/Extent.h"
#include "sweep/FaceFrustum.h"

namespace limpid
{
/// Tiles are counted row by row.
struct RayTiles
{
  /// Of rays: a block of threads.
  static constexpr Extent size{ 32, 8 };

  int columns = 0; ///< of all rays
  int rows = 0;

  LIMPID_HD LIMPID_INLINE int Across() const
  {
    return (this->columns + size.columns - 1) / size.columns;
  }

  LIMPID_HD LIMPID_INLINE int Down() const { return (this->rows + size.rows - 1) / size.rows; }
  LIMPID_HD LIMPID_INLINE int Count() const { return this->Across() * this->Down(); }

  LIMPID_HD LIMPID_INLINE Range<int> ColumnsOf(int number) const
  {
    return Part(number % this->Across(), size.columns, this->columns);
  }

  LIMPID_HD LIMPID_INLINE Range<int> RowsOf(int number) const
  {
    return Part(number / this->Across(), size.rows, this->rows);
  }

  LIMPID_HD static LIMPID_INLINE Range<int> Part(int number, int length, int all)
  {
    return Intersection(Range<int>{ number * length, (number + 1) * length }, { 0, all });
  }
};

/// The voxels of every slice that tiles find: those that their rays read, and those that none reads
/// between them and the next tile.
struct VoxelsOfTiles
{
  RayTiles tiles;
  const Range<int>* ranges; ///< [slice][tile]: along u of tiles side by side, then along v

  LIMPID_HD LIMPID_INLINE const Range<int>& AlongU(int s, int number) const
  {
    return this->Slice(s)[number % this->tiles.Across()];
  }

  LIMPID_HD LIMPID_INLINE const Range<int>& AlongV(int s, int number) const
  {
    return this->Slice(s)[this->tiles.Across() + number / this->tiles.Across()];
  }

private:
  LIMPID_HD LIMPID_INLINE const Range<int>* Slice(int s) const
  {
    return this->ranges + Index(s) * (this->tiles.Across() + this->tiles.Down());
  }
};

/// Makes VoxelsOfTiles: `number` of a range on slice `s`.
struct MadeVoxelsOfTile
{
  FaceFrustum frustum;
  RayTiles tiles;
  Range<int>* ranges;

  Extent ExtentOfRanges() const
  {
    return { this->tiles.Across() + this->tiles.Down(), this->frustum.SliceCount() };
  }

  LIMPID_HD void operator()(int number, int s) const
  {
    const FaceFrustum& plan = this->frustum;
    const Slice& slice = plan.SliceAt(s);
    const int row = number - this->tiles.Across();
    this->ranges[Index(s) * (this->tiles.Across() + this->tiles.Down()) + number] = row < 0
      ? this->VoxelsOf(s,
          { plan.planeColumns, plan.Row(plan.columnLines), plan.columns, plan.nodesU },
          RayTiles::Part(number, RayTiles::size.columns, plan.columns), slice.ownedColumns)
      : this->VoxelsOf(s, { plan.planeRows, plan.Row(plan.rowLines), plan.rows, plan.nodesV },
          RayTiles::Part(row, RayTiles::size.rows, plan.rows), slice.ownedRows);
  }

private:
  /// Rays along one axis.
  struct Axis
  {
    const MapTable& planes; ///< see FaceFrustum
    const RayLine* lines;
    int count;
    int nodes;
  };

  /// The voxels of slice `s` along one axis that `rays` read of it, in the layers behind and in
  /// front of it, as far as they are `owned`; and those up to what the next rays read.
  LIMPID_HD LIMPID_INLINE Range<int> VoxelsOf(
    int s, const Axis& axis, const Range<int>& rays, const Range<int>& owned) const
  {
    const FaceFrustum& plan = this->frustum;
    const int first = s > 0 ? 2 * (s - 1) : 0; // two planes in a layer
    const int end = s < plan.lastSlice ? 2 * (s + 1) : 2 * s;
    Range<int> read{ owned.end, owned.begin };
    const auto add = [&](int begin, int last, int next)
    {
      next = rays.end < axis.count ? next : owned.end;
      const int behind = last + 2 > next ? last + 2 : next;
      read = { begin < read.begin ? begin : read.begin, behind > read.end ? behind : read.end };
    };
    const int beside = rays.end < axis.count ? rays.end : rays.end - 1;
    for (int plane = first; plane < end; ++plane)
    {
      const int* nodes = plan.Row(axis.planes, plane).index;
      add(nodes[rays.begin], nodes[rays.end - 1], nodes[beside]);
    }
    // Layers are also sampled elsewhere (ResolvedRay): as far as their ends.
    for (int slice = s; slice <= s + 1 && slice <= plan.lastSlice; ++slice)
    {
      const double depth = plan.SliceAt(slice).RelativeDepth();
      const auto nodeOf = [&](int ray)
      { return NodesAt(axis.lines[ray].At(depth), axis.nodes).first; };
      add(nodeOf(rays.begin), nodeOf(rays.end - 1), nodeOf(beside));
    }
    read.begin = rays.begin == 0 ? owned.begin : read.begin;
    const Range<int> found = Intersection(read, owned);
    return found.Empty() ? Range<int>{} : found;
  }
};
}

#endif
