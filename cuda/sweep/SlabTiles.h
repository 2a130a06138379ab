// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Tiles of rays and of voxels for a sweep in which rays do not depend on the changes of voxels
// (SweepLaunches.h): what a tile is, and which tiles have work in a phase.

#ifndef limpid_sweep_SlabTiles_h
#define limpid_sweep_SlabTiles_h

#include "sweep/FaceFrustum.h"
#include "sweep/RayTiles.h"

namespace limpid
{
/// A number of successive slices that rays cross in one phase; the tiles of their rays and voxels.
/// In phase n the rays cross slab n, and the voxels of slab n - 1 read what the rays left there.
/// Tiles are numbered: first those of the rays, then those of the voxels, slice by slice.
struct SlabTiles
{
  RayTiles rays;
  RayTiles voxels;
  int slicesPerSlab; ///< a power of two

  SlabTiles(const FaceFrustum& frustum, int slices)
    : rays{ frustum.columns, frustum.rows }
    , voxels{ frustum.nodesU, frustum.nodesV }
    , slicesPerSlab(slices)
  {
  }

  LIMPID_HD LIMPID_INLINE int Count() const
  {
    return this->rays.Count() + this->slicesPerSlab * this->voxels.Count();
  }

  /// Number of slabs that hold `slices` slices.
  int SlabsOf(int slices) const { return (slices + this->slicesPerSlab - 1) / this->slicesPerSlab; }
};

/// Rays of a slab, or voxels of a slice.
struct SlabTile
{
  static constexpr int steps = 1;

  bool hasRays;
  int place;          ///< of rays: the slab; of voxels: the slice
  Range<int> columns; ///< rays, or voxels
  Range<int> rows;

  LIMPID_HD LIMPID_INLINE Extent ExtentOf(int) const
  {
    return { this->columns.Length(), this->rows.Length() };
  }
};

/// The slabs of the slices that hold voxels, back to front.
struct SlabsFromBack
{
  static int SlicesOf(const FaceFrustum& frustum)
  {
    return frustum.SliceCount() - frustum.firstNodeSlice;
  }

  LIMPID_HD static LIMPID_INLINE Range<int> SlabOf(const FaceFrustum& frustum, int slices, int slab)
  {
    const int end = frustum.lastSlice + 1 - slab * slices;
    const int begin = end - slices;
    return { begin > frustum.firstNodeSlice ? begin : frustum.firstNodeSlice, end };
  }
};

/// The slabs of all slices, front to back.
struct SlabsFromFront
{
  static int SlicesOf(const FaceFrustum& frustum) { return frustum.SliceCount(); }

  LIMPID_HD static LIMPID_INLINE Range<int> SlabOf(const FaceFrustum& frustum, int slices, int slab)
  {
    const int begin = slab * slices;
    const int end = begin + slices;
    return { begin, end < frustum.lastSlice + 1 ? end : frustum.lastSlice + 1 };
  }
};

/// Returns tile `number` of a phase; it is empty if there is nothing to do for it.
template <class Slabs>
LIMPID_HD LIMPID_INLINE SlabTile SlabTileAt(
  const FaceFrustum& frustum, const SlabTiles& tiles, int slabs, int phase, int number)
{
  const int beyond = number - tiles.rays.Count();
  if (beyond < 0)
  {
    return { true, phase, phase < slabs ? tiles.rays.ColumnsOf(number) : Range<int>{},
      tiles.rays.RowsOf(number) };
  }
  const int perSlice = tiles.voxels.Count();
  const int ofSlice = beyond % perSlice;
  const Range<int> slab =
    phase > 0 ? Slabs::SlabOf(frustum, tiles.slicesPerSlab, phase - 1) : Range<int>{};
  const int s = slab.begin + beyond / perSlice;
  if (!slab.Contains(s) || frustum.SliceAt(s).node < 0)
  {
    return { false, s, {}, {} };
  }
  const Slice& slice = frustum.SliceAt(s);
  const Range<int> columns = Intersection(tiles.voxels.ColumnsOf(ofSlice), slice.ownedColumns);
  const Range<int> rows = Intersection(tiles.voxels.RowsOf(ofSlice), slice.ownedRows);
  return { false, s, columns.Empty() ? Range<int>{} : columns, rows.Empty() ? Range<int>{} : rows };
}

/// Tells which tiles have work in a phase of a back-to-front sweep: rays that are active in the
/// slab or whose image differs from that of two slabs before, and active voxels.
struct SlabTileHasWork
{
  FaceFrustum frustum;
  SlabTiles tiles;
  int slabs;

  LIMPID_HD LIMPID_INLINE bool operator()(int number, int phase) const
  {
    const SlabTile tile =
      SlabTileAt<SlabsFromBack>(this->frustum, this->tiles, this->slabs, phase, number);
    if (!tile.hasRays)
    {
      return AnyVoxelIsActive(this->frustum, tile.place, tile.columns, tile.rows);
    }
    if (tile.columns.Empty())
    {
      return false;
    }
    // The layers in front of and behind the slices of this slab and of the two behind it.
    const Range<int> slab =
      SlabsFromBack::SlabOf(this->frustum, this->tiles.slicesPerSlab, tile.place);
    const Range<int> layers{ slab.begin - 1, slab.end + 2 * this->tiles.slicesPerSlab };
    return AnyRayIsActive(this->frustum, layers, tile.columns, tile.rows);
  }
};

/// The tiles that a back-to-front sweep visits in each phase.
template <class AnyDevice>
class SlabPlan
{
public:
  SlabPlan(const std::shared_ptr<AnyDevice>& device, const FaceFrustum& frustum, int slices)
    : Tiles(frustum, slices)
    , Slabs(this->Tiles.SlabsOf(SlabsFromBack::SlicesOf(frustum)))
    , Phases(device, this->Tiles.Count(), this->Slabs + 1,
        SlabTileHasWork{ frustum, this->Tiles, this->Slabs })
  {
  }

  const PhasesOfTiles& Lists() const { return this->Phases.Lists(); }

private:
  SlabTiles Tiles;
  int Slabs;
  PhaseLists<AnyDevice> Phases;
};
}

#endif
