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
 * Phase function f_v of Eq. (5) [HG41]: share of the light scattered per solid angle [1/steradian].
 * Integrates to 1 over the sphere.
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
 * Factor of the Blinn-Phong lobe (h.n)^p with which it, times the cosine of the light, integrates
 * to 1 over the hemisphere of lights for a viewer in the direction of the normal, and to less for
 * any other [1/steradian].
 */
inline double BlinnPhongNormalization(double power)
{
  return (power + 2) * (power + 4) / (8 * pi * (std::exp2(-0.5 * power) + power));
}

/// Share of the highlight in what a surface scatters; the rest is matt.
constexpr double highlightShare = 0.25;

/**
 * Surface term f_s of Eq. (5) [1/steradian]: the matt surface of Lambert and the normalised lobe of
 * Blinn and Phong. `lobe`: BlinnPhongNormalization(p) (h.n)^p, zero if h.n < 0.
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
