// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_PolicySweep_h
#define limpid_optimize_PolicySweep_h

#include "optimize/PolicyKernel.h"
#include "optimize/Terms.h"

#include <algorithm>
#include <cstddef>

namespace limpid
{
/// The weight of the regularisation in a policy. Without any the optimum is bang-bang, which a
/// large but finite gain gives, too.
inline double RegularizationOf(const Problem& problem)
{
  return std::max(problem.RegularizationWeight(), 1e-30);
}

/// How far rays reach at first in a sweep that weighs.
enum class Reach
{
  Unlimited,  ///< through the whole volume
  OfLastSweep ///< as far as it was worth it in the last such sweep
};

/// The policy sweep of one term: finds the next iterate from the last one. All addresses are on
/// the device.
struct PolicySweep
{
  const float* last;   ///< the last iterate [1/length]
  const float* lagged; ///< derivative of the other terms, with weights; null: none
  float* next;         ///< the next iterate [1/length]
  double weight;       ///< of the term
  Transmittance transmittance;
  Kept kept;                          ///< of the base
  double proximity = 0;               ///< of ProximalDescent
  const float* alternative = nullptr; ///< see WeighStep [1/length]; null: nothing is weighed
  Reach reach = Reach::Unlimited;     ///< of the rays, where something is weighed
  double smoothing = 0;            ///< sigma of SmoothedChange [length], if `lagged` has its pull
  const float* previous = nullptr; ///< what to stay near [1/length]; null: nothing
  bool emphasises = true; ///< whether matter may become thicker than in the data, as far as it may
  const TermsOnRanks* ranks = nullptr; ///< that share the sweep; null: there is one
};

/// Sweeps all frusta of a term. Leaves what its rays have seen of the next iterate, and its optical
/// depths, with the rays. `moved`: on the processor, how far the next iterate is from the others is
/// added there.
template <class AnyDevice>
void SweepPolicy(AnyDevice& device, VisibilityTerm<AnyDevice>& term, const Problem& problem,
  const ProblemFields<AnyDevice>& fields, const PolicySweep& sweep, ExactDifferences& moved);

/// The first policy sweep of one term alone: nothing is known of transmittance or other terms.
/// Leaves nothing with the rays. `previous`: see PolicySweep.
template <class AnyDevice>
void SweepFirstPolicy(AnyDevice& device, VisibilityTerm<AnyDevice>& term, const Problem& problem,
  const ProblemFields<AnyDevice>& fields, const float* previous, double weight, float* next);

/// Whether what the rays of a frustum have met in their policy sweep was the next iterate, whose
/// score and optical depths are known then: not the voxels of a frustum that is swept later. With
/// Derivative::Ray what rays carry is not the score.
inline bool MetNextIterate(std::size_t frustum, std::size_t frusta, Derivative derivative)
{
  return frustum + 1 == frusta && derivative == Derivative::Volume;
}
}

#endif
