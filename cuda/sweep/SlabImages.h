// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_SlabImages_h
#define limpid_sweep_SlabImages_h

#include "sweep/FrustumRays.h"
#include "sweep/VoxelSampler.h"

namespace limpid
{
/// Slices that rays cross between one wait and the next. So few that the images of two slabs stay
/// in the second-level cache of a large GPU (30 MB at 256^3).
constexpr int slicesPerSlab = 4;

namespace detail
{
/// Images of the rays on the slices of two slabs, that of the rays and the one before it, which
/// voxels read.
struct SlabImages
{
  static constexpr int slices = 2 * slicesPerSlab;

  SeenOfRay* seen;
  float* density;
  const HatOfVoxel* hats; ///< see MadeHat
  Index rays;
  int nodesU;
  int nodesV;

  template <class AnyDevice>
  explicit SlabImages(FrustumRays<AnyDevice>& frustum)
    : hats(frustum.Hats())
    , rays(frustum.Plan().RayCount())
    , nodesU(frustum.Plan().nodesU)
    , nodesV(frustum.Plan().nodesV)
  {
    float* room = frustum.ImageRoom(std::size_t(3 * slices * this->rays));
    this->seen = reinterpret_cast<SeenOfRay*>(room);
    this->density = room + 2 * slices * this->rays;
  }

  /// Takes what voxels read of a ray.
  template <class Kernel>
  LIMPID_HD LIMPID_INLINE void Take(int s, Index ray, const RayStates& here) const
  {
    const Index at = this->First(s) + ray;
    const float behind = *(here.*Kernel::seenBehind);
    this->seen[at] = { *here.transmittance, *here.transmittance * behind };
    this->density[at] = *here.density;
  }

  /// What voxels of slice `s` read.
  LIMPID_HD LIMPID_INLINE SliceImages At(int s) const
  {
    const HatOfVoxel* columnHats = this->hats + Index(s) * (this->nodesU + this->nodesV);
    return { this->seen + this->First(s), this->density + this->First(s), columnHats,
      columnHats + this->nodesU };
  }

private:
  /// Slabs are neighbours, so that this tells the slices of one from those of the other.
  LIMPID_HD LIMPID_INLINE Index First(int s) const { return (s % slices) * this->rays; }
};
}
}

#endif
