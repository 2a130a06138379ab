// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_PhaseFunction_h
#define limpid_render_PhaseFunction_h

#include "math/Number.h"
#include "math/Vec.h"

#include <cmath>

namespace limpid
{
/**
 * Returns the phase function f_v of Eq. (5) [HG41]: share of the light scattered per solid angle
 * [1/steradian]. It integrates to 1 over the sphere.
 *
 * `cosine`: of the angle between the light's direction of travel and the outgoing direction.
 */
template <class Real, class Number>
LIMPID_HD LIMPID_INLINE Number HenyeyGreenstein(Real anisotropy, const Number& cosine)
{
  const Real square = anisotropy * anisotropy;
  const Number base = 1 + square - 2 * anisotropy * cosine;
  return (1 - square) / (Real(4 * pi) * base * SquareRoot(base));
}

/**
 * Returns the factor of the Blinn-Phong lobe (h.n)^p such that, times the cosine of the light, it
 * integrates to 1 over the hemisphere of lights for a viewer in the direction of the normal, and to
 * less for any other viewer [1/steradian].
 */
inline double BlinnPhongNormalization(double power)
{
  return (power + 2) * (power + 4) / (8 * pi * (std::exp2(-0.5 * power) + power));
}

/// Share of the highlight in the light that a surface scatters; the rest is diffuse.
constexpr double highlightShare = 0.25;

/**
 * Returns the surface term f_s of Eq. (5) [1/steradian]: a Lambertian surface plus the normalised
 * lobe of Blinn and Phong. `lobe`: BlinnPhongNormalization(p) (h.n)^p, zero if h.n < 0.
 */
LIMPID_HD LIMPID_INLINE double SurfaceScattering(double lobe)
{
  return (1 - highlightShare) / pi + highlightShare * lobe;
}

template <class Number>
LIMPID_HD LIMPID_INLINE Number SurfaceScattering(const Number& lobe)
{
  return float((1 - highlightShare) / pi) + float(highlightShare) * lobe;
}
}

#endif
