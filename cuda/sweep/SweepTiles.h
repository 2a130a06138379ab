// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How a device sweeps where rays depend on the voxels behind: the rays are cut into tiles, and a
// tile finds all the voxels of a slice that its rays read. Some of those its neighbours find, too,
// so that nobody waits for anybody's voxels, and only once per slice for the rays beside them.

#ifndef limpid_sweep_SweepTiles_h
#define limpid_sweep_SweepTiles_h

#include "backend/Extent.h"
#include "sweep/RaySampler.h"
#include "sweep/SlabImages.h"

namespace limpid
{
namespace detail
{
/// Back to front. In each phase a tile first visits voxels of a slice, of which rays have left an
/// image; then its rays go on through them to the slice in front and leave theirs.
template <class Kernel>
struct BackwardTiles
{
  /// Of rays: a block of threads.
  static constexpr Extent tile{ 32, 8 };
  static constexpr int tileThreads = tile.columns * tile.rows;
  static constexpr int slicesPerSlab = 1;

  FaceFrustum frustum;
  RayStates states;
  Kernel kernel;
  SlabImages images;

  template <class AnyDevice>
  BackwardTiles(FrustumRays<AnyDevice>& rays, float* room, const Kernel& what)
    : frustum(rays.Plan())
    , states(rays.States())
    , kernel(what)
    , images(rays, slicesPerSlab, room)
  {
  }

  /// The last one takes the rays out of the volume.
  int PhaseCount() const { return this->frustum.SliceCount() - this->frustum.firstNodeSlice + 1; }

  LIMPID_HD LIMPID_INLINE int TileCount() const
  {
    return this->Across() * ((this->frustum.rows + tile.rows - 1) / tile.rows);
  }

  /// What a tile does in a phase, in two steps. It does not know the sweep: through a reference in
  /// a variable a compiler for GPUs does not see that the memory is not a thread's own.
  struct Tile
  {
    static constexpr int steps = 2;

    int slice;            ///< that the rays come to; that of the voxels is the next one
    Range<int> columns;   ///< rays
    Range<int> rows;      ///< rays
    Range<int> voxelsOfU; ///< that these rays read, and those that none read between the tiles
    Range<int> voxelsOfV;

    LIMPID_HD LIMPID_INLINE Extent ExtentOf(int step) const
    {
      return step == 0 ? Extent{ this->voxelsOfU.Length(), this->voxelsOfV.Length() }
                       : Extent{ this->columns.Length(), this->rows.Length() };
    }
  };

  LIMPID_HD LIMPID_INLINE Tile TileAt(int phase, int number) const
  {
    const FaceFrustum& plan = this->frustum;
    const Range<int> columns =
      Intersection(Part(number % this->Across(), tile.columns), { 0, plan.columns });
    const Range<int> rows =
      Intersection(Part(number / this->Across(), tile.rows), { 0, plan.rows });
    const int s = plan.lastSlice - phase;
    if (s == plan.lastSlice)
    {
      return { s, columns, rows, {}, {} }; // there are no voxels behind
    }
    const Slice& behind = plan.SliceAt(s + 1);
    return { s, columns, rows,
      this->VoxelsOf(s + 1, plan.planeColumns, columns, plan.columns, behind.ownedColumns),
      this->VoxelsOf(s + 1, plan.planeRows, rows, plan.rows, behind.ownedRows) };
  }

  LIMPID_HD LIMPID_INLINE void Visit(const Tile& tile, int step, int column, int row) const
  {
    if (step == 0)
    {
      this->VisitVoxel(tile.slice + 1, tile.voxelsOfU.begin + column, tile.voxelsOfV.begin + row);
    }
    else
    {
      this->MoveRay(tile.slice, tile.columns.begin + column, tile.rows.begin + row);
    }
  }

private:
  LIMPID_HD static LIMPID_INLINE Range<int> Part(int number, int length)
  {
    return { number * length, (number + 1) * length };
  }

  LIMPID_HD LIMPID_INLINE int Across() const
  {
    return (this->frustum.columns + tile.columns - 1) / tile.columns;
  }

  /// The voxels of slice `s` along one axis that `rays` read of it, in the layers behind and in
  /// front of it, as far as they are `owned`; and those up to what the next rays read. `count`: of
  /// all rays along that axis.
  LIMPID_HD LIMPID_INLINE Range<int> VoxelsOf(
    int s, const MapTable& planes, const Range<int>& rays, int count, const Range<int>& owned) const
  {
    const int first = s > 0 ? 2 * (s - 1) : 0; // two planes in a layer
    const int end = s < this->frustum.lastSlice ? 2 * (s + 1) : 2 * s;
    Range<int> read{ owned.end, owned.begin };
    for (int plane = first; plane < end; ++plane)
    {
      const int* nodes = this->frustum.Row(planes, plane).index;
      const int begin = nodes[rays.begin];
      const int behind = nodes[rays.end - 1] + 2;
      const int next = rays.end < count ? nodes[rays.end] : owned.end;
      read.begin = begin < read.begin ? begin : read.begin;
      read.end = behind > read.end ? behind : read.end;
      read.end = next > read.end ? next : read.end;
    }
    read.begin = rays.begin == 0 ? owned.begin : read.begin;
    const Range<int> found = Intersection(read, owned);
    return found.Empty() ? Range<int>{} : found;
  }

  LIMPID_HD LIMPID_INLINE void VisitVoxel(int s, int u, int v) const
  {
    VoxelSampler voxel(this->frustum, s, u, v);
    this->kernel.VoxelStep(voxel, this->images.At(s));
  }

  LIMPID_HD LIMPID_INLINE void MoveRay(int s, int column, int row) const
  {
    const Index index = this->frustum.RayAt(column, row);
    const RayStates here = this->states.From(index);
    if (s == this->frustum.lastSlice)
    {
      StartBehind{ here }(0);
    }
    RaySampler ray(this->frustum, here, column, row);
    if (s >= this->frustum.firstNodeSlice)
    {
      this->kernel.RayStep(ray, s);
      this->images.template Take<Kernel>(s, index, here);
      return;
    }
    this->kernel.LeaveStep(ray);
    FinishBehind{ here }(0);
  }
};
}

/// Back to front over all slices of voxels, slice by slice: the rays may depend on the voxels
/// behind. What happens to a voxel must not depend on its having happened before: tiles share some.
template <class AnyDevice, class Kernel>
void SweepBackwardByPhases(AnyDevice& device, FrustumRays<AnyDevice>& rays, const Kernel& kernel)
{
  using Tiles = detail::BackwardTiles<Kernel>;
  DeviceArray<AnyDevice, float> images = detail::SlabImages::RoomFor(rays, Tiles::slicesPerSlab);
  const Tiles tiles(rays, images.Data(), kernel);
  device.ForTiles(Kernel::label, tiles.PhaseCount(), tiles);
}
}

#endif
