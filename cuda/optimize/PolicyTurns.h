// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_PolicyTurns_h
#define limpid_optimize_PolicyTurns_h

#include "optimize/PolicySweep.h"
#include "optimize/Terms.h"

#include <algorithm>
#include <vector>

namespace limpid
{
/// What a policy iteration sweeps.
template <class AnyDevice>
struct PolicyTurn
{
  VisibilityTerm<AnyDevice>* swept;
  std::vector<VisibilityTerm<AnyDevice>*> others; ///< act with derivatives at the last iterate
  Transmittance transmittance;
  bool weighs; ///< its clearing against its cost
  Reach reach;
  double smoothing = 0; ///< see PolicySweep [length]
};

/// The order in which the terms of an energy are swept: the cameras in turn or, without one, the
/// light. But each has a turn in which nothing is in its way: what is hidden from it must be able
/// to say what it would gain.
template <class AnyDevice>
class PolicyTurns
{
public:
  using Term = VisibilityTerm<AnyDevice>;
  using Turn = PolicyTurn<AnyDevice>;

  /// Both must outlive it. `warm`: whether iterations start from an earlier result.
  PolicyTurns(const Problem& problem, Terms<AnyDevice>& energy, bool warm)
    : Given(&problem)
    , Energy(&energy)
    , Warm(warm)
  {
  }

  int IterationLimit() const
  {
    return this->Given->settings.maximumIterations * int(this->Given->NumberOfCameras());
  }

  /// How many policy sweeps there are at most: in thick media they find the structures to be
  /// cleared at once, and resilient steps are better at all else.
  int SweepLimit() const
  {
    const int iterations = this->IterationLimit();
    return this->Given->IsThick() ? (iterations + 1) / 2 : iterations;
  }

  /// How many terms are swept in turn.
  int MainTerms() const { return std::max(1, int(this->Energy->cameras.size())); }

  Turn Of(int iteration) const
  {
    const int round = this->MainTerms();
    const bool litBeside = !this->Energy->cameras.empty() && this->Energy->light;
    const bool returns = this->SweepLimit() > round + 1; // a camera has the last word
    const bool lightFirst = iteration == round && litBeside && returns && !this->Warm;
    Term& swept = lightFirst ? *this->Energy->light : this->Main(iteration);
    const bool first = lightFirst || iteration < round;
    return { &swept, this->AllBut(swept),
      first && !this->Warm ? Transmittance::AssumeOne : Transmittance::OfLastIterate,
      iteration < 3 * round && this->CanCostMoreThanItShows(swept),
      first ? Reach::Unlimited : Reach::OfLastSweep };
  }

  /// A turn that draws the changes of neighbours together.
  Turn Smoothing(int iteration) const
  {
    Term& swept = this->Main(iteration);
    return { &swept, this->AllBut(swept), Transmittance::OfLastIterate, false, Reach::OfLastSweep,
      this->Given->SmoothingStrength() };
  }

private:
  Term& Main(int iteration) const
  {
    return this->Energy->cameras.empty()
      ? *this->Energy->light
      : this->Energy->cameras[std::size_t(iteration % this->MainTerms())];
  }

  std::vector<Term*> AllBut(const Term& swept) const
  {
    std::vector<Term*> others = this->Energy->All();
    others.erase(std::find(others.begin(), others.end(), &swept));
    return others;
  }

  /// Whether it can cost more to clear a way through the volume than it can show: where the
  /// majorant is cleared all along the diameter, p (R majorant)^2 in normalised coordinates,
  /// against a V of 1.
  bool CanCostMoreThanItShows(const Term& swept) const
  {
    const Problem& problem = *this->Given;
    const double radius = problem.grid.Radius();
    const double diameter = radius * problem.majorant;
    const double change = problem.NormalisedRegularization() + problem.CoherenceWeight() / radius;
    return this->Energy->WeightOf(swept) < change * diameter * diameter;
  }

  const Problem* Given;
  Terms<AnyDevice>* Energy;
  bool Warm;
};
}

#endif
