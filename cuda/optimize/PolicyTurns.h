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
/// One policy iteration: which term is swept, and how.
template <class AnyDevice>
struct PolicyTurn
{
  EnergyTerm<AnyDevice>* swept;
  std::vector<EnergyTerm<AnyDevice>*> others; ///< contribute derivatives at the last iterate
  Transmittance transmittance;
  bool weighs; ///< whether the gain of clearing is weighed against its cost
  Reach reach;
  double smoothing = 0; ///< see PolicySweep [length]
};

/// The order in which the terms of an energy are swept: the cameras in turn or, without cameras,
/// the light. The first turn of each term assumes transmittance 1, so that hidden structures can
/// contribute the gain of revealing them.
template <class AnyDevice>
class PolicyTurns
{
public:
  using Term = EnergyTerm<AnyDevice>;
  using Turn = PolicyTurn<AnyDevice>;

  /// `problem` and `energy` must outlive it. `warm`: whether iterations start from an earlier
  /// result.
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

  /// Returns the maximum number of policy sweeps. In thick media, policy sweeps find at once which
  /// structures to clear, and resilient steps are better at everything else.
  int SweepLimit() const
  {
    const int iterations = this->IterationLimit();
    return this->Given->IsThick() ? (iterations + 1) / 2 : iterations;
  }

  /// Number of terms that are swept in turn.
  int MainTerms() const { return std::max(1, this->Cameras()); }

  Turn Of(int iteration) const
  {
    const int round = this->MainTerms();
    const bool litBeside = this->Cameras() > 0 && !this->Energy->all.back().IsOfCamera();
    const bool returns = this->SweepLimit() > round + 1; // a camera is swept last
    const bool lightFirst = iteration == round && litBeside && returns && !this->Warm;
    Term& swept = lightFirst ? this->Energy->all.back() : this->Main(iteration);
    const bool first = lightFirst || iteration < round;
    return { &swept, this->AllBut(swept),
      first && !this->Warm ? Transmittance::AssumeOne : Transmittance::OfLastIterate,
      iteration < 3 * round && this->CanCostMoreThanItShows(swept),
      first ? Reach::Unlimited : Reach::OfLastSweep };
  }

  /// A turn that smooths changes between neighbours.
  Turn Smoothing(int iteration) const
  {
    Term& swept = this->Main(iteration);
    return { &swept, this->AllBut(swept), Transmittance::OfLastIterate, false, Reach::OfLastSweep,
      this->Given->SmoothingStrength() };
  }

private:
  int Cameras() const
  {
    const auto& all = this->Energy->all;
    return int(
      std::count_if(all.begin(), all.end(), [](const Term& term) { return term.IsOfCamera(); }));
  }

  Term& Main(int iteration) const
  {
    return this->Energy->all[std::size_t(iteration % this->MainTerms())];
  }

  std::vector<Term*> AllBut(const Term& swept) const
  {
    std::vector<Term*> others;
    for (Term& term : this->Energy->all)
    {
      if (&term != &swept)
      {
        others.push_back(&term);
      }
    }
    return others;
  }

  /// Whether clearing a way through the volume can cost more than it can show. Clearing the
  /// majorant along the whole diameter costs p (R majorant)^2 in normalised coordinates; it can
  /// gain at most V = 1.
  bool CanCostMoreThanItShows(const Term& swept) const
  {
    const Problem& problem = *this->Given;
    const double radius = problem.grid.Radius();
    const double diameter = radius * problem.majorant;
    double change = problem.NormalisedRegularization();
    for (const Pull& pull : problem.furtherPulls)
    {
      change += pull.weight / radius;
    }
    return swept.Weight() < change * diameter * diameter;
  }

  const Problem* Given;
  Terms<AnyDevice>* Energy;
  bool Warm;
};
}

#endif
