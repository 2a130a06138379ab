// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_SlabImages_h
#define limpid_sweep_SlabImages_h

#include "sweep/FrustumRays.h"
#include "sweep/RayHere.h"
#include "sweep/RaySampler.h"
#include "sweep/VoxelSampler.h"

namespace limpid
{
namespace detail
{
/// Images of the rays on the slices of two slabs: the one that rays cross, and the one before it,
/// which voxels read. They hold the channels of ForRead.
template <class Kernel>
struct SlabImages
{
  int slices; ///< number of slices of both slabs, a power of two
  float* values;
  float* density;
  const HatOfVoxel* hats; ///< see MadeHat
  Index rays;
  int nodesU;
  int nodesV;

  /// Number of slices per slab, a power of two: as many as the second-level cache of a large GPU
  /// (50 MB) has room for beside the fields. With few slices, rays take longer to be read and
  /// written than to cross them (measured with 1 and 2: slower than with 4 beyond the cache).
  static int SlicesFor(Index rays)
  {
    constexpr Index least = 4;
    constexpr Index most = 16;
    constexpr Index room = Index(24) << 20; // [bytes]
    Index slices = most;
    while (slices > least && 2 * slices * rays * Index(sizeof(float)) > room)
    {
      slices /= 2;
    }
    return static_cast<int>(slices);
  }

  /// Allocates memory for all images.
  template <class AnyDevice>
  static DeviceArray<AnyDevice, float> RoomFor(FrustumRays<AnyDevice>& frustum, int slicesPerSlab)
  {
    return frustum.MakeImages(
      (OfValue + OfDensity) * 2 * slicesPerSlab * frustum.Plan().RayCount());
  }

  template <class AnyDevice>
  SlabImages(FrustumRays<AnyDevice>& frustum, int slicesPerSlab, float* room)
    : slices(2 * slicesPerSlab)
    , values(room)
    , density(room + OfValue * this->slices * frustum.Plan().RayCount())
    , hats(frustum.Hats())
    , rays(frustum.Plan().RayCount())
    , nodesU(frustum.Plan().nodesU)
    , nodesV(frustum.Plan().nodesV)
  {
  }

  /// Stores the values of a ray that voxels read. `nearSides`: FaceFrustum::IsNearSides.
  LIMPID_HD LIMPID_INLINE void Take(int s, Index ray, bool nearSides, const RayStates& here) const
  {
    const Index at = this->First(s) + ray;
    if constexpr (Kernel::readByVoxels == RayChannel::Effect)
    {
      this->values[at] = *here[RayChannel::Effect];
    }
    else
    {
      this->TakeLight(at, here);
      if (nearSides)
      {
        this->density[at] = *here[RayChannel::Density];
      }
    }
  }

  /// Returns the images that voxels of slice `s` read.
  LIMPID_HD LIMPID_INLINE SliceImages At(int s) const
  {
    const HatOfVoxel* columnHats = this->hats + Index(s) * (this->nodesU + this->nodesV);
    const Index first = this->First(s);
    const float* here = this->values + first;
    return { HasSeen ? this->Seen() + first : nullptr,
      Kernel::readByVoxels == RayChannel::Transmittance ? here : nullptr,
      Kernel::readByVoxels == RayChannel::Effect ? here : nullptr, this->density + first,
      columnHats, columnHats + this->nodesU };
  }

  /// Stores the values of a ray in all images.
  LIMPID_HD LIMPID_INLINE void TakeEverywhere(Index ray, const RayStates& here) const
  {
    for (int s = 0; s < this->slices; ++s)
    {
      this->Take(s, ray, true, here);
    }
  }

private:
  /// Whether voxels read transmittance and attenuated importance behind.
  static constexpr bool HasSeen =
    Kernel::readByVoxels != RayChannel::Effect && Kernel::readByVoxels != RayChannel::Transmittance;

  /// Numbers per ray and slice.
  static constexpr Index OfValue = HasSeen ? 2 : 1;
  static constexpr Index OfDensity = Kernel::readByVoxels == RayChannel::Effect ? 0 : 1;

  LIMPID_HD LIMPID_INLINE SeenOfRay* Seen() const
  {
    return reinterpret_cast<SeenOfRay*>(this->values);
  }

  LIMPID_HD LIMPID_INLINE void TakeLight(Index at, const RayStates& here) const
  {
    const float transmittance = *here[RayChannel::Transmittance];
    if constexpr (HasSeen)
    {
      this->Seen()[at] = { transmittance, transmittance * *here[Kernel::readByVoxels] };
    }
    else
    {
      this->values[at] = transmittance;
    }
  }

  /// Slices of two consecutive slabs have different low bits of s.
  LIMPID_HD LIMPID_INLINE Index First(int s) const { return (s & (this->slices - 1)) * this->rays; }
};

/// Initialises a ray for a sweep, and its images, as it may not be active for long. `Start`:
/// StartBehind or StartInFront.
template <class Start, class Kernel>
struct StartedRay
{
  RayStates states;
  Kernel kernel;
  SlabImages<Kernel> images;

  LIMPID_HD void operator()(Index ray) const
  {
    this->kernel.ForCarried(Start{ this->states.From(ray) });
    RayHere here;
    ForRead<Kernel::readByVoxels>(Start{ here.States() });
    this->images.TakeEverywhere(ray, here.States());
  }
};

/// Moves a ray out of the volume.
template <class Kernel>
struct LeavingRay
{
  FaceFrustum frustum;
  RayStates states;
  Kernel kernel;

  LIMPID_HD void operator()(int column, int row) const
  {
    const RayStates here = this->states.From(this->frustum.RayAt(column, row));
    RaySampler ray(this->frustum, here, column, row);
    this->kernel.LeaveStep(ray);
    this->kernel.ForCarried(FinishBehind{ here });
  }
};
}
}

#endif
