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
/// What a policy sweep takes for the transmittance.
enum class Transmittance
{
  AssumeOne,    ///< nothing is in the way
  OfLastIterate ///< that of the last iterate, whose optical depths are with the rays
};

/// The next iterate at a voxel that reads rays.
struct PolicyStep
{
  PolicyVoxel<float> policy;
  GradientVoxel<float> derivative;
  const float* transmittance; ///< mean of the rays [0, 1]
  const float* behind;        ///< mean of what it leaves of the importance behind [scale^2]
  const float* inView;        ///< importance of the node, as far as it is in view [0, 1]
  const float* importance;    ///< [0, 1]; null: nothing is protected
  const float* base;          ///< [1/length]
  const float* last;          ///< the last iterate, or the base where it does not matter [1/length]
  const float* previous;      ///< what to stay near, likewise [1/length]
  const float* lagged;        ///< derivative of the other terms, with weights; null: none
  float* next;                ///< out [1/length]

  LIMPID_HD LIMPID_INLINE void operator()(Index u) const
  {
    this->next[u] = this->policy(this->base[u], this->last[u], this->previous[u],
      this->importance ? this->importance[u] : 0.0f,
      this->derivative(this->transmittance[u], this->behind[u], this->inView[u]),
      this->lagged ? this->lagged[u] : 0.0f);
  }
};

/// The next iterate at a voxel that no important structure of the swept term needs: only the other
/// terms count.
struct IdleStep
{
  PolicyVoxel<float> policy;
  const float* importance; ///< [0, 1]; null: nothing is protected
  const float* base;       ///< [1/length]
  const float* last;       ///< see PolicyStep
  const float* previous;   ///< see PolicyStep
  const float* lagged;     ///< null: none
  float* next;             ///< out [1/length]

  LIMPID_HD LIMPID_INLINE void operator()(Index u) const
  {
    this->next[u] = this->policy(this->base[u], this->last[u], this->previous[u],
      this->importance ? this->importance[u] : 0.0f, 0.0f, this->lagged ? this->lagged[u] : 0.0f);
  }
};

/**
 * A policy sweep of one term (Documentation/Method.md, section on policy sweeps): back to front,
 * visible importance is carried through the *next* iterate, whose voxels are found slice by slice
 * from it. Transmittance is that of the last iterate, whose optical depths unwind.
 *
 * The sweep collects the optical depths of what its rays meet, and their visible importance is the
 * score of that: of the next iterate, where its voxels were all found before (MetNextIterate). Not
 * so where iterates are weighed: there rays carry what is better, the next iterate or another.
 */
template <class Input, class Output>
struct PolicyKernel
{
  static constexpr const char* label = "policy sweep";
  static constexpr auto seenBehind = &RayStates::ahead; ///< what voxels read

  Input base;           ///< [1/length]
  Input importance;     ///< [0, 1]
  Input nodeImportance; ///< see NodeImportance.h [0, 1]
  Input last;           ///< the last iterate [1/length]
  Input previous;       ///< what iterates are to stay near [1/length]; null: nothing
  Input lagged;         ///< derivative of the other terms, with weights; null: none
  Output next;          ///< the next iterate [1/length]
  Input alternative;    ///< what the next iterate is weighed against, see WeighStep; null: nothing
  PolicyVoxel<float> policy;
  Transmittance transmittance;
  bool areaWeighted;   ///< whether rays carry the weight of Deviation D1
  Kept kept;           ///< of the base; nothing is counted where iterates are weighed
  float priceOfSquare; ///< see WeighStep [length]

  template <class Windows>
  PolicyKernel<SliceWindow*, SliceWindow*> With(Windows& windows) const
  {
    const FieldUse useOfBase{ this->kept == Kept::Counted ? 2 : 0 };
    return { windows(this->base, useOfBase), windows(this->importance, FieldUse{ 2 }),
      windows(this->nodeImportance, FieldUse{ 0 }), windows(this->last, FieldUse{ 1 }),
      windows(this->previous, FieldUse{ 0 }), windows(this->lagged, FieldUse{ 0 }),
      windows(this->next, FieldUse{ 2, true }), windows(this->alternative, FieldUse{ 2 }),
      this->policy, this->transmittance, this->areaWeighted, this->kept, this->priceOfSquare };
  }

  /// What its rays carry.
  std::vector<RayValues> Carried(const RayStates& rays) const
  {
    std::vector<RayValues> carried{ rays.opticalDepth, rays.collected, rays.behind, rays.visible,
      rays.unattenuated, rays.transmittance, rays.density, rays.ahead, rays.rearImportance };
    if (this->kept == Kept::Counted)
    {
      carried.insert(carried.end(), { rays.keptBehind, rays.keptVisible, rays.keptUnattenuated });
    }
    if (this->alternative)
    {
      carried.insert(carried.end(), { rays.alternativeBehind, rays.cost, rays.reach });
    }
    return carried;
  }

  /// Copies what a ray carries; rear importance has to be there from the start.
  LIMPID_HD LIMPID_INLINE void CopyCarried(const RayStates& from, const RayStates& to) const
  {
    if (this->transmittance == Transmittance::OfLastIterate)
    {
      *to.opticalDepth = *from.opticalDepth;
    }
    *to.collected = *from.collected;
    *to.behind = *from.behind;
    *to.visible = *from.visible;
    *to.unattenuated = *from.unattenuated;
    *to.transmittance = *from.transmittance;
    *to.density = *from.density;
    *to.ahead = *from.ahead;
    *to.rearImportance = *from.rearImportance;
    if (this->kept == Kept::Counted)
    {
      *to.keptBehind = *from.keptBehind;
      *to.keptVisible = *from.keptVisible;
      *to.keptUnattenuated = *from.keptUnattenuated;
    }
    if (this->alternative)
    {
      *to.alternativeBehind = *from.alternativeBehind;
      *to.cost = *from.cost;
      *to.reach = *from.reach;
    }
  }

  /// To slice `s`, whose voxels are to be found next. The voxels behind are final.
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

  /// From the first slice of voxels out of the volume.
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

  /// Brings what will be read of the slices in front.
  template <class Voxels>
  LIMPID_HD LIMPID_INLINE void PrefetchInFront(const Voxels& voxels) const
  {
    voxels.PrefetchInFront({ this->base, this->importance, this->nodeImportance, this->last,
      this->previous, this->lagged, this->alternative });
  }

  /// A VoxelStep of the voxels that no ray matters to.
  template <class Voxels>
  LIMPID_HD LIMPID_INLINE void IdleVoxelStep(const Voxels& voxels) const
  {
    const FieldsHere here = this->FieldsOf(voxels);
    voxels.ForIdle(IdleStep{ this->policy, here.protects, here.bases, here.lasts, here.before,
      here.lags, voxels.Row(this->next) });
  }

  /// A VoxelStep of the others.
  template <class Voxels>
  LIMPID_HD LIMPID_INLINE void ActiveVoxelStep(
    Voxels& voxels, const typename Voxels::Rays& rays) const
  {
    if (voxels.FindSeen(rays))
    {
      const FieldsHere here = this->FieldsOf(voxels);
      const auto seen = voxels.SeenHere();
      voxels.ForActive(
        PolicyStep{ this->policy, GradientVoxel<float>::On(voxels.SliceHere(), this->areaWeighted),
          seen.transmittance, seen.behind, voxels.ImportanceInView(this->nodeImportance),
          here.protects, here.bases, here.lasts, here.before, here.lags, voxels.Row(this->next) });
    }
  }

private:
  /// What the steps of voxels read, see PolicyStep.
  struct FieldsHere
  {
    const float* protects;
    const float* bases;
    const float* lasts;
    const float* before;
    const float* lags;
  };

  template <class Voxels>
  LIMPID_HD LIMPID_INLINE FieldsHere FieldsOf(const Voxels& voxels) const
  {
    const float* bases = voxels.Row(this->base);
    return { this->policy.bounds.protect > 0 ? voxels.Row(this->importance) : nullptr, bases,
      this->policy.inertia > 0 ? voxels.Row(this->last) : bases,
      this->previous ? voxels.Row(this->previous) : bases,
      this->lagged ? voxels.Row(this->lagged) : nullptr };
  }

  /// Through the layer behind slice `s`, whose voxels are final.
  template <class Rays>
  LIMPID_HD LIMPID_INLINE void Carry(Rays& rays, int s) const
  {
    if (!rays.EnterLayer(s, this->areaWeighted))
    {
      return;
    }
    rays.SampleExtinction(this->next);
    if (s < rays.Plan().firstNodeSlice)
    {
      rays.SampleRearImportance(this->importance);
    }
    else
    {
      rays.RecallRearImportance(); // LookAhead has sampled it
    }
    rays.SampleFrontImportance(this->importance);
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

  /// To the middle of the layer. Its rear half is taken to be as opaque as the slice behind it, as
  /// the slice in front is not known yet.
  template <class Rays>
  LIMPID_HD LIMPID_INLINE void LookAhead(Rays& rays) const
  {
    rays.SampleExtinctionBehind(this->next);
    rays.SampleRearImportance(this->importance);
    rays.ForEachInLayer(LookAheadStep{ rays.States() });
  }

  /// Transmittance through the last iterate. `layer`: whether there is one behind the slice.
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
