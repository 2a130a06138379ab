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

/// For every slab of a front-to-back sweep and every row of rays: the columns between which rays
/// have met anything before the end of the slab.
struct DimmedRays
{
  const Range<int>* columns; ///< [slab][row]
  int rows;

  LIMPID_HD LIMPID_INLINE bool Any(
    int slab, const Range<int>& among, const Range<int>& amongRows) const
  {
    for (int row = amongRows.begin; row < amongRows.end; ++row)
    {
      if (!Intersection(this->columns[Index(slab) * this->rows + row], among).Empty())
      {
        return true;
      }
    }
    return false;
  }
};

/// Computes DimmedRays of a row.
struct MadeDimmedRays
{
  FaceFrustum frustum;
  int slicesPerSlab;
  int slabs;
  Range<int>* columns; ///< see DimmedRays

  LIMPID_HD void operator()(Index row) const
  {
    Range<int> met;
    for (int slab = 0; slab < this->slabs; ++slab)
    {
      const Range<int> slices = SlabsFromFront::SlabOf(this->frustum, this->slicesPerSlab, slab);
      for (int s = slices.begin; s < slices.end && s < this->frustum.lastSlice; ++s)
      {
        met = Hull(met, this->frustum.ActiveRays(s, static_cast<int>(row)));
      }
      this->columns[Index(slab) * this->frustum.rows + row] = met;
    }
  }
};

/// Tells which tiles have work in a phase of a front-to-back sweep: rays that are active in the
/// slab, or whose image differs from that of two slabs before, and voxels that read rays that have
/// met anything.
struct SlabTileIsDimmed
{
  FaceFrustum frustum;
  SlabTiles tiles;
  int slabs;
  DimmedRays dimmed;

  LIMPID_HD LIMPID_INLINE bool operator()(int number, int phase) const
  {
    const SlabTile tile =
      SlabTileAt<SlabsFromFront>(this->frustum, this->tiles, this->slabs, phase, number);
    if (tile.columns.Empty() || tile.rows.Empty())
    {
      return false;
    }
    return tile.hasRays ? this->MovesRays(tile) : this->DimsVoxels(tile, phase - 1);
  }

private:
  LIMPID_HD LIMPID_INLINE bool MovesRays(const SlabTile& tile) const
  {
    const int slices = this->tiles.slicesPerSlab;
    const Range<int> layers{ (tile.place - 2) * slices - 1, (tile.place + 1) * slices };
    if (AnyRayIsActive(this->frustum, layers, tile.columns, tile.rows))
    {
      return true;
    }
    // The density of a ray that has met anything changes from slice to slice.
    const bool nearSides = this->frustum.IsNearSides(tile.columns.begin, tile.rows.begin) ||
      this->frustum.IsNearSides(tile.columns.end - 1, tile.rows.end - 1);
    return nearSides && this->dimmed.Any(tile.place, tile.columns, tile.rows);
  }

  LIMPID_HD LIMPID_INLINE bool DimsVoxels(const SlabTile& tile, int slab) const
  {
    constexpr int beside = 3; // see FaceFrustum::IsNearSides
    const FaceFrustum& plan = this->frustum;
    const Range<int> columns{ plan.ColumnsAbout(tile.place, tile.columns.begin).begin - beside,
      plan.ColumnsAbout(tile.place, tile.columns.end - 1).end + beside };
    const Range<int> rows{ plan.RowsAbout(tile.place, tile.rows.begin).begin - beside,
      plan.RowsAbout(tile.place, tile.rows.end - 1).end + beside };
    return this->dimmed.Any(slab, columns, Intersection(rows, Range<int>{ 0, plan.rows }));
  }
};

/// The tiles that a sweep by slabs visits in each phase.
template <class AnyDevice>
class SlabPlan
{
public:
  /// For a back-to-front sweep.
  static SlabPlan FromBack(
    const std::shared_ptr<AnyDevice>& device, const FaceFrustum& frustum, int slices)
  {
    const SlabTiles tiles(frustum, slices);
    const int slabs = tiles.SlabsOf(SlabsFromBack::SlicesOf(frustum));
    return { device, tiles, slabs, SlabTileHasWork{ frustum, tiles, slabs } };
  }

  /// For a front-to-back sweep.
  static SlabPlan FromFront(
    const std::shared_ptr<AnyDevice>& device, const FaceFrustum& frustum, int slices)
  {
    const SlabTiles tiles(frustum, slices);
    const int slabs = tiles.SlabsOf(SlabsFromFront::SlicesOf(frustum));
    DeviceArray<AnyDevice, Range<int>> dimmed(
      device, std::size_t(slabs) * std::size_t(frustum.rows), "the plan of a sweep");
    device->ForIndices(
      "plan", frustum.rows, MadeDimmedRays{ frustum, slices, slabs, dimmed.Data() });
    return { device, tiles, slabs,
      SlabTileIsDimmed{ frustum, tiles, slabs, { dimmed.Data(), frustum.rows } } };
  }

  const PhasesOfTiles& Lists() const { return this->Phases.Lists(); }

private:
  template <class Mark>
  SlabPlan(
    const std::shared_ptr<AnyDevice>& device, const SlabTiles& tiles, int slabs, const Mark& mark)
    : Phases(device, tiles.Count(), slabs + 1, mark)
  {
  }

  PhaseLists<AnyDevice> Phases;
};
}

#endif
