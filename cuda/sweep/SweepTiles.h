// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How a device sweeps where rays depend on the voxels behind: the rays are cut into tiles, and a
// tile finds all the voxels of a slice that its rays read. Some of those its neighbours find, too,
// so that nobody waits for anybody's voxels, and only once per slice for the rays beside them.

#ifndef limpid_sweep_SweepTiles_h
#define limpid_sweep_SweepTiles_h

#include "backend/Extent.h"
#include "sweep/RaySampler.h"
#include "sweep/RayTiles.h"
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
  static constexpr int tileThreads = RayTiles::size.columns * RayTiles::size.rows;
  static constexpr int slicesPerSlab = 1;

  FaceFrustum frustum;
  RayStates states;
  Kernel kernel;
  SlabImages images;
  VoxelsOfTiles voxels;

  template <class AnyDevice>
  BackwardTiles(FrustumRays<AnyDevice>& rays, float* room, const Kernel& what)
    : frustum(rays.Plan())
    , states(rays.States())
    , kernel(what)
    , images(rays, slicesPerSlab, room)
    , voxels(rays.Tiles())
  {
  }

  /// The last one takes the rays out of the volume.
  int PhaseCount() const { return this->frustum.SliceCount() - this->frustum.firstNodeSlice + 1; }

  LIMPID_HD LIMPID_INLINE int TileCount() const { return this->voxels.tiles.Count(); }

  /// What a tile does in a phase, in two steps. It does not know the sweep: through a reference in
  /// a variable a compiler for GPUs does not see that the memory is not a thread's own.
  struct Tile
  {
    static constexpr int steps = 2;

    int slice;            ///< that the rays come to; that of the voxels is the next one
    Range<int> columns;   ///< rays
    Range<int> rows;      ///< rays
    Range<int> voxelsOfU; ///< see VoxelsOfTiles
    Range<int> voxelsOfV;

    LIMPID_HD LIMPID_INLINE Extent ExtentOf(int step) const
    {
      return step == 0 ? Extent{ this->voxelsOfU.Length(), this->voxelsOfV.Length() }
                       : Extent{ this->columns.Length(), this->rows.Length() };
    }
  };

  LIMPID_HD LIMPID_INLINE Tile TileAt(int phase, int number) const
  {
    const int s = this->frustum.lastSlice - phase;
    const Range<int> columns = this->voxels.tiles.ColumnsOf(number);
    const Range<int> rows = this->voxels.tiles.RowsOf(number);
    if (s == this->frustum.lastSlice)
    {
      return { s, columns, rows, {}, {} }; // there are no voxels behind
    }
    return { s, columns, rows, this->voxels.AlongU(s + 1, number),
      this->voxels.AlongV(s + 1, number) };
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
