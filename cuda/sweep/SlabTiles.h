// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Tiles of rays and of voxels for a sweep in which rays do not depend on the changes of voxels
// (SweepLaunches.h): what a tile is, and which tiles have work in a phase.

#ifndef limpid_sweep_SlabTiles_h
#define limpid_sweep_SlabTiles_h

#include "sweep/FaceFrustum.h"
#include "sweep/PhaseLists.h"
#include "sweep/RayTiles.h"

#include <memory>

namespace limpid
{
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

/// The slices of a frustum in slabs of so many, and the tiles of their rays and voxels. In phase n
/// the rays cross slab n, and the voxels of slab n - 1 read what the rays left there. Tiles are
/// numbered: first those of the rays, then those of the voxels, slice by slice.
template <class Slabs>
struct SlabLayout
{
  FaceFrustum frustum;
  RayTiles rays;
  RayTiles voxels;
  int slicesPerSlab; ///< a power of two
  int slabs;

  SlabLayout(const FaceFrustum& plan, int slices)
    : frustum(plan)
    , rays{ plan.columns, plan.rows }
    , voxels{ plan.nodesU, plan.nodesV }
    , slicesPerSlab(slices)
    , slabs((Slabs::SlicesOf(plan) + slices - 1) / slices)
  {
  }

  int TileCount() const { return this->rays.Count() + this->slicesPerSlab * this->voxels.Count(); }
  int PhaseCount() const { return this->slabs + 1; }

  LIMPID_HD LIMPID_INLINE Range<int> SlabOf(int slab) const
  {
    return Slabs::SlabOf(this->frustum, this->slicesPerSlab, slab);
  }

  /// Returns tile `number` of a phase; it is empty if there is nothing to do for it.
  LIMPID_HD LIMPID_INLINE SlabTile TileAt(int phase, int number) const
  {
    const int beyond = number - this->rays.Count();
    if (beyond < 0)
    {
      return { true, phase, phase < this->slabs ? this->rays.ColumnsOf(number) : Range<int>{},
        this->rays.RowsOf(number) };
    }
    const int perSlice = this->voxels.Count();
    const int ofSlice = beyond % perSlice;
    const Range<int> slab = phase > 0 ? this->SlabOf(phase - 1) : Range<int>{};
    const int s = slab.begin + beyond / perSlice;
    if (!slab.Contains(s) || this->frustum.SliceAt(s).node < 0)
    {
      return { false, s, {}, {} };
    }
    const Slice& slice = this->frustum.SliceAt(s);
    const Range<int> columns = Intersection(this->voxels.ColumnsOf(ofSlice), slice.ownedColumns);
    const Range<int> rows = Intersection(this->voxels.RowsOf(ofSlice), slice.ownedRows);
    return { false, s, columns.Empty() ? Range<int>{} : columns,
      rows.Empty() ? Range<int>{} : rows };
  }
};

/// Tells which tiles have work in a phase of a back-to-front sweep: rays that are active in the
/// slab or whose image differs from that of two slabs before, and active voxels.
struct SlabTileHasWork
{
  SlabLayout<SlabsFromBack> layout;

  LIMPID_HD LIMPID_INLINE bool operator()(int number, int phase) const
  {
    const SlabTile tile = this->layout.TileAt(phase, number);
    if (!tile.hasRays)
    {
      return AnyVoxelIsActive(this->layout.frustum, tile.place, tile.columns, tile.rows);
    }
    if (tile.columns.Empty())
    {
      return false;
    }
    // The layers in front of and behind the slices of this slab and of the two behind it.
    const Range<int> slab = this->layout.SlabOf(tile.place);
    const Range<int> layers{ slab.begin - 1, slab.end + 2 * this->layout.slicesPerSlab };
    return AnyRayIsActive(this->layout.frustum, layers, tile.columns, tile.rows);
  }
};

/// Lists the tiles that a back-to-front sweep by slabs of so many slices visits.
template <class AnyDevice>
PhaseLists<AnyDevice> ListSlabsFromBack(
  const std::shared_ptr<AnyDevice>& device, const FaceFrustum& frustum, int slices)
{
  const SlabLayout<SlabsFromBack> layout(frustum, slices);
  return { device, layout.TileCount(), layout.PhaseCount(), SlabTileHasWork{ layout } };
}
}

#endif
