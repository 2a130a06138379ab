// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Sweeps on a device, launch by launch, with one thread per ray or voxel. A kernel defines what
// happens to them; SweepRows.h runs the same kernels on the processor. SweepTiles.h serves kernels
// whose rays depend on the voxels behind.

#ifndef limpid_sweep_SweepLaunches_h
#define limpid_sweep_SweepLaunches_h

#include "backend/Extent.h"
#include "sweep/RayHere.h"
#include "sweep/RaySampler.h"
#include "sweep/SlabImages.h"

namespace limpid
{
namespace detail
{
/// Number of slices that rays cross between two synchronisations. It is small enough that the
/// images of two slabs fit into the L2 cache of a large GPU (30 MB at 256^3).
constexpr int slicesPerSlab = 4;

/// Moves a ray through all layers, front to back.
template <class Ray, class Kernel>
struct ForwardRay
{
  FaceFrustum frustum;
  RayStates states;
  Kernel kernel;

  LIMPID_HD void operator()(int i, int j) const
  {
    RayHere here;
    StartInFront{ here.States() }(0);
    Ray ray(this->frustum, here.States(), i, j);
    for (int s = 0; s < this->frustum.lastSlice; ++s)
    {
      this->kernel.RayStep(ray, s);
    }
    here.Store(this->states.From(this->frustum.RayAt(i, j)));
  }
};

/// Moves a ray through all layers, back to front.
template <class Kernel>
struct BackwardRay
{
  FaceFrustum frustum;
  RayStates states;
  Kernel kernel;

  LIMPID_HD void operator()(int i, int j) const
  {
    RayHere here;
    StartBehind{ here.States() }(0);
    RaySampler ray(this->frustum, here.States(), i, j);
    for (int s = this->frustum.lastSlice; s-- > 0;)
    {
      this->kernel.RayStep(ray, s);
    }
    FinishBehind{ here.States() }(0);
    const RayStates kept = this->states.From(this->frustum.RayAt(i, j));
    here.opticalDepth = *kept.opticalDepth;
    here.Store(kept);
  }
};

/// Visits the slices that hold voxels, back to front.
struct BackToFront
{
  /// The values kept between slabs.
  using Carried = RayStates;

  template <class AnyDevice>
  static Carried CarriedBy(FrustumRays<AnyDevice>& rays)
  {
    return rays.States();
  }

  static int CountOf(const FaceFrustum& frustum)
  {
    return frustum.SliceCount() - frustum.firstNodeSlice;
  }

  LIMPID_HD static Range<int> SlabOf(const FaceFrustum& frustum, int slab)
  {
    const int end = frustum.lastSlice + 1 - slab * slicesPerSlab;
    const int begin = end - slicesPerSlab;
    return { begin > frustum.firstNodeSlice ? begin : frustum.firstNodeSlice, end };
  }

  /// Sets the values of a ray before a slab. Its optical depth is known from the start.
  LIMPID_HD static LIMPID_INLINE void Load(
    bool first, const RayStates& all, int index, RayHere& here)
  {
    if (first)
    {
      StartBehind{ here.States() }(0);
      here.opticalDepth = all.opticalDepth[index];
      return;
    }
    here.Load(all.From(index));
  }

  LIMPID_HD static LIMPID_INLINE void Store(const RayHere& here, const RayStates& all, int index)
  {
    here.Store(all.From(index));
  }

  template <class Kernel>
  LIMPID_HD static LIMPID_INLINE void Cross(const Range<int>& slices, const FaceFrustum& frustum,
    const Kernel& kernel, const SlabImages& images, Index index, RaySampler& ray, RayHere& here)
  {
    for (int s = slices.end; s-- > slices.begin;)
    {
      kernel.RayStep(ray, s);
      images.Take<Kernel>(s, index, here.States());
    }
    if (slices.begin == frustum.firstNodeSlice)
    {
      kernel.LeaveStep(ray);
      FinishBehind{ here.States() }(0);
    }
  }
};

/// Visits all slices front to back, including the source's own.
struct FrontToBack
{
  using Carried = double*; ///< the optical depth

  template <class AnyDevice>
  static Carried CarriedBy(FrustumRays<AnyDevice>& rays)
  {
    return rays.OpticalDepths();
  }

  static int CountOf(const FaceFrustum& frustum) { return frustum.SliceCount(); }

  LIMPID_HD static Range<int> SlabOf(const FaceFrustum& frustum, int slab)
  {
    const int begin = slab * slicesPerSlab;
    const int end = begin + slicesPerSlab;
    return { begin, end < frustum.lastSlice + 1 ? end : frustum.lastSlice + 1 };
  }

  LIMPID_HD static LIMPID_INLINE void Load(
    bool first, const double* opticalDepths, int index, RayHere& here)
  {
    StartInFront{ here.States() }(0);
    here.opticalDepth = first ? 0.0 : opticalDepths[index];
  }

  LIMPID_HD static LIMPID_INLINE void Store(const RayHere& here, double* opticalDepths, int index)
  {
    opticalDepths[index] = here.opticalDepth;
  }

  template <class Kernel>
  LIMPID_HD static LIMPID_INLINE void Cross(const Range<int>& slices, const FaceFrustum&,
    const Kernel& kernel, const SlabImages& images, Index index, RaySampler& ray, RayHere& here)
  {
    for (int s = slices.begin; s < slices.end; ++s)
    {
      kernel.RayStep(ray, s, Range<int>{});
      images.Take<Kernel>(s, index, here.States());
    }
  }
};

/// Phases of a sweep, slab by slab, for a kernel whose rays do not depend on the changes of
/// voxels. In each phase the rays cross a slab, while the voxels of the previous slab read the
/// images that the rays have left there.
template <class Way, class Kernel>
struct SlabPhases
{
  FaceFrustum frustum;
  typename Way::Carried carried;
  Kernel kernel;
  SlabImages images;
  int slabs;

  template <class AnyDevice>
  SlabPhases(FrustumRays<AnyDevice>& rays, float* room, const Kernel& what)
    : frustum(rays.Plan())
    , carried(Way::CarriedBy(rays))
    , kernel(what)
    , images(rays, slicesPerSlab, room)
    , slabs((Way::CountOf(this->frustum) + slicesPerSlab - 1) / slicesPerSlab)
  {
  }

  int PhaseCount() const { return this->slabs + 1; }

  LIMPID_HD LIMPID_INLINE Extent ExtentOf(int phase) const
  {
    const int slices = phase > 0 ? Way::SlabOf(this->frustum, phase - 1).Length() : 0;
    const bool moreRays = this->frustum.columns > this->frustum.nodesU;
    return { moreRays ? this->frustum.columns : this->frustum.nodesU,
      this->RowsOfRays(phase) + slices * this->frustum.nodesV };
  }

  LIMPID_HD LIMPID_INLINE void operator()(int phase, int column, int row) const
  {
    const int rows = this->RowsOfRays(phase);
    if (row < rows)
    {
      this->MoveRay(phase, column, row);
    }
    else
    {
      const int number = row - rows; // index in a list of slices with nodesV rows each
      const Range<int> slab = Way::SlabOf(this->frustum, phase - 1);
      this->VisitVoxel(
        slab.begin + number / this->frustum.nodesV, column, number % this->frustum.nodesV);
    }
  }

private:
  LIMPID_HD LIMPID_INLINE int RowsOfRays(int phase) const
  {
    return phase < this->slabs ? this->frustum.rows : 0;
  }

  LIMPID_HD LIMPID_INLINE void MoveRay(int slab, int column, int row) const
  {
    if (column >= this->frustum.columns)
    {
      return;
    }
    const int index = this->frustum.RayAt(column, row);
    RayHere here;
    Way::Load(slab == 0, this->carried, index, here);
    RaySampler ray(this->frustum, here.States(), column, row);
    Way::Cross(Way::SlabOf(this->frustum, slab), this->frustum, this->kernel, this->images, index,
      ray, here);
    Way::Store(here, this->carried, index);
  }

  LIMPID_HD LIMPID_INLINE void VisitVoxel(int s, int u, int v) const
  {
    const Slice& slice = this->frustum.SliceAt(s);
    if (slice.node >= 0 && slice.ownedColumns.Contains(u) && slice.ownedRows.Contains(v))
    {
      VoxelSampler voxel(this->frustum, s, u, v);
      this->kernel.VoxelStep(voxel, this->images.At(s));
    }
  }
};

inline Extent ExtentOfRays(const FaceFrustum& frustum)
{
  return { frustum.columns, frustum.rows };
}

/// Runs the phases of SlabPhases.
template <class Way, class AnyDevice, class Kernel>
void SweepSlabs(AnyDevice& device, FrustumRays<AnyDevice>& rays, const Kernel& kernel)
{
  DeviceArray<AnyDevice, float> images = SlabImages::RoomFor(rays, slicesPerSlab);
  const SlabPhases<Way, Kernel> phases(rays, images.Data(), kernel);
  device.ForPhases(Kernel::label, phases.PhaseCount(), phases);
}
}

/// Front to back: moves every ray through all layers in one launch. `Ray`: the sampler.
template <class Ray = RaySampler, class AnyDevice, class Kernel>
void SweepForward(
  AnyDevice& device, FrustumRays<AnyDevice>& rays, const Occupancy&, const Kernel& kernel)
{
  const FaceFrustum& frustum = rays.Plan();
  device.ForEach(Kernel::label, detail::ExtentOfRays(frustum),
    detail::ForwardRay<Ray, Kernel>{ frustum, rays.States(), kernel });
}

/// Back to front without voxels: moves every ray through all layers in one launch. Keeps the
/// optical depths.
template <class AnyDevice, class Kernel>
void SweepRaysBackward(
  AnyDevice& device, FrustumRays<AnyDevice>& rays, const Occupancy&, const Kernel& kernel)
{
  device.ForEach(Kernel::label, detail::ExtentOfRays(rays.Plan()),
    detail::BackwardRay<Kernel>{ rays.Plan(), rays.States(), kernel });
}

/// Back to front over all slices of voxels, for a kernel whose rays do not depend on the changes
/// of voxels.
template <class AnyDevice, class Kernel>
void SweepBackward(
  AnyDevice& device, FrustumRays<AnyDevice>& rays, const Occupancy&, const Kernel& kernel)
{
  detail::SweepSlabs<detail::BackToFront>(device, rays, kernel);
}

/// Front to back over all slices, including the source's own.
template <class AnyDevice, class Kernel>
void SweepFrontToBack(AnyDevice& device, FrustumRays<AnyDevice>& rays, const Kernel& kernel)
{
  detail::SweepSlabs<detail::FrontToBack>(device, rays, kernel);
}
}

#endif
