// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_viewpoint_ViewDerivativeSweep_h
#define limpid_viewpoint_ViewDerivativeSweep_h

#include "sweep/SumRays.h"
#include "viewpoint/ViewFields.h"

namespace limpid
{
/// The score of a family of rays and how it changes when their eye moves.
struct ViewDerivative
{
  Visible score;
  double slope[2] = { 0, 0 }; ///< by either move [length]
};

/**
 * Front to back over all slices, following two moves of the eye across the way of length `distance`
 * to the focal point [length] (ViewDerivativeRow.h). `rayDensity`: that of the part's plan. Layers
 * are cut into as many parts, at least one.
 */
ViewDerivative SweepViewDerivative(
  const ViewFields::Part& part, const Vec3 moves[2], double distance, double rayDensity);
}

#endif
