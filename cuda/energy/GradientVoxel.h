// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_GradientVoxel_h
#define limpid_energy_GradientVoxel_h

#include "sweep/FaceFrustum.h"

namespace limpid
{
/**
 * Derivative of a visibility term at one voxel, Eq. (27) or (28) without its weight:
 *
 *    T (V - g) = G - g T, V = G / T the visible importance behind per unit of transmittance.
 *
 * The extinction of a voxel acts on its neighbourhood: G, T and g are means over its hat function
 * (deviation D8), G and T over the rays that pass there.
 *
 * Deviation D1: V carries the weight t'^2 / t^2 of widening rays, so that this is the derivative
 * of the volume integral, unless Derivative::Ray is used.
 */
template <class Real>
struct GradientVoxel
{
  Real inverseArea; ///< 1 / scale^2 of the slice

  /// For voxels of a slice. `areaWeighted`: whether rays carry the weight of Deviation D1.
  LIMPID_HD static LIMPID_INLINE GradientVoxel On(const Slice& slice, bool areaWeighted)
  {
    const Real scale = areaWeighted ? slice.scale : Real(1);
    return { Quotient(Real(1), scale * scale) };
  }

  /// `transmittance` [0, 1], `seenBehind` G [scale^2], `importance` [0, 1].
  LIMPID_HD LIMPID_INLINE Real operator()(
    Real transmittance, Real seenBehind, Real importance) const
  {
    return seenBehind * this->inverseArea - transmittance * importance;
  }
};
}

#endif
