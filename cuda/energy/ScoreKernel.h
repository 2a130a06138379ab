// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_ScoreKernel_h
#define limpid_energy_ScoreKernel_h

#include "sweep/RaySteps.h"
#include "sweep/SliceWindow.h"

namespace limpid
{
/**
 * What a source sees, Eqs. (23), (24) and (32): the integrals along every ray of importance g
 * times extinction mu, with and without transmittance T. With `base`, also those of the kept base
 * extinction (Kept). Leaves the optical depths. `Cuts`: how layers are resolved.
 */
template <class Field, class Cuts>
struct ScoreKernel
{
  static constexpr const char* label = "forward sweep";

  Field extinction; ///< [1/length]
  Field importance; ///< [0, 1]
  Field base;       ///< [1/length]; null if kept base extinction is not counted

  template <class Windows>
  ScoreKernel<SliceWindow*, Cuts> With(Windows& windows) const
  {
    return { windows(this->extinction, FieldUse{ 1 }), windows(this->importance, FieldUse{ 1 }),
      windows(this->base, FieldUse{ 1 }) };
  }

  /// Calls visit for the values that rays carry.
  template <class Visit>
  LIMPID_HD LIMPID_INLINE void ForCarried(const Visit& visit) const
  {
    ForValues(visit, RayDepth::ToSlice, RayChannel::Visible, RayChannel::Unattenuated);
    if (this->base)
    {
      ForValues(visit, RayChannel::KeptVisible, RayChannel::KeptUnattenuated);
    }
  }

  /// Moves rays from slice `s` to the next one.
  template <class Rays>
  LIMPID_HD LIMPID_INLINE void RayStep(Rays& rays, int s) const
  {
    if (!rays.EnterLayer(s, true))
    {
      return;
    }
    rays.SampleExtinction(this->extinction);
    rays.SampleImportance(this->importance);
    const RayFields<Field> fields{ this->extinction, this->importance, this->base };
    const ResolveLit<Cuts> resolve{ rays.States()[RayDepth::ToSlice] };
    if (this->base)
    {
      rays.SampleKept(this->extinction, this->base);
      rays.ForEachResolved(fields, resolve, ScoreStep<Kept::Counted>{ rays.States() });
      return;
    }
    rays.ForEachResolved(fields, resolve, ScoreStep<Kept::Ignored>{ rays.States() });
  }
};

/// Computes the optical depths of all rays, Eqs. (15) and (16).
template <class Field>
struct DepthKernel
{
  static constexpr const char* label = "optical depths";

  Field extinction; ///< [1/length]

  template <class Windows>
  DepthKernel<SliceWindow*> With(Windows& windows) const
  {
    return { windows(this->extinction, FieldUse{ 1 }) };
  }

  /// Calls visit for the values that rays carry.
  template <class Visit>
  LIMPID_HD LIMPID_INLINE void ForCarried(const Visit& visit) const
  {
    visit(RayDepth::ToSlice);
  }

  template <class Rays>
  LIMPID_HD LIMPID_INLINE void RayStep(Rays& rays, int s) const
  {
    if (rays.EnterLayer(s, true))
    {
      rays.SampleExtinction(this->extinction);
      rays.ForEachInLayer(DeepenStep{ rays.States() });
    }
  }
};
}

#endif
