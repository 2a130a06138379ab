// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Tiles of rays for a sweep in which rays depend on the voxels behind (SweepTiles.h): the voxels
// that each tile computes on each slice, and the phases in which it has work.

#ifndef limpid_sweep_RayTiles_h
#define limpid_sweep_RayTiles_h

#include "backend/DeviceArray.h"
#include "backend/Extent.h"
#include "sweep/FaceFrustum.h"
#include "sweep/PhaseLists.h"

#include <cstddef>
#include <memory>

namespace limpid
{
/// The decomposition of all rays into tiles, which are numbered row by row.
struct RayTiles
{
  /// Rays of a tile; a block has one thread per ray.
  static constexpr Extent size{ 32, 8 };

  int columns = 0; ///< number of columns of all rays
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

/// Whether columnsOf(row) has any of some columns for any of some rows.
template <class ColumnsOf>
LIMPID_HD LIMPID_INLINE bool AnyRowMeets(
  const Range<int>& rows, const Range<int>& columns, const ColumnsOf& columnsOf)
{
  for (int row = rows.begin; row < rows.end; ++row)
  {
    if (!Intersection(columnsOf(row), columns).Empty())
    {
      return true;
    }
  }
  return false;
}

/// Whether any of some rays is active in some layers.
LIMPID_HD LIMPID_INLINE bool AnyRayIsActive(const FaceFrustum& frustum, const Range<int>& layers,
  const Range<int>& columns, const Range<int>& rows)
{
  const Range<int> there = Intersection(layers, { 0, frustum.lastSlice + 1 });
  for (int s = there.begin; s < there.end; ++s)
  {
    if (AnyRowMeets(rows, columns, [&](int row) { return frustum.ActiveRays(s, row); }))
    {
      return true;
    }
  }
  return false;
}

/// Whether any of some voxels of a slice is active.
LIMPID_HD LIMPID_INLINE bool AnyVoxelIsActive(
  const FaceFrustum& frustum, int s, const Range<int>& columns, const Range<int>& rows)
{
  return AnyRowMeets(rows, columns, [&](int v) { return frustum.ActiveVoxels(s, v); });
}

/// The voxels that tiles compute on every slice: those that their rays read, and those between
/// them and the next tile that no ray reads.
struct VoxelsOfTiles
{
  RayTiles tiles;
  const Range<int>* ranges; ///< [slice][tile]: along u for tiles of a row, then along v

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

/// Computes entry `number` of VoxelsOfTiles on slice `s`.
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
          { plan.planeColumns, true, plan.Row(plan.columnLines), plan.columns, plan.nodesU },
          RayTiles::Part(number, RayTiles::size.columns, plan.columns), slice.ownedColumns)
      : this->VoxelsOf(s,
          { plan.planeRows, false, plan.Row(plan.rowLines), plan.rows, plan.nodesV },
          RayTiles::Part(row, RayTiles::size.rows, plan.rows), slice.ownedRows);
  }

private:
  /// The rays along one axis.
  struct Axis
  {
    const MapTable& planes; ///< see FaceFrustum
    bool isColumns;         ///< or rows
    const RayLine* lines;
    int count;
    int nodes;
  };

  /// Returns the `owned` voxels of slice `s` along one axis that `rays` read in the layers in
  /// front of and behind it, and those up to what the next rays read.
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
      // All rays beside those that the plan describes read the border that the last of them reads.
      const Slice& slice = plan.SliceAt(plane / 2);
      const Range<int>& described = axis.isColumns ? slice.rayColumns : slice.rayRows;
      const int* nodes = plan.Row(axis.planes, plane).index;
      const auto nodeOf = [&](int ray)
      {
        const int before = ray < described.end ? ray : described.end - 1;
        return nodes[before > described.begin ? before - described.begin : 0];
      };
      add(nodeOf(rays.begin), nodeOf(rays.end - 1), nodeOf(beside));
    }
    // Layers may be sampled at other points (ResolvedRay), up to their ends.
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

/// In phase `phase` of a back-to-front sweep the rays move to slice `lastSlice - phase`; in the
/// last phase they stay. Tells which tiles have work in a phase: rays whose image differs from that
/// of two slices before, or active voxels on the slice behind.
struct TileHasWork
{
  FaceFrustum frustum;
  VoxelsOfTiles voxels;

  static int PhasesOf(const FaceFrustum& frustum)
  {
    return frustum.SliceCount() - frustum.firstNodeSlice + 1;
  }

  LIMPID_HD LIMPID_INLINE bool operator()(int number, int phase) const
  {
    const int s = this->frustum.lastSlice - phase;
    return this->MovesRays(s, number) || this->FindsVoxels(s + 1, number);
  }

private:
  /// A ray changes if it is active in the layer behind the slice or in the one behind that. Its
  /// image must be renewed as long as the image of two slices before differs.
  LIMPID_HD LIMPID_INLINE bool MovesRays(int slice, int number) const
  {
    return slice >= this->frustum.firstNodeSlice &&
      AnyRayIsActive(this->frustum, { slice, slice + 3 }, this->voxels.tiles.ColumnsOf(number),
        this->voxels.tiles.RowsOf(number));
  }

  LIMPID_HD LIMPID_INLINE bool FindsVoxels(int s, int number) const
  {
    return s <= this->frustum.lastSlice &&
      AnyVoxelIsActive(
        this->frustum, s, this->voxels.AlongU(s, number), this->voxels.AlongV(s, number));
  }
};

/// The tiles that a back-to-front sweep visits in each phase, and the voxels that they compute.
template <class AnyDevice>
class TilePlan
{
public:
  TilePlan(const std::shared_ptr<AnyDevice>& device, const FaceFrustum& frustum)
    : Device(device)
    , Tiles{ frustum.columns, frustum.rows }
    , Voxels(this->FindVoxels(frustum))
    , Phases(device, this->Tiles.Count(), TileHasWork::PhasesOf(frustum),
        TileHasWork{ frustum, this->Found() })
  {
  }

  VoxelsOfTiles Found() const { return { this->Tiles, this->Voxels.Data() }; }
  PhasesOfTiles Lists() const { return this->Phases.Lists(); }

private:
  DeviceArray<AnyDevice, Range<int>> FindVoxels(const FaceFrustum& frustum) const
  {
    const Index count = Index(frustum.SliceCount()) * (this->Tiles.Across() + this->Tiles.Down());
    DeviceArray<AnyDevice, Range<int>> ranges(
      this->Device, static_cast<std::size_t>(count), "the plan of a sweep");
    const MadeVoxelsOfTile made{ frustum, this->Tiles, ranges.Data() };
    this->Device->ForEach("plan", made.ExtentOfRanges(), made);
    return ranges;
  }

  std::shared_ptr<AnyDevice> Device;
  RayTiles Tiles;
  DeviceArray<AnyDevice, Range<int>> Voxels;
  PhaseLists<AnyDevice> Phases;
};
}

#endif
