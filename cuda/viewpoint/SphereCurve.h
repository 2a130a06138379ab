// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Curves on the unit sphere, as points.

#ifndef limpid_viewpoint_SphereCurve_h
#define limpid_viewpoint_SphereCurve_h

#include "math/Vec.h"

#include <vector>

namespace limpid
{
/// Points at equal distances along a closed way over the sphere, from its first one on.
std::vector<Vec3> SpreadEvenly(const std::vector<Vec3>& way, int count);

/**
 * The points x on the sphere near `wanted` that turn evenly: least sum of weight |x - wanted|^2 and
 * of the squared second differences, by conjugate gradients, then moved to the sphere.
 */
std::vector<Vec3> Smoothed(
  const std::vector<Vec3>& wanted, const std::vector<double>& weights, bool closed);
}

#endif
