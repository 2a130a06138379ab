// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_PolicyVoxel_h
#define limpid_optimize_PolicyVoxel_h

#include "backend/Simd.h"
#include "math/Vec.h"

namespace limpid
{
/**
 * The extinction that makes the energy stationary at one voxel, all else being fixed:
 *
 *   mu = clamp( mu-bar - (1/p) [ q T_V (V_V - g) + r T_L (V_L - g) ], 0, majorant )
 *
 * from Eqs. (26)-(28) with G = T V and the constraint of Eq. (25).
 */
template <class Real>
struct PolicyVoxel
{
  Real gain;     ///< weight of the term that is swept over p [1/length]
  Real lagGain;  ///< 1 over p [1/length]
  Real majorant; ///< [1/length]

  /// `derivative`: T (V - g) of the term that is swept; `lagged`: the derivative of all others,
  /// with their weights.
  LIMPID_HD LIMPID_INLINE Real operator()(Real base, Real derivative, Real lagged) const
  {
    const Real wanted = base - (this->gain * derivative + this->lagGain * lagged);
    const Real atLeast = wanted > Real(0) ? wanted : Real(0);
    return atLeast < this->majorant ? atLeast : this->majorant;
  }
};
}

#endif
