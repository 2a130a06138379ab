// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_PolicyVoxel_h
#define limpid_optimize_PolicyVoxel_h

#include "backend/Simd.h"
#include "optimize/ExtinctionBounds.h"
#include "optimize/Pulls.h"

namespace limpid
{
/**
 * The extinction that makes the energy stationary at one voxel, with all others fixed:
 *
 *    mu = clamp( mu-bar - (1/p) [ q T_V (V_V - g) + r T_L (V_L - g) ] )
 *
 * from Eqs. (26)-(28) with G = T V, within its bounds. Further pulls (Pulls.h) merge into the
 * regularisation: p becomes the sum of all weights, and mu-bar the mean of all references, weighted
 * by them. There are pulls to the extinction of a similar view (Documentation/Deviations.md, D20),
 * and to the last iterate (ProximalDescent).
 */
template <class Real>
struct PolicyVoxel
{
  Real gain;    ///< weight of the swept term, divided by the sum of the pulls' weights [1/length]
  Real lagGain; ///< 1 over that sum [1/length]
  Real shares[mostReferences]; ///< of pulls to other references than the base in that sum [0, 1]
  ExtinctionBounds<Real> bounds;

  /// `references`: one per share; `derivative`: T (V - g) of the swept term; `lagged`: weighted
  /// derivative of all other terms; `base` and `importance`: see ExtinctionBounds.
  LIMPID_HD LIMPID_INLINE Real operator()(Real base, const Real (&references)[mostReferences],
    Real importance, Real derivative, Real lagged) const
  {
    Real centre = base;
    for (std::size_t i = 0; i < mostReferences; ++i)
    {
      centre += this->shares[i] * (references[i] - base);
    }
    const Real wanted = centre - (this->gain * derivative + this->lagGain * lagged);
    return this->bounds.Clamp(wanted, importance, base);
  }
};
}

#endif
