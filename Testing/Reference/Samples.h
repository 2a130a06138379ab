// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What a line of sight meets at the middles of many equal steps, and what that adds up to.

#ifndef limpid_testing_Samples_h
#define limpid_testing_Samples_h

#include <array>
#include <vector>

namespace truth
{
struct Sample
{
  double scalar = 0;
  double slope = 0;              ///< of the extinction over the scalar, without sign
  double extinction = 0;         ///< mu [1/length]
  std::array<double, 3> color{}; ///< c times l
};

/// Colours times alpha, and alpha, of the emission-absorption integral, not clamped.
std::array<double, 4> Compose(const std::vector<Sample>& samples, double step);

/**
 * By how much a rule of second order may be off in any channel, over the square of its sample
 * distance and to leading order.
 *
 * A rule that takes extinction mu and colour c as constant or linear between samples h apart, with
 * an exponential per segment, errs by at most h^2/8 of the total variation of the derivative of
 * what it takes as linear (Peano), whatever the kinks are. So
 *
 *   optical depth in front of t: |d tau| <= h^2/8 ( TV[mu'] + TV of the scalar's slope, in mu )
 *   radiance: h^2/8 int T ( c dTV[mu'] + mu dTV[c'] + 2 |mu'| |c'| dt ) from mu and c,
 *             int T mu c |d tau| dt from the transmittance, and
 *             h^2/4 int T mu ( |mu'| c + mu |c'| ) dt from attenuation within a segment.
 *
 * All terms are added without regard to their signs.
 */
double SecondOrderBound(const std::vector<Sample>& samples, double step);
}

#endif
