// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_PolicySweep_h
#define limpid_optimize_PolicySweep_h

#include "optimize/PolicyKernel.h"
#include "optimize/Terms.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace limpid
{
/// The least weight of all pulls in a policy [length]. The optimum without any is bang-bang; a
/// large but finite gain gives the same result.
constexpr double leastPull = 1e-30;

/// Returns the weight of the regularisation in a policy.
inline double RegularizationOf(const Problem& problem)
{
  return std::max(problem.RegularizationWeight(), leastPull);
}

/// How far rays reach at the start of a sweep that weighs costs.
enum class Reach
{
  Unlimited,  ///< through the whole volume
  OfLastSweep ///< as far as was worthwhile in the last such sweep
};

/// The policy sweep of one term, which computes the next iterate from the last one. All pointers
/// refer to the device.
struct PolicySweep
{
  const float* last;       ///< the last iterate [1/length]
  const float* lagged;     ///< weighted derivative of the other terms; null if none
  float* next;             ///< the next iterate [1/length]
  double weight;           ///< weight of the term
  std::vector<Pull> pulls; ///< those of the energy first, then those that only shape the step
  Transmittance transmittance;
  Kept kept;                          ///< whether kept base extinction is counted
  const float* alternative = nullptr; ///< see WeighStep [1/length]; null if nothing is weighed
  Reach reach = Reach::Unlimited;     ///< initial reach of the rays, if weighing
  bool emphasises = true; ///< whether extinction may rise above the base, within its bounds
  bool tellsAfter = true; ///< whether score and optical depths of the next iterate are needed
};

/// Sweeps all frusta of a term. Afterwards the rays hold the visible importance and the optical
/// depths of the next iterate, if they are needed. `moved`: on the processor, the distances of the
/// next iterate are added to it.
template <class AnyDevice>
void SweepPolicy(AnyDevice& device, EnergyTerm<AnyDevice>& term, const Terms<AnyDevice>& terms,
  const Problem& problem, const PolicySweep& sweep, ExactDifferences& moved);

/// Performs the first policy sweep of one term, without transmittance and without other terms.
/// Leaves no values with the rays. `pulls`: see PolicySweep.
template <class AnyDevice>
void SweepFirstPolicy(AnyDevice& device, VisibilityTerm<AnyDevice>& term, const Problem& problem,
  const ProblemFields<AnyDevice>& fields, const std::vector<Pull>& pulls, double weight,
  float* next);

/// Whether the rays of a frustum have met only the next iterate in their policy sweep, so that its
/// score and optical depths are known. Only the last frustum qualifies: rays of others also meet
/// voxels of frusta swept later. With Derivative::Ray, rays do not carry the score.
inline bool MetNextIterate(std::size_t frustum, std::size_t frusta, Derivative derivative)
{
  return frustum + 1 == frusta && derivative == Derivative::Volume;
}
}

#endif
