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

/// For every slab of a front-to-back sweep and every row of rays: the columns between which rays
/// have met anything before the end of the slab.
struct DimmedRays
{
  const Range<int>* columns; ///< [slab][row]
  int rows;

  LIMPID_HD LIMPID_INLINE bool Any(
    int slab, const Range<int>& among, const Range<int>& amongRows) const
  {
    return AnyRowMeets(
      amongRows, among, [&](int row) { return this->columns[Index(slab) * this->rows + row]; });
  }
};

/// Computes DimmedRays of a row.
struct MadeDimmedRays
{
  SlabLayout<SlabsFromFront> layout;
  Range<int>* columns; ///< see DimmedRays

  LIMPID_HD void operator()(Index row) const
  {
    const FaceFrustum& plan = this->layout.frustum;
    Range<int> met;
    for (int slab = 0; slab < this->layout.slabs; ++slab)
    {
      const Range<int> slices = this->layout.SlabOf(slab);
      for (int s = slices.begin; s < slices.end && s < plan.lastSlice; ++s)
      {
        met = Hull(met, plan.ActiveRays(s, static_cast<int>(row)));
      }
      this->columns[Index(slab) * plan.rows + row] = met;
    }
  }
};

/// Tells which tiles have work in a phase of a front-to-back sweep: rays that are active in the
/// slab, or whose image differs from that of two slabs before, and voxels that read rays that have
/// met anything.
struct SlabTileIsDimmed
{
  SlabLayout<SlabsFromFront> layout;
  DimmedRays dimmed;

  LIMPID_HD LIMPID_INLINE bool operator()(int number, int phase) const
  {
    const SlabTile tile = this->layout.TileAt(phase, number);
    if (tile.columns.Empty() || tile.rows.Empty())
    {
      return false;
    }
    return tile.hasRays ? this->MovesRays(tile) : this->DimsVoxels(tile, phase - 1);
  }

private:
  LIMPID_HD LIMPID_INLINE bool MovesRays(const SlabTile& tile) const
  {
    const FaceFrustum& plan = this->layout.frustum;
    const int slices = this->layout.slicesPerSlab;
    const Range<int> layers{ (tile.place - 2) * slices - 1, (tile.place + 1) * slices };
    if (AnyRayIsActive(plan, layers, tile.columns, tile.rows))
    {
      return true;
    }
    // The density of a ray that has met anything changes from slice to slice.
    const bool nearSides = plan.IsNearSides(tile.columns.begin, tile.rows.begin) ||
      plan.IsNearSides(tile.columns.end - 1, tile.rows.end - 1);
    return nearSides && this->dimmed.Any(tile.place, tile.columns, tile.rows);
  }

  LIMPID_HD LIMPID_INLINE bool DimsVoxels(const SlabTile& tile, int slab) const
  {
    constexpr int beside = 3; // see FaceFrustum::IsNearSides
    const FaceFrustum& plan = this->layout.frustum;
    const Range<int> columns{ plan.AllColumnsAbout(tile.place, tile.columns.begin).begin - beside,
      plan.AllColumnsAbout(tile.place, tile.columns.end - 1).end + beside };
    const Range<int> rows{ plan.AllRowsAbout(tile.place, tile.rows.begin).begin - beside,
      plan.AllRowsAbout(tile.place, tile.rows.end - 1).end + beside };
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
    const SlabLayout<SlabsFromBack> layout(frustum, slices);
    return { device, layout, SlabTileHasWork{ layout } };
  }

  /// For a front-to-back sweep.
  static SlabPlan FromFront(
    const std::shared_ptr<AnyDevice>& device, const FaceFrustum& frustum, int slices)
  {
    const SlabLayout<SlabsFromFront> layout(frustum, slices);
    DeviceArray<AnyDevice, Range<int>> dimmed(
      device, std::size_t(layout.slabs) * std::size_t(frustum.rows), "the plan of a sweep");
    device->ForIndices("plan", frustum.rows, MadeDimmedRays{ layout, dimmed.Data() });
    return { device, layout, SlabTileIsDimmed{ layout, { dimmed.Data(), frustum.rows } } };
  }

  PhasesOfTiles Lists() const { return this->Phases.Lists(); }

private:
  template <class Layout, class Mark>
  SlabPlan(const std::shared_ptr<AnyDevice>& device, const Layout& layout, const Mark& mark)
    : Phases(device, layout.TileCount(), layout.PhaseCount(), mark)
  {
  }

  PhaseLists<AnyDevice> Phases;
};
}

#endif
