// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How a device sweeps: launch by launch, a thread for every ray or voxel. A kernel says what
// happens to them; SweepRows.h sweeps the same kernels on the processor.

#ifndef limpid_sweep_SweepLaunches_h
#define limpid_sweep_SweepLaunches_h

#include "backend/Extent.h"
#include "sweep/FrustumRays.h"
#include "sweep/RaySampler.h"
#include "sweep/VoxelSampler.h"

#include <algorithm>

namespace limpid
{
/// So few that the images of a slab of slices stay in the second-level cache of a large GPU (30 MB
/// at 256^3), and as many as there are floats in 32 bytes, which a slab writes at once where the
/// depth axis is the fastest in memory.
constexpr int slicesPerLaunch = 8;

namespace detail
{
/// What one ray carries, in registers.
struct RayHere
{
  double opticalDepth = 0;
  double collected = 0;
  float behind = 0;
  float visible = notEntered;
  float unattenuated = 0;
  float transmittance = 1;
  float density = 0;
  float ahead = 0;
  float rearImportance = 0;
  float keptBehind = 0;
  float keptVisible = notEntered;
  float keptUnattenuated = 0;
  float alternativeBehind = 0;
  float cost = 0;
  float reach = 0;

  LIMPID_HD LIMPID_INLINE RayStates States()
  {
    return { &this->opticalDepth, &this->collected, &this->behind, &this->visible,
      &this->unattenuated, &this->transmittance, &this->density, &this->ahead,
      &this->rearImportance, &this->keptBehind, &this->keptVisible, &this->keptUnattenuated,
      &this->alternativeBehind, &this->cost, &this->reach };
  }

  LIMPID_HD LIMPID_INLINE void Load(const RayStates& ray)
  {
    this->opticalDepth = *ray.opticalDepth;
    this->behind = *ray.behind;
    this->visible = *ray.visible;
    this->unattenuated = *ray.unattenuated;
    this->transmittance = *ray.transmittance;
    this->density = *ray.density;
    this->keptBehind = *ray.keptBehind;
    this->keptVisible = *ray.keptVisible;
    this->keptUnattenuated = *ray.keptUnattenuated;
  }

  LIMPID_HD LIMPID_INLINE void Store(const RayStates& ray) const
  {
    *ray.opticalDepth = this->opticalDepth;
    *ray.behind = this->behind;
    *ray.visible = this->visible;
    *ray.unattenuated = this->unattenuated;
    *ray.transmittance = this->transmittance;
    *ray.density = this->density;
    *ray.keptBehind = this->keptBehind;
    *ray.keptVisible = this->keptVisible;
    *ray.keptUnattenuated = this->keptUnattenuated;
  }
};

/// Images of the rays on the slices of a launch: transmittance, density, visible importance behind.
struct SliceImages
{
  float* values;
  Index rays;
  int begin; ///< first slice

  static std::size_t Size(const FaceFrustum& frustum)
  {
    return std::size_t(3 * slicesPerLaunch * frustum.RayCount());
  }

  LIMPID_HD LIMPID_INLINE float* Of(int s, int image) const
  {
    return this->values + (3 * (s - this->begin) + image) * this->rays;
  }

  LIMPID_HD LIMPID_INLINE void Take(int s, Index ray, const RayHere& here) const
  {
    this->Of(s, 0)[ray] = here.transmittance;
    this->Of(s, 1)[ray] = here.density;
    this->Of(s, 2)[ray] = here.behind;
  }

  /// What voxels of slice `s` read.
  LIMPID_HD LIMPID_INLINE RayStates StatesAt(int s) const
  {
    RayStates states{};
    states.transmittance = this->Of(s, 0);
    states.density = this->Of(s, 1);
    states.behind = this->Of(s, 2);
    return states;
  }
};

/// A ray through all layers, front to back.
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

/// A ray through the slices of a launch, back to front.
template <class Kernel>
struct BackwardRay
{
  FaceFrustum frustum;
  RayStates states;
  Kernel kernel;
  Range<int> slices;
  SliceImages images;

  LIMPID_HD void operator()(int i, int j) const
  {
    const Index index = this->frustum.RayAt(i, j);
    RayHere here;
    here.Load(this->states.From(index));
    RaySampler ray(this->frustum, here.States(), i, j);
    for (int s = this->slices.end; s-- > this->slices.begin;)
    {
      this->kernel.RayStep(ray, s);
      this->images.Take(s, index, here);
    }
    if (this->slices.begin == this->frustum.firstNodeSlice)
    {
      this->kernel.LeaveStep(ray);
      FinishBehind{ here.States() }(0);
    }
    here.Store(this->states.From(index));
  }
};

/// A ray through the slices of a launch, front to back.
template <class Kernel>
struct FrontToBackRay
{
  FaceFrustum frustum;
  RayStates states;
  Kernel kernel;
  Range<int> slices;
  SliceImages images;

  LIMPID_HD void operator()(int i, int j) const
  {
    const Index index = this->frustum.RayAt(i, j);
    RayHere here;
    here.opticalDepth = this->states.opticalDepth[index];
    RaySampler ray(this->frustum, here.States(), i, j);
    for (int s = this->slices.begin; s < this->slices.end; ++s)
    {
      this->kernel.RayStep(ray, s, Range<int>{});
      this->images.Take(s, index, here);
    }
    this->states.opticalDepth[index] = here.opticalDepth;
  }
};

/// A voxel on the slices of a launch. `row`: slice by slice, nodesV each.
template <class Kernel>
struct VoxelOfSlices
{
  FaceFrustum frustum;
  Kernel kernel;
  SliceImages images;

  LIMPID_HD void operator()(int u, int row) const
  {
    const int s = this->images.begin + row / this->frustum.nodesV;
    const int v = row % this->frustum.nodesV;
    const Slice& slice = this->frustum.SliceAt(s);
    if (slice.node >= 0 && slice.ownedColumns.Contains(u) && slice.ownedRows.Contains(v))
    {
      VoxelSampler voxel(this->frustum, s, u, v);
      this->kernel.VoxelStep(voxel, this->images.StatesAt(s));
    }
  }
};

/// Back to front, two phases per slice: first all rays move to it through the voxels behind, then
/// its own voxels are visited. In a last phase the rays leave the volume.
template <class Kernel>
struct BackwardPhases
{
  FaceFrustum frustum;
  RayStates states;
  Kernel kernel;

  int PhaseCount() const
  {
    return 2 * (this->frustum.SliceCount() - this->frustum.firstNodeSlice) + 1;
  }

  LIMPID_HD LIMPID_INLINE Extent ExtentOf(int phase) const
  {
    if (IsOfRays(phase))
    {
      return { this->frustum.columns, this->frustum.rows };
    }
    const Slice& slice = this->frustum.SliceAt(this->SliceOf(phase));
    return { slice.ownedColumns.Length(), slice.ownedRows.Length() };
  }

  LIMPID_HD LIMPID_INLINE void operator()(int phase, int column, int row) const
  {
    const int s = this->SliceOf(phase);
    if (!IsOfRays(phase))
    {
      const Slice& slice = this->frustum.SliceAt(s);
      VoxelSampler voxel(
        this->frustum, s, slice.ownedColumns.begin + column, slice.ownedRows.begin + row);
      this->kernel.VoxelStep(voxel, this->states);
      return;
    }
    const RayStates here = this->states.From(this->frustum.RayAt(column, row));
    RaySampler ray(this->frustum, here, column, row);
    if (s >= this->frustum.firstNodeSlice)
    {
      this->kernel.RayStep(ray, s);
      return;
    }
    this->kernel.LeaveStep(ray);
    FinishBehind{ here }(0);
  }

private:
  LIMPID_HD static LIMPID_INLINE bool IsOfRays(int phase) { return phase % 2 == 0; }

  LIMPID_HD LIMPID_INLINE int SliceOf(int phase) const
  {
    return this->frustum.lastSlice - phase / 2;
  }
};

inline Extent ExtentOfRays(const FaceFrustum& frustum)
{
  return { frustum.columns, frustum.rows };
}

/// The rays through some slices, and then the voxels on them, which read what the rays left.
template <template <class> class RayThrough, class AnyDevice, class Kernel>
void LaunchSlices(AnyDevice& device, FrustumRays<AnyDevice>& rays, const Kernel& kernel,
  const Range<int>& slices, float* images)
{
  const FaceFrustum& frustum = rays.Plan();
  const SliceImages here{ images, frustum.RayCount(), slices.begin };
  device.ForEach(Kernel::label, ExtentOfRays(frustum),
    RayThrough<Kernel>{ frustum, rays.States(), kernel, slices, here });
  device.ForEach(Kernel::voxelLabel, { frustum.nodesU, frustum.nodesV * slices.Length() },
    VoxelOfSlices<Kernel>{ frustum, kernel, here });
}
}

/// Front to back: every ray through all layers, in one launch. `Ray`: how it is sampled.
template <class Ray = RaySampler, class AnyDevice, class Kernel>
void SweepForward(
  AnyDevice& device, FrustumRays<AnyDevice>& rays, const Occupancy&, const Kernel& kernel)
{
  const FaceFrustum& frustum = rays.Plan();
  device.ForEach(Kernel::label, detail::ExtentOfRays(frustum),
    detail::ForwardRay<Ray, Kernel>{ frustum, rays.States(), kernel });
}

/// Back to front over all slices of voxels, for a kernel whose rays do not depend on what it does
/// to the voxels. `images`: of the rays of slicesPerLaunch slices; it grows as needed.
template <class AnyDevice, class Kernel>
void SweepBackward(const std::shared_ptr<AnyDevice>& device, FrustumRays<AnyDevice>& rays,
  const Occupancy&, const Kernel& kernel, DeviceArray<AnyDevice, float>& images)
{
  const FaceFrustum& frustum = rays.Plan();
  images.RoomFor(device, detail::SliceImages::Size(frustum), "images of rays");
  device->ForIndices("start rays", frustum.RayCount(), StartBehind{ rays.States() });
  for (int end = frustum.SliceCount(); end > frustum.firstNodeSlice; end -= slicesPerLaunch)
  {
    const Range<int> slices{ std::max(frustum.firstNodeSlice, end - slicesPerLaunch), end };
    detail::LaunchSlices<detail::BackwardRay>(*device, rays, kernel, slices, images.Data());
  }
}

/// Back to front over all slices of voxels, slice by slice: the rays may depend on the voxels
/// behind.
template <class AnyDevice, class Kernel>
void SweepBackwardByPhases(AnyDevice& device, FrustumRays<AnyDevice>& rays, const Kernel& kernel)
{
  const FaceFrustum& frustum = rays.Plan();
  device.ForIndices("start rays", frustum.RayCount(), StartBehind{ rays.States() });
  const detail::BackwardPhases<Kernel> phases{ frustum, rays.States(), kernel };
  device.ForPhases(Kernel::label, phases.PhaseCount(), phases);
}

/// Front to back over all slices, the source's own included.
template <class AnyDevice, class Kernel>
void SweepFrontToBack(const std::shared_ptr<AnyDevice>& device, FrustumRays<AnyDevice>& rays,
  const Kernel& kernel, DeviceArray<AnyDevice, float>& images)
{
  const FaceFrustum& frustum = rays.Plan();
  images.RoomFor(device, detail::SliceImages::Size(frustum), "images of rays");
  device->ForIndices("start rays", frustum.RayCount(), StartInFront{ rays.States() });
  for (int begin = 0; begin < frustum.SliceCount(); begin += slicesPerLaunch)
  {
    const Range<int> slices{ begin, std::min(begin + slicesPerLaunch, frustum.SliceCount()) };
    detail::LaunchSlices<detail::FrontToBackRay>(*device, rays, kernel, slices, images.Data());
  }
}
}

#endif
