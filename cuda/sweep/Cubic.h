// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Cubic interpolation between rays (Catmull-Rom), the same for all backends.

#ifndef limpid_sweep_Cubic_h
#define limpid_sweep_Cubic_h

#include "backend/Simd.h"
#include "math/Vec.h"

namespace limpid
{
/// Limit to the optical depths that cubics interpolate between: T is below 1e-5 behind.
constexpr float mostDepthBetweenRays = 12;

/// The cubic through samples at -1, 0, 1, 2, between the second and the third; `share`: of the way.
LIMPID_HD LIMPID_INLINE float CubicBetween(
  float before, float first, float second, float after, float share)
{
  // The straight line less what it curves at its ends: exact where nothing changes.
  const float slope = second - first;
  const float atFirst = (before - first) + slope;
  const float atSecond = (after - second) - slope;
  return first + share * slope -
    0.5f * share * (1 - share) * (atFirst + share * (atSecond - atFirst));
}

/// Second difference.
LIMPID_HD LIMPID_INLINE float Curvature(float before, float here, float after)
{
  return (before - here) + (after - here);
}

/// Makes a linear interpolation cubic. `curvature`: the same interpolation of Curvature.
LIMPID_HD LIMPID_INLINE float Bent(float linear, float curvature, float share)
{
  return linear - 0.5f * share * (1 - share) * curvature;
}
}

#endif
