// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_GradientVoxel_h
#define limpid_energy_GradientVoxel_h

#include "backend/Simd.h"
#include "math/Vec.h"

namespace limpid
{
/**
 * Derivative of a visibility term at one voxel, Eq. (27) or (28) without its weight:
 *
 *   T (V - g),   V = G / T the visible importance behind per unit of transmittance.
 *
 * Deviation D1: V carries the weight t'^2 / t^2 of the widening rays, so that this is the
 * derivative of the volume integral, unless the sweep was made with Derivative::Ray.
 */
template <class Real>
struct GradientVoxel
{
  Real inverseArea; ///< 1 / scale^2 of the slice

  /// `transmittance`, `behind` [scale^2], `importance` [0, 1]: all at the voxel, the first two
  /// interpolated from rays, of which some may not have entered the box yet.
  LIMPID_HD LIMPID_INLINE Real operator()(Real transmittance, Real behind, Real importance) const
  {
    const Real passed = transmittance < Real(1) ? transmittance : Real(1);
    return passed * (behind * this->inverseArea - importance);
  }
};
}

#endif
