// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_PolicyRefinement_h
#define limpid_optimize_PolicyRefinement_h

#include "optimize/CoarseProblem.h"
#include "optimize/DescentProgress.h"
#include "optimize/Policy.h"
#include "optimize/PolicyIterates.h"
#include "optimize/ResilientDescent.h"

#include <memory>
#include <utility>
#include <vector>

namespace limpid
{
/// Whether an extinction within its bounds stops so little light between two nodes that policy
/// sweeps find almost everything.
inline bool IsHardlyThick(const Problem& problem)
{
  constexpr double hardlyThick = 0.6; // optical depth from node to node
  return problem.MostNodeDepth() < hardlyThick;
}

/**
 * Resilient steps that follow policy sweeps in thick media, from the result of the sweeps and from
 * other starts (Documentation/Method.md, section on thick media). In other media it only smooths.
 */
template <class AnyDevice>
class PolicyRefinement
{
public:
  /// All must outlive it. `warm`: see MakePolicy.
  PolicyRefinement(std::shared_ptr<AnyDevice> device, const Problem& problem,
    Terms<AnyDevice>& energy, PolicyIterates<AnyDevice>& iterates, bool warm)
    : Device(std::move(device))
    , Given(&problem)
    , Energy(&energy)
    , Iterates(&iterates)
    , Warm(warm)
    , Resilient(this->Device, problem, energy)
    , Steps(problem)
  {
  }

  /// Whether steps continue from the last iterate.
  bool IsUnderWay() const { return this->Continues; }

  /// Whether the last steps have gained almost nothing, at the lowest energy. In media that are
  /// hardly thick, sweeps have found almost everything, and a few steps are enough.
  bool IsDone() const
  {
    const bool enough =
      this->Steps.HasStalled() || (this->Steps.Count() >= fewSteps && IsHardlyThick(*this->Given));
    return enough && !this->IsAboveLowest();
  }

  /// Whether steps also descend from the base: if important matter is opaque and may be removed, a
  /// sweep can remove too much of it at once. In a small volume, this takes almost no time.
  bool DescendsFromBase() const
  {
    constexpr double opaque = 4;
    const bool removes =
      this->Given->settings.protectImportance < 1 && this->Given->MostNodeDepth() > opaque;
    return this->Given->IsThick() && !this->Warm && (this->Given->IsSmall() || removes);
  }

  /// Descends from the last iterate, which stays.
  void DescendFromLast()
  {
    this->DescendFrom(this->Iterates->LastSlot(), this->Iterates->LastEnergy(), mostSteps);
  }

  /// Makes several steps. They start at the last iterate, since one that clears much may lead to a
  /// lower energy than one that has a lower energy but clears little. If they end above the lowest
  /// energy, or start far above it, further steps start at the best iterate. Returns the record of
  /// the best.
  IterationRecord Refine()
  {
    constexpr int stepsPerIteration = 7;
    constexpr int mostStepsAbove = 10;
    if (this->DescendsFromBase() && !this->Given->IsSmall() && !this->HasBranched)
    {
      this->HasBranched = true;
      this->DescendFromOtherStarts();
    }
    if (!this->Continues)
    {
      this->ChooseStart();
    }
    for (int step = 0; step < stepsPerIteration && !this->IsDone(); ++step)
    {
      if (this->IsAboveLowest() &&
        (this->Steps.HasStalled() || this->Steps.Count() >= mostStepsAbove))
      {
        this->Iterates->GoBack();
        this->Begin();
      }
      this->TryStep();
    }
    return this->Iterates->BestRecord();
  }

  /// Makes a step that smooths changes between neighbours, from the last iterate. Returns its
  /// record.
  IterationRecord Smooth()
  {
    this->Continues = this->Continues && this->IsSmoothing; // steps are short at this stage
    this->IsSmoothing = true;
    return this->Step(this->Given->SmoothingStrength());
  }

  /// Frees its memory.
  void Clear() { this->Resilient.Clear(); }

private:
  using Slot = typename PolicyIterates<AnyDevice>::Slot;

  static constexpr int fewSteps = 7;
  static constexpr int mostSteps = 24; ///< of a descent

  bool IsAboveLowest() const { return this->Steps.Lowest() > this->Iterates->LowestEnergy(); }

  /// Goes to the best iterate before the first step if the sweeps have ended far above it.
  void ChooseStart()
  {
    constexpr double leastShare = 0.5; // of what the best iterate has gained
    PolicyIterates<AnyDevice>& iterates = *this->Iterates;
    const double best = iterates.LowestEnergy();
    if (this->Given->IsSmall() && !iterates.IsAtBest())
    {
      this->DescendFrom(iterates.BestSlot(), best, mostSteps); // takes almost no time there
    }
    const double first = iterates.FirstEnergy();
    if (first - iterates.LastEnergy() < leastShare * (first - best))
    {
      iterates.GoBack();
    }
  }

  /// Makes steps from other starts than the result of the sweeps: from a coarser grid, and from the
  /// base if little has been gained on it.
  void DescendFromOtherStarts()
  {
    constexpr double little = 2; // times the energy of the base
    this->DescendFromCoarser();
    const double first = this->Iterates->FirstEnergy();
    if (this->Iterates->LowestEnergy() > little * first)
    {
      const Slot free = this->Iterates->Free();
      this->Iterates->PutBase(free);
      this->DescendFrom(free, first, mostSteps);
    }
  }

  /// Makes steps from the optimum with half as many nodes along each axis, which finds ways through
  /// opaque matter that steps of single nodes do not. In a small volume, other starts find them;
  /// elsewhere, only the most opaque matter is worth the time.
  void DescendFromCoarser()
  {
    constexpr double mostOpaque = 20;
    if (this->Given->MostNodeDepth() < mostOpaque)
    {
      return;
    }
    const CoarseProblem coarse(*this->Given, 2);
    const Slot free = this->Iterates->Free();
    this->Iterates->Put(free,
      this->Energy->Everywhere(
        coarse.ChangedOn(this->Given->grid, this->OptimumOf(coarse.Made()))));
    const IterationRecord start = this->Energy->Measure(this->Iterates->In(free));
    this->Iterates->KeepIfLowest(free, start);
    this->DescendFrom(free, start.energy.Total(), fewSteps);
  }

  /// Returns the optimum of another problem, in the owned slab if the problem is distributed.
  std::vector<float> OptimumOf(const Problem& problem)
  {
    const std::unique_ptr<Minimizer> policy = MakePolicy(this->Device, problem, {}, false);
    policy->Start();
    for (int made = 0; made < policy->IterationLimit() && !policy->Converged(); ++made)
    {
      policy->Iterate();
    }
    const float* best = policy->Best().data();
    const Slab own = problem.OwnSlab();
    return { best + own.Begin(), best + own.Begin() + own.Count() };
  }

  /// Makes steps from an iterate with a given energy. Later sweeps or steps continue from the last
  /// iterate. `stepsAbove`: the largest number of steps while they are above the lowest energy.
  void DescendFrom(Slot first, double energy, int stepsAbove)
  {
    this->Iterates->Branch(first, energy);
    this->Begin();
    for (int step = 0; step < mostSteps && !this->Steps.HasStalled(); ++step)
    {
      if (step >= stepsAbove && this->IsAboveLowest())
      {
        break;
      }
      this->TryStep();
    }
    this->Begin();
    this->Iterates->EndBranch();
  }

  /// Lets the next step be the first one, from the last iterate.
  void Begin()
  {
    this->Continues = false;
    this->Steps.Begin();
  }

  void TryStep()
  {
    const double before = this->Iterates->LastEnergy();
    const IterationRecord record = this->Step(0);
    this->Steps.Step(before, record.energy.Total());
    this->Iterates->KeepLastIfLowest(record);
  }

  /// Makes a step from the last iterate to the next. `smoothing`: see ResilientDescent::Step.
  IterationRecord Step(double smoothing)
  {
    const Slot next = this->Iterates->FreeOrLast();
    const float* last = this->Iterates->Last();
    this->Iterates->Allocate(next);
    if (!this->Continues)
    {
      this->Resilient.BeginAt(last);
      this->Continues = true;
    }
    const IterationRecord record =
      this->Resilient.Step(last, this->Iterates->Writable(next), smoothing);
    this->Iterates->MoveTo(next, record);
    return record;
  }

  std::shared_ptr<AnyDevice> Device;
  const Problem* Given;
  Terms<AnyDevice>* Energy;
  PolicyIterates<AnyDevice>* Iterates;
  bool Warm;
  ResilientDescent<AnyDevice> Resilient;
  DescentProgress Steps;    ///< since the last start
  bool Continues = false;   ///< see IsUnderWay
  bool IsSmoothing = false; ///< whether the last steps were those of Smooth
  bool HasBranched = false; ///< whether steps have started elsewhere, too
};
}

#endif
