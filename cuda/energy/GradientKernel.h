// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_GradientKernel_h
#define limpid_energy_GradientKernel_h

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

/// The derivative at a voxel that reads rays. Where nothing of importance is about it, more
/// extinction shows nothing; an empty voxel, which has no importance of a node, stays empty
/// (deviation D8).
struct GradientStep
{
  const float* effect;         ///< see VoxelRow::FindEffect
  const float* nodeImportance; ///< [0, 1]
  float area;                  ///< what brings the effect to one area on all slices
  GradientTarget target;
  float* gradient; ///< in and out

  LIMPID_HD LIMPID_INLINE void operator()(Index u) const
  {
    const float found = this->effect[u];
    const float derivative = this->nodeImportance[u] > 0.0f ? found : AtLeast(found, 0.0f);
    this->gradient[u] =
      this->target.kept * this->gradient[u] + this->target.weight * (this->area * derivative);
  }
};

/**
 * The derivative of a visibility term by a fixed extinction, Eqs. (26)-(28), that of the score as
 * it is summed: back to front, the optical depths unwind, visible importance is carried along, and
 * rays find what extinction at the ends of each layer does to it (EffectStep). The voxels of a
 * slice gather that of the rays which read them, with the weights of that interpolation. Rays start
 * with the optical depths of the extinction.
 *
 * Deviation D1: rays carry the weight t'^2 / t^2 of the widening rays, so that this is the
 * derivative of the volume integral, unless the sweep is made with Derivative::Ray.
 */
template <class Input, class Output>
struct GradientKernel
{
  static constexpr const char* label = "derivative";
  static constexpr auto seenBehind = &RayStates::effect; ///< what voxels read

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
    const FieldUse read{ 0, false, true, 1 };
    return { windows(this->extinction, read), windows(this->importance, read),
      windows(this->nodeImportance, FieldUse{ 0 }), windows(this->base, read),
      windows(this->gradient, FieldUse{ 0, true, this->target.kept != 0 }), this->target,
      this->areaWeighted };
  }

  /// What its rays carry.
  std::vector<RayValues> Carried(const RayStates& rays) const
  {
    std::vector<RayValues> carried{ rays.opticalDepth, rays.behind, rays.visible, rays.unattenuated,
      rays.effect, rays.effectBehind };
    if (this->base)
    {
      carried.insert(carried.end(), { rays.keptBehind, rays.keptVisible, rays.keptUnattenuated });
    }
    return carried;
  }

  /// From slice `s` to the next one in front, so that the effect of slice `s` is known.
  template <class Rays>
  LIMPID_HD LIMPID_INLINE void RayStep(Rays& rays, int s) const
  {
    // Rays that had an effect on the slice behind, or have one through the layer behind this one.
    if (rays.SelectBeside(s))
    {
      rays.ForEach(BeginEffectStep{ rays.States() });
    }
    if (s > 0 && rays.EnterLayer(s - 1, this->areaWeighted))
    {
      this->Carry(rays);
    }
  }

  /// Rays have come out of the volume with the effect of the first slice.
  template <class Rays>
  LIMPID_HD LIMPID_INLINE void LeaveStep(Rays&) const
  {
  }

  template <class Voxels>
  LIMPID_HD LIMPID_INLINE void VoxelStep(Voxels& voxels, const typename Voxels::Rays& rays) const
  {
    voxels.Prefetch(this->nodeImportance);
    voxels.Prefetch(this->gradient);
    if (voxels.FindEffect(rays))
    {
      const float scale = voxels.SliceHere().scale;
      voxels.ForActive(GradientStep{ voxels.EffectHere(), voxels.Row(this->nodeImportance),
        this->areaWeighted ? 1.0f : scale * scale, this->target, voxels.Row(this->gradient) });
    }
  }

private:
  template <class Rays>
  LIMPID_HD LIMPID_INLINE void Carry(Rays& rays) const
  {
    rays.SampleExtinction(this->extinction);
    rays.SampleImportance(this->importance);
    rays.ForEachInLayer(UnwindStep{ rays.States() });
    const RayFields<typename Rays::Field> fields{ this->extinction, this->importance, this->base };
    if (!this->base)
    {
      rays.ForEachResolved(fields, ResolveLit<>{ rays.States().opticalDepth },
        EffectStep<Kept::Ignored>{ rays.States() });
      return;
    }
    rays.SampleKept(this->extinction, this->base);
    rays.ForEachResolved(fields, ResolveLit<>{ rays.States().opticalDepth },
      EffectStep<Kept::Counted>{ rays.States() });
  }
};
}

#endif
