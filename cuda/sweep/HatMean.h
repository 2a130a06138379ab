// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_HatMean_h
#define limpid_sweep_HatMean_h

#include "backend/Simd.h"
#include "math/Number.h"
#include "math/Vec.h"

namespace limpid
{
/// Weight of the neighbour of a node on the border, where the hat function has one side: the mean
/// over it of a function that is linear.
constexpr float sideWeightOnBorder = 1.0f / 3;

/**
 * The mean of f over the hat function of node k along one axis, from f at the node and beside it:
 *
 *   mean = f(k) + side (f(k-1) - 2 f(k) + f(k+1)).
 *
 * For a parabola the mean is f + f''/12. Linear interpolation between rays that are `gap` nodes
 * apart is off by t (1 - t) gap^2 f''/2 at the share t of the gap already, so that
 *
 *   side = 1/12 - t (1 - t) gap^2 / 2
 *
 * is exact, wherever the rays lie. Rays too far apart for that average more than the hat does: 0.
 */
LIMPID_HD LIMPID_INLINE float SideWeight(float share, float gap)
{
  return AtLeast(1.0f / 12 - 0.5f * share * (1.0f - share) * gap * gap, 0.0f);
}

LIMPID_HD LIMPID_INLINE float HatMean(float before, float own, float behind, float side)
{
  return own + side * ((before - own) + (behind - own));
}

/// What another transmittance leaves of the importance behind that `transmittance` leaves `seen`
/// of.
LIMPID_HD LIMPID_INLINE float Exchanged(float seen, float transmittance, float other)
{
  constexpr float least = 1e-30f; // nothing passes
  return transmittance > least ? seen * (other / transmittance) : 0.0f;
}
}

#endif
