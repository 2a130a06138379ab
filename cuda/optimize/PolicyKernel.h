// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_PolicyKernel_h
#define limpid_optimize_PolicyKernel_h

#include "energy/GradientVoxel.h"
#include "optimize/PolicyVoxel.h"
#include "sweep/RaySteps.h"
#include "sweep/SliceWindow.h"

namespace limpid
{
/// The transmittance that a policy sweep uses.
enum class Transmittance
{
  AssumeOne,    ///< nothing attenuates
  OfLastIterate ///< from the last iterate, whose optical depths the rays hold
};

/// Computes the next iterate at a voxel that the swept term does not depend on. Only the other
/// terms count.
struct IdleStep
{
  PolicyVoxel<float> policy;
  const float* importance;                 ///< [0, 1]; the base if nothing is protected
  const float* base;                       ///< [1/length]
  const float* references[mostReferences]; ///< see Pull; the base where there is none [1/length]
  const float* lagged; ///< weighted derivative of the other terms; the base if there are none
  float* next;         ///< out [1/length]

  LIMPID_HD LIMPID_INLINE void operator()(Index u) const { this->Write(u, 0.0f); }

  /// `derivative`: that of the swept term.
  LIMPID_HD LIMPID_INLINE void Write(Index u, float derivative) const
  {
    float towards[mostReferences];
    for (std::size_t i = 0; i < mostReferences; ++i)
    {
      towards[i] = this->references[i][u];
    }
    this->next[u] =
      this->policy(this->base[u], towards, this->importance[u], derivative, this->lagged[u]);
  }
};

/// Computes the next iterate at a voxel that reads rays.
struct PolicyStep
{
  IdleStep voxel;
  GradientVoxel<float> derivative;
  const float* transmittance; ///< mean of the rays [0, 1]
  const float* behind;        ///< mean visible importance behind, attenuated [scale^2]
  const float* inView;        ///< importance of the node inside the view [0, 1]

  LIMPID_HD LIMPID_INLINE void operator()(Index u) const
  {
    this->voxel.Write(
      u, this->derivative(this->transmittance[u], this->behind[u], this->inView[u]));
  }
};

/**
 * A policy sweep of one term (Documentation/Method.md, section on policy sweeps). Back to front,
 * visible importance is carried through the *next* iterate, which is computed slice by slice from
 * it. Transmittance is that of the last iterate, whose optical depths are unwound.
 *
 * The sweep collects optical depths and visible importance along its rays. These are the values of
 * the next iterate if all its voxels were known when rays passed them (MetNextIterate). If
 * iterates are weighed, rays instead carry the better of the next iterate and the alternative.
 */
template <class Input, class Output>
struct PolicyKernel
{
  static constexpr const char* label = "policy sweep";
  static constexpr RayChannel readByVoxels = RayChannel::Ahead; ///< see ForRead

  Input base;                       ///< [1/length]
  Input importance;                 ///< [0, 1]
  Input nodeImportance;             ///< see NodeImportance.h [0, 1]
  Input last;                       ///< the last iterate [1/length]
  Input references[mostReferences]; ///< see PullsOfKernel [1/length]
  Input lagged;                     ///< weighted derivative of the other terms; null if none
  Output next;                      ///< the next iterate [1/length]
  Input alternative; ///< alternative to the next iterate, see WeighStep; null if none
  PolicyVoxel<float> policy;
  Transmittance transmittance;
  bool areaWeighted;   ///< whether rays carry the weight of Deviation D1
  Kept kept;           ///< whether kept base extinction is counted; not while weighing
  float priceOfSquare; ///< see WeighStep [length]

  template <class Windows>
  PolicyKernel<SliceWindow*, SliceWindow*> With(Windows& windows) const
  {
    PolicyKernel<SliceWindow*, SliceWindow*> there;
    there.base = windows(this->base, FieldUse{ this->kept == Kept::Counted ? 2 : 0 });
    there.importance = windows(this->importance, FieldUse{ 2 });
    there.nodeImportance = windows(this->nodeImportance, FieldUse{ 0 });
    there.last = windows(this->last, FieldUse{ 1 });
    for (std::size_t i = 0; i < mostReferences; ++i)
    {
      const Input reference = this->references[i];
      there.references[i] =
        reference == this->last ? there.last : windows(reference, FieldUse{ 0 });
    }
    there.lagged = windows(this->lagged, FieldUse{ 0 });
    there.next = windows(this->next, FieldUse{ 2, true });
    there.alternative = windows(this->alternative, FieldUse{ 2 });
    there.policy = this->policy;
    there.transmittance = this->transmittance;
    there.areaWeighted = this->areaWeighted;
    there.kept = this->kept;
    there.priceOfSquare = this->priceOfSquare;
    return there;
  }

  /// Calls visit for the values that rays carry.
  template <class Visit>
  LIMPID_HD LIMPID_INLINE void ForCarried(const Visit& visit) const
  {
    ForValues(visit, RayDepth::Collected, RayChannel::Behind, RayChannel::Visible,
      RayChannel::Unattenuated, RayChannel::Transmittance, RayChannel::Density, RayChannel::Ahead,
      RayChannel::RearImportance);
    if (this->transmittance == Transmittance::OfLastIterate)
    {
      visit(RayDepth::ToSlice);
    }
    if (this->kept == Kept::Counted)
    {
      ForKept(visit);
    }
    if (this->alternative)
    {
      ForValues(visit, RayChannel::AlternativeBehind, RayChannel::Cost, RayChannel::Reach);
    }
  }

  /// Moves rays to slice `s`, whose voxels are computed next. The voxels behind are final.
  template <class Rays>
  LIMPID_HD LIMPID_INLINE void RayStep(Rays& rays, int s) const
  {
    const int lastSlice = rays.Plan().lastSlice;
    if (s + 1 < lastSlice)
    {
      this->Carry(rays, s + 1);
    }
    if (!rays.EnterLayer(s, this->areaWeighted))
    {
      return;
    }
    if (s < lastSlice)
    {
      this->LookAhead(rays);
    }
    if (this->transmittance == Transmittance::OfLastIterate)
    {
      this->Transmit(rays, s < lastSlice);
      if (this->alternative)
      {
        rays.ForEach(ReachStep{ rays.States(), static_cast<float>(s) });
      }
    }
  }

  /// Moves rays from the first slice of voxels out of the volume.
  template <class Rays>
  LIMPID_HD LIMPID_INLINE void LeaveStep(Rays& rays) const
  {
    const int first = rays.Plan().firstNodeSlice;
    const int lastLayer = rays.Plan().lastSlice - 1;
    for (int s = first < lastLayer ? first : lastLayer; s >= 0; --s)
    {
      this->Carry(rays, s);
    }
  }

  template <class Voxels>
  LIMPID_HD LIMPID_INLINE void VoxelStep(Voxels& voxels, const typename Voxels::Rays& rays) const
  {
    voxels.Prefetch(this->base);
    voxels.Prefetch(this->nodeImportance);
    voxels.Prefetch(this->next);
    voxels.Prefetch(this->lagged);
    this->IdleVoxelStep(voxels);
    this->ActiveVoxelStep(voxels, rays);
  }

  /// Prefetches values of the slices in front.
  template <class Voxels>
  LIMPID_HD LIMPID_INLINE void PrefetchInFront(const Voxels& voxels) const
  {
    voxels.PrefetchInFront({ this->base, this->importance, this->nodeImportance, this->last,
      this->lagged, this->alternative });
    voxels.PrefetchInFront(this->references);
  }

  /// VoxelStep for the voxels that no active ray reaches.
  template <class Voxels>
  LIMPID_HD LIMPID_INLINE void IdleVoxelStep(const Voxels& voxels) const
  {
    voxels.ForIdle(this->StepAt(voxels));
  }

  /// VoxelStep for all other voxels.
  template <class Voxels>
  LIMPID_HD LIMPID_INLINE void ActiveVoxelStep(
    Voxels& voxels, const typename Voxels::Rays& rays) const
  {
    if (voxels.FindSeen(rays))
    {
      const auto seen = voxels.SeenHere();
      voxels.ForActive(PolicyStep{ this->StepAt(voxels),
        GradientVoxel<float>::On(voxels.SliceHere(), this->areaWeighted), seen.transmittance,
        seen.behind, voxels.ImportanceInView(this->nodeImportance) });
    }
  }

private:
  /// Fields that the policy does not need get the factor 0 and are replaced by the base: vector
  /// registers read a null address element by element, even where none is selected.
  template <class Voxels>
  LIMPID_HD LIMPID_INLINE IdleStep StepAt(const Voxels& voxels) const
  {
    IdleStep step;
    step.policy = this->policy;
    step.base = voxels.Row(this->base);
    step.importance = this->policy.bounds.protect > 0 ? voxels.Row(this->importance) : step.base;
    for (std::size_t i = 0; i < mostReferences; ++i)
    {
      step.references[i] = this->references[i] ? voxels.Row(this->references[i]) : step.base;
    }
    step.lagged = this->lagged ? voxels.Row(this->lagged) : step.base;
    step.policy.lagGain = this->lagged ? this->policy.lagGain : 0.0f;
    step.next = voxels.Row(this->next);
    return step;
  }

  /// Carries rays through the layer behind slice `s`, whose voxels are final.
  template <class Rays>
  LIMPID_HD LIMPID_INLINE void Carry(Rays& rays, int s) const
  {
    if (!rays.EnterLayer(s, this->areaWeighted))
    {
      return;
    }
    if (s < rays.Plan().firstNodeSlice)
    {
      rays.SampleRearImportance(this->importance);
    }
    else
    {
      rays.RecallRearImportance(); // LookAhead has sampled it
    }
    rays.SampleFrontImportance(this->importance);
    rays.SampleExtinction(this->next); // beside SampleKept, which reads the same values
    if (this->alternative)
    {
      rays.SampleAlternative(this->alternative);
      rays.ForEachInLayer(WeighStep{ rays.States(), this->priceOfSquare, static_cast<float>(s) });
      return;
    }
    RayFields<typename Rays::Field> fields{ this->next, this->importance, nullptr };
    if (this->kept == Kept::Ignored)
    {
      rays.ForEachResolved(
        fields, ResolveSides{}, CarryAndCollectStep<Kept::Ignored>{ rays.States() });
      return;
    }
    fields.base = this->base;
    rays.SampleKept(this->next, this->base);
    rays.ForEachResolved(
      fields, ResolveSides{}, CarryAndCollectStep<Kept::Counted>{ rays.States() });
  }

  /// Carries rays to the middle of the layer. The rear half uses the extinction of the slice
  /// behind, as the slice in front is not known yet.
  template <class Rays>
  LIMPID_HD LIMPID_INLINE void LookAhead(Rays& rays) const
  {
    rays.SampleExtinctionBehind(this->next);
    rays.SampleRearImportance(this->importance);
    rays.ForEachInLayer(LookAheadStep{ rays.States() });
  }

  /// Computes transmittance through the last iterate. `layer`: whether there is a layer behind the
  /// slice.
  template <class Rays>
  LIMPID_HD LIMPID_INLINE void Transmit(Rays& rays, bool layer) const
  {
    if (layer)
    {
      rays.SampleExtinction(this->last);
      rays.ForEachRegardless(UnwindStep{ rays.States() });
    }
    else
    {
      rays.SampleNothing();
    }
    constexpr float unlimited = 1e30f;
    rays.ForEach(TransmitStep{ rays.States() });
    rays.ForEachNearSides(DensityStep{ rays.States(), rays.Plan().frontDepth, true, unlimited });
  }
};
}

#endif
