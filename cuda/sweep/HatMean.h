// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_HatMean_h
#define limpid_sweep_HatMean_h

#include "backend/Simd.h"
#include "math/Number.h"
#include "math/Vec.h"

namespace limpid
{
/// Weight of the only neighbour of a node on the border, where the hat function is one-sided. It
/// makes the mean of a linear function exact.
constexpr float sideWeightOnBorder = 1.0f / 3;

/**
 * The mean of f over the hat function of node k along one axis, from f at the node and its two
 * neighbours:
 *
 *    mean = f(k) + side (f(k-1) - 2 f(k) + f(k+1)).
 *
 * For a parabola the mean is f + f''/12. Linear interpolation between rays that are `gap` nodes
 * apart already adds the error t (1 - t) gap^2 f''/2 at the fraction t of the gap. Therefore
 *
 *    side = 1/12 - t (1 - t) gap^2 / 2
 *
 * is exact for any position of the rays. If the rays are too far apart, it would be negative and
 * is set to 0.
 */
LIMPID_HD LIMPID_INLINE float SideWeight(float share, float gap)
{
  return AtLeast(1.0f / 12 - 0.5f * share * (1.0f - share) * gap * gap, 0.0f);
}

LIMPID_HD LIMPID_INLINE float HatMean(float before, float own, float behind, float side)
{
  return own + side * ((before - own) + (behind - own));
}

/// Scales visible importance `seen`, computed with `transmittance`, to the transmittance `other`.
LIMPID_HD LIMPID_INLINE float Exchanged(float seen, float transmittance, float other)
{
  constexpr float least = 1e-30f; // below it no light passes
  return transmittance > least ? seen * (other / transmittance) : 0.0f;
}
}

#endif
