// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Sweeps on a device, launch by launch, with one thread per ray or voxel. A kernel defines what
// happens to them; SweepRows.h runs the same kernels on the processor. SweepTiles.h serves kernels
// whose rays depend on the voxels behind.

#ifndef limpid_sweep_SweepLaunches_h
#define limpid_sweep_SweepLaunches_h

#include "backend/Extent.h"
#include "sweep/ActiveLayers.h"
#include "sweep/DimmedTiles.h"
#include "sweep/RayHere.h"
#include "sweep/RaySampler.h"
#include "sweep/SlabImages.h"
#include "sweep/SlabTiles.h"

#include <memory>

namespace limpid
{
namespace detail
{
/// Moves a ray through all layers in which it is active, front to back.
template <class Ray, class Kernel>
struct ForwardRay
{
  FaceFrustum frustum;
  RayStates states;
  Kernel kernel;
  LayerMasks layers;

  LIMPID_HD void operator()(int i, int j) const
  {
    RayHere here;
    this->kernel.ForCarried(StartInFront{ here.States() });
    Ray ray(this->frustum, here.States(), i, j);
    this->layers.FrontToBack(i, j, [&](int s) { this->kernel.RayStep(ray, s); });
    const RayStates kept = this->states.From(this->frustum.RayAt(i, j));
    this->kernel.ForCarried(CopyValue{ here.States(), kept });
  }
};

/// Moves a ray through all layers in which it is active, back to front.
template <class Kernel>
struct BackwardRay
{
  FaceFrustum frustum;
  RayStates states;
  Kernel kernel;
  LayerMasks layers;

  LIMPID_HD void operator()(int i, int j) const
  {
    RayHere here;
    this->kernel.ForCarried(StartBehind{ here.States() });
    RaySampler ray(this->frustum, here.States(), i, j);
    this->layers.BackToFront(i, j, [&](int s) { this->kernel.RayStep(ray, s); });
    this->kernel.ForCarried(FinishBehind{ here.States() });
    const RayStates kept = this->states.From(this->frustum.RayAt(i, j));
    this->kernel.ForCarried(CopyValue{ here.States(), kept });
  }
};

/// How rays cross the slices that hold voxels, back to front.
struct BackToFront
{
  using Slabs = SlabsFromBack;
  using Start = StartBehind;

  /// Returns the addresses of the values kept between slabs.
  template <class AnyDevice>
  static RayStates StatesOf(FrustumRays<AnyDevice>& rays)
  {
    return rays.States();
  }

  /// Moves a ray to the slices of a slab, and calls take(s) on each.
  template <class Kernel, class Take>
  LIMPID_HD static LIMPID_INLINE void Cross(
    const Range<int>& slices, const Kernel& kernel, RaySampler& ray, const Take& take)
  {
    for (int s = slices.end; s-- > slices.begin;)
    {
      kernel.RayStep(ray, s);
      take(s);
    }
  }
};

/// How rays cross all slices front to back, including the source's own.
struct FrontToBack
{
  using Slabs = SlabsFromFront;
  using Start = StartInFront;

  template <class AnyDevice>
  static RayStates StatesOf(FrustumRays<AnyDevice>& rays)
  {
    return rays.DepthsToSlice();
  }

  template <class Kernel, class Take>
  LIMPID_HD static LIMPID_INLINE void Cross(
    const Range<int>& slices, const Kernel& kernel, RaySampler& ray, const Take& take)
  {
    for (int s = slices.begin; s < slices.end; ++s)
    {
      kernel.RayStep(ray, s, Range<int>{});
      take(s);
    }
  }
};

/// Phases of a sweep, slab by slab, for a kernel whose rays do not depend on the changes of
/// voxels. In each phase the rays cross a slab, while the voxels of the previous slab read the
/// images that the rays have left there.
template <class Way, class Kernel>
struct SweptSlabs
{
  static constexpr int tileThreads = RayTiles::size.columns * RayTiles::size.rows;

  /// Per multiprocessor. Rays with effects resolve thick layers, for which 128 registers suffice;
  /// others have 80.
  static constexpr int residentThreads = Kernel::readByVoxels == RayChannel::Effect ? 512 : 768;

  SlabLayout<typename Way::Slabs> layout;
  RayStates states;
  Kernel kernel;
  SlabImages<Kernel> images;
  PhasesOfTiles lists;

  template <class AnyDevice>
  SweptSlabs(FrustumRays<AnyDevice>& rays, int slices, float* room, const Kernel& what,
    const PhasesOfTiles& working)
    : layout(rays.Plan(), slices)
    , states(Way::StatesOf(rays))
    , kernel(what)
    , images(rays, slices, room)
    , lists(working)
  {
  }

  /// Returns tile `number` of all tiles in a phase.
  LIMPID_HD LIMPID_INLINE SlabTile TileOf(const PhaseOfTiles& phase, int number) const
  {
    return this->layout.TileAt(phase.number, number);
  }

  LIMPID_HD LIMPID_INLINE void Visit(const SlabTile& tile, int, int column, int row) const
  {
    if (tile.hasRays)
    {
      this->MoveRay(tile.place, tile.columns.begin + column, tile.rows.begin + row);
      return;
    }
    VoxelSampler voxel(
      this->layout.frustum, tile.place, tile.columns.begin + column, tile.rows.begin + row);
    this->kernel.VoxelStep(voxel, this->images.At(tile.place));
  }

private:
  LIMPID_HD LIMPID_INLINE void MoveRay(int slab, int column, int row) const
  {
    const FaceFrustum& plan = this->layout.frustum;
    const int index = plan.RayAt(column, row);
    const bool nearSides = plan.IsNearSides(column, row);
    const RayStates kept = this->states.From(index);
    RayHere here;
    ForRead<Kernel::readByVoxels>(typename Way::Start{ here.States() });
    this->kernel.ForCarried(CopyValue{ kept, here.States() });
    RaySampler ray(plan, here.States(), column, row);
    Way::Cross(this->layout.SlabOf(slab), this->kernel, ray,
      [&](int s) { this->images.Take(s, index, nearSides, here.States()); });
    this->kernel.ForCarried(CopyValue{ here.States(), kept });
  }
};

inline Extent ExtentOfRays(const FaceFrustum& frustum)
{
  return { frustum.columns, frustum.rows };
}
}

/// Front to back: moves every ray through its layers in one launch. A kernel does nothing in layers
/// in which a ray is not active. `Ray`: the sampler.
template <class Ray = RaySampler, class AnyDevice, class Kernel>
void SweepForward(
  AnyDevice& device, FrustumRays<AnyDevice>& rays, const Occupancy&, const Kernel& kernel)
{
  const FaceFrustum& frustum = rays.Plan();
  device.ForEach(Kernel::label, detail::ExtentOfRays(frustum),
    detail::ForwardRay<Ray, Kernel>{ frustum, rays.States(), kernel, rays.Layers() });
}

/// Back to front without voxels: moves every ray through all layers in one launch. Keeps the
/// optical depths.
template <class AnyDevice, class Kernel>
void SweepRaysBackward(
  AnyDevice& device, FrustumRays<AnyDevice>& rays, const Occupancy&, const Kernel& kernel)
{
  device.ForEach(Kernel::label, detail::ExtentOfRays(rays.Plan()),
    detail::BackwardRay<Kernel>{ rays.Plan(), rays.States(), kernel, rays.Layers() });
}

/// Back to front over all slices of voxels, for a kernel whose rays do not depend on the changes
/// of voxels. Visits the tiles of rays and voxels that have work.
template <class AnyDevice, class Kernel>
void SweepBackward(
  AnyDevice& device, FrustumRays<AnyDevice>& rays, const Occupancy&, const Kernel& kernel)
{
  using Images = detail::SlabImages<Kernel>;
  const FaceFrustum& frustum = rays.Plan();
  const int slices = Images::SlicesFor(frustum.RayCount());
  DeviceArray<AnyDevice, float> room = Images::RoomFor(rays, slices);
  const detail::SweptSlabs<detail::BackToFront, Kernel> slabs(
    rays, slices, room.Data(), kernel, rays.SlabsFromBack(slices).Lists());
  device.ForIndices(Kernel::label, frustum.RayCount(),
    detail::StartedRay<StartBehind, Kernel>{ slabs.states, kernel, slabs.images });
  device.ForTiles(Kernel::label, slabs);
  device.ForEach(Kernel::label, detail::ExtentOfRays(frustum),
    detail::LeavingRay<Kernel>{ frustum, slabs.states, kernel });
}

/// Front to back over all slices, including the source's own. Visits the tiles of rays and voxels
/// that have work: voxels behind nothing keep their values. `dimming`: blocks of the field that
/// dims the rays.
template <class AnyDevice, class Kernel>
void SweepFrontToBack(const std::shared_ptr<AnyDevice>& device, FrustumRays<AnyDevice>& rays,
  const FieldBlocks<AnyDevice>& dimming, const Kernel& kernel)
{
  using Images = detail::SlabImages<Kernel>;
  const int slices = Images::SlicesFor(rays.Plan().RayCount());
  DeviceArray<AnyDevice, float> room = Images::RoomFor(rays, slices);
  const PhaseLists<AnyDevice> tiles =
    ListSlabsFromFront(device, rays.Plan(), slices, dimming.Blocks());
  const detail::SweptSlabs<detail::FrontToBack, Kernel> slabs(
    rays, slices, room.Data(), kernel, tiles.Lists());
  device->ForIndices(Kernel::label, rays.Plan().RayCount(),
    detail::StartedRay<StartInFront, Kernel>{ slabs.states, kernel, slabs.images });
  device->ForTiles(Kernel::label, slabs);
}
}

#endif
