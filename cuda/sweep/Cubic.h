// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Cubic interpolation between rays (Catmull-Rom), shared by all backends.

#ifndef limpid_sweep_Cubic_h
#define limpid_sweep_Cubic_h

#include "backend/Simd.h"
#include "math/Vec.h"

namespace limpid
{
/// Upper limit of optical depths that are interpolated by cubics: beyond it T is below 1e-5.
constexpr float mostDepthBetweenRays = 12;

/// Evaluates the cubic through samples at -1, 0, 1, 2 at the position `share` in [0, 1].
LIMPID_HD LIMPID_INLINE float CubicBetween(
  float before, float first, float second, float after, float share)
{
  // Linear interpolation minus the curvature at both ends: exact for constant samples.
  const float slope = second - first;
  const float atFirst = (before - first) + slope;
  const float atSecond = (after - second) - slope;
  return first + share * slope -
    0.5f * share * (1 - share) * (atFirst + share * (atSecond - atFirst));
}

/// Returns the second difference of three neighbouring samples.
LIMPID_HD LIMPID_INLINE float Curvature(float before, float here, float after)
{
  return (before - here) + (after - here);
}

/// Turns a linear interpolation into a cubic one. `curvature`: Curvature, interpolated likewise.
LIMPID_HD LIMPID_INLINE float Bent(float linear, float curvature, float share)
{
  return linear - 0.5f * share * (1 - share) * curvature;
}
}

#endif
