// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Sweeps on a device for kernels whose rays depend on the voxels behind. The rays are divided into
// tiles, and a tile computes all voxels of a slice that its rays read. Neighbouring tiles compute
// some of these, too, so that only one synchronisation per slice is needed, for the rays. Most
// tiles are idle on most slices, where neither rays nor voxels change (RayTiles.h). Voxels that no
// ray matters to are computed beforehand.

#ifndef limpid_sweep_SweepTiles_h
#define limpid_sweep_SweepTiles_h

#include "backend/Extent.h"
#include "sweep/RayHere.h"
#include "sweep/RaySampler.h"
#include "sweep/RayTiles.h"
#include "sweep/SlabImages.h"

namespace limpid
{
namespace detail
{
/// Computes the voxels that no ray matters to; `threads` threads share the filled voxels of a row.
template <class Kernel>
struct IdleVoxels
{
  static constexpr int threads = 32;

  FaceFrustum frustum;
  Kernel kernel;

  Extent ExtentOfRows() const
  {
    return { threads, this->frustum.SliceCount() * this->frustum.nodesV };
  }

  LIMPID_HD void operator()(int thread, int row) const
  {
    const int s = row / this->frustum.nodesV;
    const int v = row % this->frustum.nodesV;
    const Range<int> filled = this->frustum.FilledVoxels(s, v);
    for (int u = filled.begin + thread; u < filled.end; u += threads)
    {
      this->kernel.IdleVoxelStep(VoxelSampler(this->frustum, s, u, v));
    }
  }
};

/// Back to front. In each phase a tile first visits voxels of a slice, for which rays have left
/// images. Then its rays move through these voxels to the slice in front and leave their images.
template <class Kernel>
struct BackwardTiles
{
  static constexpr int tileThreads = RayTiles::size.columns * RayTiles::size.rows;
  static constexpr int residentThreads = 512; ///< per multiprocessor: 128 registers for each

  FaceFrustum frustum;
  RayStates states;
  Kernel kernel;
  SlabImages<Kernel> images;
  VoxelsOfTiles voxels;
  PhasesOfTiles lists;

  /// The work of a tile in a phase, in two steps. It holds no reference to the sweep: a GPU
  /// compiler could not tell that such memory is not local to the thread.
  struct Tile
  {
    static constexpr int steps = 2;

    int slice;            ///< the slice that rays move to; its voxels are on the next one
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

  /// Returns tile `number` of all tiles in a phase.
  LIMPID_HD LIMPID_INLINE Tile TileOf(const PhaseOfTiles& phase, int number) const
  {
    const int s = this->frustum.lastSlice - phase.number;
    Tile found{ s, {}, this->voxels.tiles.RowsOf(number), {}, {} };
    if (s >= this->frustum.firstNodeSlice) // otherwise there are only voxels
    {
      found.columns = this->voxels.tiles.ColumnsOf(number);
    }
    if (s < this->frustum.lastSlice) // otherwise there are no voxels behind
    {
      found.voxelsOfU = this->voxels.AlongU(s + 1, number);
      found.voxelsOfV = this->voxels.AlongV(s + 1, number);
    }
    return found;
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
    this->kernel.ActiveVoxelStep(voxel, this->images.At(s));
    this->kernel.PrefetchInFront(voxel);
  }

  /// Values of the ray are kept in registers, so that reading fields need not wait for writing
  /// them.
  LIMPID_HD LIMPID_INLINE void MoveRay(int s, int column, int row) const
  {
    const Index index = this->frustum.RayAt(column, row);
    const RayStates kept = this->states.From(index);
    RayHere here;
    const RayStates carried = here.States();
    ForRead<Kernel::readByVoxels>(StartBehind{ carried });
    this->kernel.ForCarried(CopyValue{ kept, carried });
    const bool changes = this->frustum.ActiveRays(s, row).Contains(column) ||
      (s < this->frustum.lastSlice && this->frustum.ActiveRays(s + 1, row).Contains(column));
    if (changes)
    {
      RaySampler ray(this->frustum, carried, column, row);
      this->kernel.RayStep(ray, s);
      this->kernel.ForCarried(CopyValue{ carried, kept });
    }
    this->images.Take(s, index, this->frustum.IsNearSides(column, row), carried);
  }
};

}

/// Back to front, slice by slice over all voxels; rays may depend on the voxels behind. Visiting a
/// voxel twice must have the same effect as once, because tiles share some voxels.
template <class AnyDevice, class Kernel>
void SweepBackwardByPhases(AnyDevice& device, FrustumRays<AnyDevice>& rays, const Kernel& kernel)
{
  constexpr int slicesPerSlab = 1;
  const FaceFrustum& frustum = rays.Plan();
  const RayStates states = rays.States();
  using Images = detail::SlabImages<Kernel>;
  DeviceArray<AnyDevice, float> room = Images::RoomFor(rays, slicesPerSlab);
  const Images images(rays, slicesPerSlab, room.Data());
  device.ForIndices(Kernel::label, frustum.RayCount(),
    detail::StartedRay<StartBehind, Kernel>{ states, kernel, images });
  const detail::IdleVoxels<Kernel> idle{ frustum, kernel };
  device.ForEach(Kernel::label, idle.ExtentOfRows(), idle);
  device.ForTiles(Kernel::label,
    detail::BackwardTiles<Kernel>{
      frustum, states, kernel, images, rays.Tiles().Found(), rays.Tiles().Lists() });
  device.ForEach(Kernel::label, Extent{ frustum.columns, frustum.rows },
    detail::LeavingRay<Kernel>{ frustum, states, kernel });
}
}

#endif
