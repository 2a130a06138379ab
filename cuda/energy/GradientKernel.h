// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_GradientKernel_h
#define limpid_energy_GradientKernel_h

#include "sweep/RaySteps.h"
#include "sweep/SliceWindow.h"

namespace limpid
{
/// How derivatives are stored: field = kept * field + weight * derivative.
struct GradientTarget
{
  float kept;
  float weight;
};

/// Computes the derivative at a voxel that reads rays. If no importance is near, more extinction
/// cannot show anything, so the derivative is at least 0. Empty voxels, whose node importance is
/// 0, stay empty (deviation D8).
struct GradientStep
{
  const float* effect;         ///< see VoxelRow::FindEffect
  const float* nodeImportance; ///< [0, 1]
  float area;                  ///< normalises the effect to the same area on all slices
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
 * The derivative of a visibility term by the extinction, Eqs. (26)-(28), with the quadrature of
 * the score. Back to front, optical depths are unwound and visible importance is carried along.
 * Rays compute the effect of the extinction at both ends of each layer (EffectStep). The voxels of
 * a slice gather the effects of the rays that interpolate them, with the same weights. Rays start
 * with the optical depths of the extinction.
 *
 * Deviation D1: rays carry the weight t'^2 / t^2 of widening rays, so that this is the derivative
 * of the volume integral, unless Derivative::Ray is used.
 */
template <class Input, class Output, Kept kept>
struct GradientKernel
{
  static constexpr const char* label = "derivative";
  static constexpr RayChannel readByVoxels = RayChannel::Effect; ///< see ForRead

  Input extinction;     ///< [1/length]
  Input importance;     ///< [0, 1]
  Input nodeImportance; ///< see NodeImportance.h [0, 1]
  Input base;           ///< [1/length]; null for Kept::Ignored
  Output gradient;
  GradientTarget target;
  bool areaWeighted; ///< whether rays carry the weight of Deviation D1

  template <class Windows>
  GradientKernel<SliceWindow*, SliceWindow*, kept> With(Windows& windows) const
  {
    const FieldUse read{ 0, false, true, 1 };
    return { windows(this->extinction, read), windows(this->importance, read),
      windows(this->nodeImportance, FieldUse{ 0 }), windows(this->base, read),
      windows(this->gradient, FieldUse{ 0, true, this->target.kept != 0 }), this->target,
      this->areaWeighted };
  }

  /// Calls visit for the values that rays carry.
  template <class Visit>
  LIMPID_HD LIMPID_INLINE void ForCarried(const Visit& visit) const
  {
    if (kept == Kept::Counted)
    {
      ForKept(visit);
    }
    ForValues(visit, RayDepth::ToSlice, RayChannel::Behind, RayChannel::Visible,
      RayChannel::Unattenuated, RayChannel::Effect, RayChannel::EffectBehind);
  }

  /// Moves rays from slice `s` to the next slice in front, which completes the effect of slice
  /// `s`.
  template <class Rays>
  LIMPID_HD LIMPID_INLINE void RayStep(Rays& rays, int s) const
  {
    // Rays with an effect on the slice behind, or through the layer behind this slice.
    if (rays.SelectBeside(s))
    {
      rays.ForEach(BeginEffectStep{ rays.States() });
    }
    if (s > 0 && rays.EnterLayer(s - 1, this->areaWeighted))
    {
      this->Carry(rays);
    }
  }

  /// Nothing to do: rays leave the volume with the effect of the first slice.
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
    if (kept == Kept::Counted)
    {
      rays.SampleKept(this->extinction, this->base);
    }
    rays.ForEachResolved(
      fields, ResolveLit<>{ rays.States()[RayDepth::ToSlice] }, EffectStep<kept>{ rays.States() });
  }
};
}

#endif
