// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_SlabImages_h
#define limpid_sweep_SlabImages_h

#include "sweep/FrustumRays.h"
#include "sweep/VoxelSampler.h"

namespace limpid
{
namespace detail
{
/// Images of the rays on the slices of two slabs: the one that rays cross, and the one before it,
/// which voxels read.
struct SlabImages
{
  int slices; ///< number of slices of both slabs, a power of two
  SeenOfRay* seen;
  float* density;
  const HatOfVoxel* hats; ///< see MadeHat
  Index rays;
  int nodesU;
  int nodesV;

  /// Allocates memory for all images.
  template <class AnyDevice>
  static DeviceArray<AnyDevice, float> RoomFor(FrustumRays<AnyDevice>& frustum, int slicesPerSlab)
  {
    return frustum.MakeImages(3 * 2 * slicesPerSlab * frustum.Plan().RayCount());
  }

  template <class AnyDevice>
  SlabImages(FrustumRays<AnyDevice>& frustum, int slicesPerSlab, float* room)
    : slices(2 * slicesPerSlab)
    , seen(reinterpret_cast<SeenOfRay*>(room))
    , density(room + 2 * this->slices * frustum.Plan().RayCount())
    , hats(frustum.Hats())
    , rays(frustum.Plan().RayCount())
    , nodesU(frustum.Plan().nodesU)
    , nodesV(frustum.Plan().nodesV)
  {
  }

  /// Stores the values of a ray that voxels read.
  template <class Kernel>
  LIMPID_HD LIMPID_INLINE void Take(int s, Index ray, const RayStates& here) const
  {
    const Index at = this->First(s) + ray;
    const float behind = *(here.*Kernel::seenBehind);
    this->seen[at] = { *here.transmittance, *here.transmittance * behind };
    this->density[at] = *here.density;
  }

  /// Returns the images that voxels of slice `s` read.
  LIMPID_HD LIMPID_INLINE SliceImages At(int s) const
  {
    const HatOfVoxel* columnHats = this->hats + Index(s) * (this->nodesU + this->nodesV);
    return { this->seen + this->First(s), this->density + this->First(s), columnHats,
      columnHats + this->nodesU };
  }

private:
  /// Slices of two consecutive slabs have different low bits of s.
  LIMPID_HD LIMPID_INLINE Index First(int s) const { return (s & (this->slices - 1)) * this->rays; }
};
}
}

#endif
