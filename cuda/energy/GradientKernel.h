// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_GradientKernel_h
#define limpid_energy_GradientKernel_h

#include "energy/GradientVoxel.h"
#include "sweep/RaySteps.h"
#include "sweep/SliceWindow.h"

namespace limpid
{
/// Where derivatives go: field = kept field + weight derivative.
struct GradientTarget
{
  float kept;
  float weight;
};

/// The derivative at a voxel that reads rays.
struct GradientStep
{
  const float* transmittance; ///< mean of the rays [0, 1]
  const float* behind;        ///< mean of what it leaves of the importance behind [scale^2]
  const float* importance;    ///< of the node, as far as it is in view [0, 1]
  GradientVoxel<float> derivative;
  GradientTarget target;
  float* gradient; ///< in and out

  LIMPID_HD LIMPID_INLINE void operator()(Index u) const
  {
    this->gradient[u] = this->target.kept * this->gradient[u] +
      this->target.weight *
        this->derivative(this->transmittance[u], this->behind[u], this->importance[u]);
  }
};

/**
 * The derivative of a visibility term by a fixed extinction, Eqs. (26)-(28): back to front, the
 * optical depths unwind and visible importance is carried along; on every slice, the voxels read
 * both. Rays start with the optical depths of the extinction.
 */
template <class Input, class Output>
struct GradientKernel
{
  static constexpr const char* label = "derivative";
  static constexpr auto seenBehind = &RayStates::behind; ///< what voxels read

  Input extinction;     ///< [1/length]
  Input importance;     ///< [0, 1]
  Input nodeImportance; ///< see NodeImportance.h [0, 1]
  Input base;           ///< [1/length]; null: what is kept is not counted
  Output gradient;
  GradientTarget target;
  bool areaWeighted; ///< whether rays carry the weight of Deviation D1

  template <class Windows>
  GradientKernel<SliceWindow*, SliceWindow*> With(Windows& windows) const
  {
    return { windows(this->extinction, FieldUse{ 1 }), windows(this->importance, FieldUse{ 1 }),
      windows(this->nodeImportance, FieldUse{ 0 }), windows(this->base, FieldUse{ 1 }),
      windows(this->gradient, FieldUse{ 0, true, this->target.kept != 0 }), this->target,
      this->areaWeighted };
  }

  /// What its rays carry.
  std::vector<RayValues> Carried(const RayStates& rays) const
  {
    std::vector<RayValues> carried{ rays.opticalDepth, rays.behind, rays.visible, rays.unattenuated,
      rays.transmittance, rays.density };
    if (this->base)
    {
      carried.insert(carried.end(), { rays.keptBehind, rays.keptVisible, rays.keptUnattenuated });
    }
    return carried;
  }

  /// From the slice behind to slice `s`.
  template <class Rays>
  LIMPID_HD LIMPID_INLINE void RayStep(Rays& rays, int s) const
  {
    if (!rays.EnterLayer(s, this->areaWeighted))
    {
      return;
    }
    if (s < rays.Plan().lastSlice)
    {
      this->Carry(rays);
    }
    else
    {
      rays.SampleNothing();
    }
    constexpr float unlimited = 1e30f;
    rays.ForEach(TransmitStep{ rays.States() });
    rays.ForEachNearSides(DensityStep{ rays.States(), rays.Plan().frontDepth, true, unlimited });
  }

  /// From the first slice of voxels to the source.
  template <class Rays>
  LIMPID_HD LIMPID_INLINE void LeaveStep(Rays& rays) const
  {
    for (int s = rays.Plan().firstNodeSlice; s-- > 0;)
    {
      if (rays.EnterLayer(s, this->areaWeighted))
      {
        this->Carry(rays);
      }
    }
  }

  template <class Voxels>
  LIMPID_HD LIMPID_INLINE void VoxelStep(Voxels& voxels, const typename Voxels::Rays& rays) const
  {
    voxels.Prefetch(this->nodeImportance);
    voxels.Prefetch(this->gradient);
    if (voxels.FindSeen(rays))
    {
      const auto seen = voxels.SeenHere();
      voxels.ForActive(GradientStep{ seen.transmittance, seen.behind,
        voxels.ImportanceInView(this->nodeImportance),
        GradientVoxel<float>::On(voxels.SliceHere(), this->areaWeighted), this->target,
        voxels.Row(this->gradient) });
    }
  }

private:
  template <class Rays>
  LIMPID_HD LIMPID_INLINE void Carry(Rays& rays) const
  {
    rays.SampleExtinction(this->extinction);
    rays.SampleImportance(this->importance);
    if (!this->base)
    {
      rays.ForEachInLayer(CarryAndUnwindStep<Kept::Ignored>{ rays.States() });
      return;
    }
    rays.SampleKept(this->extinction, this->base);
    rays.ForEachInLayer(CarryAndUnwindStep<Kept::Counted>{ rays.States() });
  }
};
}

#endif
