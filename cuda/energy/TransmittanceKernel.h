// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_TransmittanceKernel_h
#define limpid_energy_TransmittanceKernel_h

#include "sweep/Cubic.h"
#include "sweep/RaySteps.h"
#include "sweep/SliceWindow.h"

namespace limpid
{
/// The transmittance from a source to every voxel, Eqs. (15) and (16). Front to back, optical
/// depths grow, and the voxels of every slice read them.
template <class Input, class Output>
struct TransmittanceKernel
{
  static constexpr const char* label = "transmittance";
  static constexpr RayChannel readByVoxels = RayChannel::Transmittance; ///< see ForRead

  Input extinction;     ///< [1/length]
  Output transmittance; ///< [0, 1]

  template <class Windows>
  TransmittanceKernel<SliceWindow*, SliceWindow*> With(Windows& windows) const
  {
    return { windows(this->extinction, FieldUse{ 1 }),
      windows(this->transmittance, FieldUse{ 0, true }) };
  }

  /// Calls visit for the values that rays carry.
  template <class Visit>
  LIMPID_HD LIMPID_INLINE void ForCarried(const Visit& visit) const
  {
    visit(RayDepth::ToSlice);
  }

  /// Computes what voxels of slice `s` read, then moves rays through the layer behind it.
  /// `dimmed`: columns of rays that have met anything.
  template <class Rays>
  LIMPID_HD LIMPID_INLINE void RayStep(Rays& rays, int s, const Range<int>& dimmed) const
  {
    const bool meets = rays.EnterLayer(s, true) && s < rays.Plan().lastSlice;
    if (meets)
    {
      rays.SampleExtinction(this->extinction);
    }
    if (rays.SelectReadBySlice(s, meets, dimmed))
    {
      rays.ForEach(TransmitStep{ rays.States() });
      rays.ForEachNearSides(
        DensityStep{ rays.States(), rays.Plan().frontDepth, false, mostDepthBetweenRays });
    }
    if (meets)
    {
      rays.EnterLayer(s, true);
      rays.ForEachInLayer(DeepenStep{ rays.States() });
    }
  }

  template <class Voxels>
  LIMPID_HD LIMPID_INLINE void VoxelStep(Voxels& voxels, const typename Voxels::Rays& rays) const
  {
    voxels.FindTransmittance(rays, voxels.Row(this->transmittance));
  }
};
}

#endif
