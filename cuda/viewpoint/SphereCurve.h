// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Curves on the unit sphere, given as points.

#ifndef limpid_viewpoint_SphereCurve_h
#define limpid_viewpoint_SphereCurve_h

#include "math/Vec.h"

#include <vector>

namespace limpid
{
/// Returns `count` points at equal distances along a closed path on the sphere, starting at its
/// first point.
std::vector<Vec3> SpreadEvenly(const std::vector<Vec3>& way, int count);

/**
 * Smooths a curve on the sphere: minimises the sum of weight |x - wanted|^2 and of the squared
 * second differences by conjugate gradients, then projects the points to the sphere.
 */
std::vector<Vec3> Smoothed(
  const std::vector<Vec3>& wanted, const std::vector<double>& weights, bool closed);
}

#endif
