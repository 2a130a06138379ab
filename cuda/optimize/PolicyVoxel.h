// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_PolicyVoxel_h
#define limpid_optimize_PolicyVoxel_h

#include "backend/Simd.h"
#include "optimize/ExtinctionBounds.h"

namespace limpid
{
/**
 * The extinction that makes the energy stationary at one voxel, with all others fixed:
 *
 *    mu = clamp( mu-bar - (1/p) [ q T_V (V_V - g) + r T_L (V_L - g) ] )
 *
 * from Eqs. (26)-(28) with G = T V, within its bounds. A proximal step (ProximalDescent) adds s/2
 * (mu - mu_last)^2 to the energy. The pull to a reference extinction adds t/2 (mu - mu_previous)^2
 * (Documentation/Deviations.md, D20). Both merge into the regularisation: p becomes p + s + t and
 * mu-bar becomes (p mu-bar + s mu_last + t mu_previous) / (p + s + t).
 */
template <class Real>
struct PolicyVoxel
{
  Real gain;      ///< weight of the swept term, divided by p + s + t [1/length]
  Real lagGain;   ///< 1 / (p + s + t) [1/length]
  Real inertia;   ///< s / (p + s + t) [0, 1]
  Real coherence; ///< t / (p + s + t) [0, 1]
  ExtinctionBounds<Real> bounds;

  /// `last`: last iterate; `previous`: reference extinction; `derivative`: T (V - g) of the swept
  /// term; `lagged`: weighted derivative of all other terms; `base` and `importance`: see
  /// ExtinctionBounds.
  LIMPID_HD LIMPID_INLINE Real operator()(
    Real base, Real last, Real previous, Real importance, Real derivative, Real lagged) const
  {
    const Real centre = base + this->coherence * (previous - base) + this->inertia * (last - base);
    const Real wanted = centre - (this->gain * derivative + this->lagGain * lagged);
    return this->bounds.Clamp(wanted, importance, base);
  }
};
}

#endif
