// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_PolicyVoxel_h
#define limpid_optimize_PolicyVoxel_h

#include "backend/Simd.h"
#include "optimize/ExtinctionBounds.h"

namespace limpid
{
/**
 * The extinction that makes the energy stationary at one voxel, all else being fixed:
 *
 *   mu = clamp( mu-bar - (1/p) [ q T_V (V_V - g) + r T_L (V_L - g) ] )
 *
 * from Eqs. (26)-(28) with G = T V, within its bounds.
 */
template <class Real>
struct PolicyVoxel
{
  Real gain;    ///< weight of the term that is swept over p [1/length]
  Real lagGain; ///< 1 over p [1/length]
  ExtinctionBounds<Real> bounds;

  /// `derivative`: T (V - g) of the term that is swept; `lagged`: the derivative of all others,
  /// with their weights; `base` and `importance`: see ExtinctionBounds.
  LIMPID_HD LIMPID_INLINE Real operator()(
    Real base, Real importance, Real derivative, Real lagged) const
  {
    const Real wanted = base - (this->gain * derivative + this->lagGain * lagged);
    return this->bounds.Clamp(wanted, importance, base);
  }
};
}

#endif
