// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled for each device, see CompiledDevice.h.

#include "optimize/Policy.h"

#include "optimize/CoarseProblem.h"
#include "optimize/DescentProgress.h"
#include "optimize/Iterate.h"
#include "optimize/LaggedDerivative.h"
#include "optimize/PolicyTurns.h"
#include "optimize/ProximalDescent.h"
#include "optimize/ResilientDescent.h"

#include <algorithm>
#include <array>
#include <utility>

namespace limpid
{
namespace
{
/// The first proximity for ProximalDescent: it at least doubles the regularisation, and moves
/// voxels through their whole range where T (V - g) is 0.1 or more.
double FirstProximity(const Problem& problem)
{
  constexpr double wholeRange = 0.1;
  const Weights& weights = problem.settings.weights;
  const double weight = weights.view > 0 ? weights.view : weights.light;
  return std::max(1.0, wholeRange * weight / problem.majorant / RegularizationOf(problem) - 1);
}

template <class AnyDevice>
class Policy : public Minimizer
{
public:
  Policy(const std::shared_ptr<AnyDevice>& device, const Problem& problem,
    const StartingExtinction& start, bool warm)
    : Given(&problem)
    , Device(device)
    , Energy(device, problem)
    , Warm(warm)
    , Turns(problem, this->Energy, warm)
    , Proximal(FirstProximity(problem))
    , Lagged(device, problem, this->Energy)
    , Resilient(device, problem, this->Energy)
    , Steps(problem)
  {
    if (!start)
    {
      this->Iterates[0].values = this->Energy.Fields().base.Data();
      return;
    }
    this->Iterates[0].own = this->Energy.Everywhere(*start);
    this->Iterates[0].values = this->Iterates[0].own.Data();
  }

  IterationRecord Start() override
  {
    this->Lowest = this->MeasureFirst();
    this->LastEnergy = this->FirstEnergy = this->Lowest.energy.Total();
    for (const Term& term : this->Energy.all)
    {
      this->Seeing.Add(term);
    }
    this->Proximal.BeginAt(this->Lowest.energy.Total());
    return this->Lowest;
  }

  Score BaseScore() const override { return this->Energy.BaseScore(); }

  IterationRecord Iterate() override
  {
    [[maybe_unused]] const typename AnyDevice::Team team;
    this->Readable.Outdate();
    if (this->Refines())
    {
      this->FreeWhatSweepsNeed();
      if (this->DescendsFromBase() && !this->Given->IsSmall() && !this->HasBranched)
      {
        this->HasBranched = true;
        this->DescendFromOtherStarts();
      }
      return this->Refine();
    }
    if (this->DescendsFromFirstSweeps() && this->Count == 0)
    {
      this->DescendFrom(this->Now, this->LastEnergy, mostSteps);
    }
    const Turn turn = this->Turns.Of(this->Count++);
    const IterationRecord record = this->Advance(turn);
    const double energy = record.energy.Total();
    if (turn.transmittance == Transmittance::AssumeOne)
    {
      this->Proximal.BeginAt(energy);
    }
    else if (!this->Proximal.Keeps(energy, this->Lowest.energy.Total()))
    {
      return this->GoBack();
    }
    this->KeepIfLowest(record);
    if (this->DescendsFromFirstSweeps() && this->Count == this->Turns.MainTerms())
    {
      this->DescendFrom(this->Now, this->LastEnergy, mostSteps);
    }
    return this->DescendsFromBase() ? this->BestRecord() : record;
  }

  IterationRecord Smooth() override
  {
    [[maybe_unused]] const typename AnyDevice::Team team;
    this->Readable.Outdate();
    if (this->Now != this->BestOf)
    {
      this->GoBack();
    }
    this->IsRefining = this->IsRefining && this->IsSmoothing; // steps are short at this stage
    this->IsSmoothing = true;
    IterationRecord record = this->Given->IsThick()
      ? this->StepResiliently(this->Given->SmoothingStrength())
      : this->Advance(this->Turns.Smoothing(this->Count++));
    record.isResult = true;
    this->BestOf = this->Now;
    return record;
  }

  bool Converged() const override
  {
    return this->Given->IsThick() ? this->HasRefined() && this->Given->settings.tolerance > 0
                                  : this->ChangesLess(1);
  }

  bool IsNear() const override
  {
    constexpr double nearness = 10;
    return this->Given->IsThick() ? this->HasRefined() : this->ChangesLess(nearness);
  }

  int IterationLimit() const override { return this->Turns.IterationLimit(); }

  void BestToPiece(const FieldView& piece) const override
  {
    this->Energy.Distribution().ToPiece(this->Iterates[this->BestOf].values, piece);
  }

  const float* BestValues() const override
  {
    return AnyDevice::readsHostMemory ? this->Iterates[this->BestOf].values : this->Best().data();
  }

  const std::vector<float>& Best() const override
  {
    return this->Readable.Of(
      *this->Device, this->Iterates[this->BestOf].values, this->Given->grid.NodeCount());
  }

  void KeepOnlyBest() override
  {
    this->KeepIterates(this->BestOf, this->BestOf);
    this->Lagged.Clear();
    this->Resilient.Clear();
  }

  std::vector<float> TakeBest() override
  {
    this->KeepOnlyBest();
    this->Best();
    return this->Readable.Take();
  }

  ExtinctionOnDevice BestOnDevice() const override
  {
    return PlaceOnDevice(this->Energy.Fields(), this->Iterates[this->BestOf].values);
  }

  FoundExtinction TakeResult() override
  {
    return TakeResultOf(*this, this->Device, this->Energy.SharedFields(),
      std::move(this->Iterates[this->BestOf].own));
  }

private:
  using Term = EnergyTerm<AnyDevice>;
  using Turn = PolicyTurn<AnyDevice>;

  /// Returns whether policy sweeps may also raise extinction. In thick media they may not, since
  /// raised extinction hides more than a sweep accounts for; there, resilient steps raise what the
  /// sweeps have cleared. The initial extinction or the reference may already exceed the base,
  /// however.
  bool SweepsEmphasise() const
  {
    return this->Warm || this->IsHardlyThick() || !this->Given->furtherPulls.empty();
  }

  bool IsHardlyThick() const { return this->Given->MostNodeDepth() < hardlyThick; }

  /// Returns whether policy sweeps have converged, so that resilient steps follow.
  bool Refines() const
  {
    return this->Given->IsThick() &&
      (this->IsRefining || this->ChangesLess(1) || this->Count >= this->Turns.SweepLimit());
  }

  /// Returns whether the last resilient steps have gained almost nothing, at the lowest energy. In
  /// media that are hardly thick, sweeps have found almost everything, and a few steps are enough.
  bool HasRefined() const
  {
    const bool enough =
      this->Steps.HasStalled() || (this->Steps.Count() >= fewSteps && this->IsHardlyThick());
    return enough && !(this->Steps.Lowest() > this->Lowest.energy.Total());
  }

  /// Returns whether steps also descend from the base: if important matter is opaque and may be
  /// removed, a sweep can remove too much of it at once. In a small volume, this takes almost no
  /// time.
  bool DescendsFromBase() const
  {
    constexpr double opaque = 4;
    const bool removes =
      this->Given->settings.protectImportance < 1 && this->Given->MostNodeDepth() > opaque;
    return this->Given->IsThick() && !this->Warm && (this->Given->IsSmall() || removes);
  }

  /// Returns whether to descend from the result of the first sweeps as well; both happen before
  /// further sweeps.
  bool DescendsFromFirstSweeps() const
  {
    return this->DescendsFromBase() && this->Given->IsSmall();
  }

  /// Makes resilient steps from other starts than the result of the sweeps: from a coarser grid,
  /// and from the base if little has been gained on it.
  void DescendFromOtherStarts()
  {
    constexpr double little = 2; // times the energy of the base
    this->DescendFromCoarser();
    if (this->Lowest.energy.Total() > little * this->FirstEnergy)
    {
      const std::size_t free = this->FreeIterate();
      limpid::Iterate<AnyDevice>& base = this->Iterates[free];
      base.own = {};
      base.values = this->Energy.Fields().base.Data();
      this->DescendFrom(free, this->FirstEnergy, mostSteps);
    }
  }

  /// Makes resilient steps from an iterate with a given energy. Later sweeps or steps continue from
  /// the last iterate. `stepsAbove`: the largest number of steps while they are above the lowest
  /// energy.
  void DescendFrom(std::size_t first, double energyThere, int stepsAbove)
  {
    const double energy = std::exchange(this->LastEnergy, energyThere);
    const double change = this->Change;
    this->BranchedAt = std::exchange(this->Now, first);
    this->BeginRefinement();
    for (int step = 0; step < mostSteps && !this->Steps.HasStalled(); ++step)
    {
      if (step >= stepsAbove && this->Steps.Lowest() > this->Lowest.energy.Total())
      {
        break;
      }
      this->TryResilientStep();
    }
    this->BeginRefinement();
    this->Now = std::exchange(this->BranchedAt, none);
    this->Change = change;
    this->LastEnergy = energy;
  }

  /// Makes resilient steps from the optimum with half as many nodes along each axis, which finds
  /// ways through opaque matter that steps of single nodes do not. In a small volume, other starts
  /// find them; elsewhere, only the most opaque matter is worth the time.
  void DescendFromCoarser()
  {
    constexpr double mostOpaque = 20;
    if (this->Given->MostNodeDepth() < mostOpaque)
    {
      return;
    }
    const CoarseProblem coarse(*this->Given, 2);
    const std::size_t free = this->FreeIterate();
    limpid::Iterate<AnyDevice>& start = this->Iterates[free];
    start.own =
      this->Energy.Everywhere(coarse.ChangedOn(this->Given->grid, this->FoundBy(coarse.Made())));
    start.values = start.own.Data();
    this->DescendFrom(free, this->MeasureIterate(free), fewSteps);
  }

  /// Returns the optimum of another problem, in the owned slab if the problem is distributed.
  std::vector<float> FoundBy(const Problem& problem)
  {
    Policy policy(this->Device, problem, {}, false);
    policy.Start();
    for (int made = 0; made < policy.IterationLimit() && !policy.Converged(); ++made)
    {
      policy.Iterate();
    }
    const float* best = policy.Best().data();
    const Slab own = problem.OwnSlab();
    return { best + own.Begin(), best + own.Begin() + own.Count() };
  }

  /// Returns the energy of an iterate, and keeps the iterate if it is the best.
  double MeasureIterate(std::size_t which)
  {
    const std::size_t last = std::exchange(this->Now, which);
    const IterationRecord record = this->Energy.Measure(this->Iterates[which].values);
    this->KeepIfLowest(record);
    this->Now = last;
    this->Lagged.Outdate();
    return record.energy.Total();
  }

  /// Makes several resilient steps. They start at the last iterate, since one that clears much may
  /// lead to a lower energy than one that has a lower energy but clears little. If they end above
  /// the lowest energy, or start far above it, further steps start at the best iterate. Returns the
  /// record of the best.
  IterationRecord Refine()
  {
    constexpr int stepsPerIteration = 7;
    constexpr int mostStepsAbove = 10;
    constexpr double leastShare = 0.5; ///< of what the best iterate has gained
    const double best = this->Lowest.energy.Total();
    const bool begins = !this->IsRefining;
    if (begins && this->Given->IsSmall() && this->Now != this->BestOf)
    {
      this->DescendFrom(this->BestOf, best, mostSteps); // two starts take almost no time there
    }
    if (begins && this->FirstEnergy - this->LastEnergy < leastShare * (this->FirstEnergy - best))
    {
      this->GoBack();
    }
    for (int step = 0; step < stepsPerIteration && !this->HasRefined(); ++step)
    {
      const bool isAbove = this->Steps.Lowest() > this->Lowest.energy.Total();
      if (isAbove && (this->Steps.HasStalled() || this->Steps.Count() >= mostStepsAbove))
      {
        this->GoBack();
        this->BeginRefinement();
      }
      this->TryResilientStep();
    }
    return this->BestRecord();
  }

  /// Returns the record of the best iterate, with the last change.
  IterationRecord BestRecord() const
  {
    IterationRecord record = this->Lowest;
    record.meanChange = this->Change;
    return record;
  }

  /// Lets the next resilient step be the first one, from the last iterate.
  void BeginRefinement()
  {
    this->IsRefining = false;
    this->Steps.Begin();
  }

  void TryResilientStep()
  {
    const double before = this->LastEnergy;
    const IterationRecord record = this->StepResiliently(0);
    this->Steps.Step(before, record.energy.Total());
    this->KeepIfLowest(record);
  }

  void KeepIfLowest(const IterationRecord& record)
  {
    if (record.energy.Total() < this->Lowest.energy.Total())
    {
      this->Lowest = record;
      this->BestOf = this->Now;
    }
  }

  IterationRecord StepResiliently(double smoothing)
  {
    const std::size_t place = this->PlaceOfStep();
    const float* last = this->Iterates[this->Now].values;
    limpid::Iterate<AnyDevice>& next = this->Iterates[place];
    this->Allocate(next);
    if (!this->IsRefining)
    {
      this->Resilient.BeginAt(last);
      this->IsRefining = true;
    }
    const IterationRecord record = this->Resilient.Step(last, next.own.Data(), smoothing);
    this->Now = place;
    this->LastEnergy = record.energy.Total();
    this->Change = record.meanChange;
    this->Lagged.Outdate();
    this->Seeing.Clear(); // derivatives do not store optical depths
    return record;
  }

  /// Returns whether the last change was below this multiple of the tolerance.
  bool ChangesLess(double times) const
  {
    constexpr double little = 5; // change of the extinction, in units of the tolerance
    const double tolerance = times * this->Given->settings.tolerance;
    const bool gains = this->Proximal.EnergyChange() >= DescentProgress::leastGain * tolerance;
    return this->Count >= this->Turns.MainTerms() && !this->Weighed &&
      this->Change < (gains ? 1 : little) * tolerance;
  }

  IterationRecord MeasureFirst()
  {
    if (this->Iterates[0].own.Empty())
    {
      return this->Energy.MeasureBase();
    }
    this->Energy.SeeBase();
    return this->Energy.Measure(this->Iterates[0].values);
  }

  /// Returns to the best iterate. Returns its record, with the change that was rejected.
  IterationRecord GoBack()
  {
    this->Now = this->BestOf;
    this->LastEnergy = this->Lowest.energy.Total();
    this->Lagged.Outdate();
    this->Seeing.Clear();
    return this->BestRecord();
  }

  /// Returns an index for the next iterate, which overwrites neither the last, nor the best, nor
  /// the start of a descent.
  std::size_t FreeIterate() const
  {
    std::size_t free = 0;
    while (free == this->Now || free == this->BestOf || free == this->BranchedAt)
    {
      ++free;
    }
    return free;
  }

  /// Returns the index of the iterate that a resilient step writes: the last one, unless that is
  /// needed.
  std::size_t PlaceOfStep() const
  {
    const bool isNeeded = this->Now == this->BestOf || this->Now == this->BranchedAt ||
      this->Iterates[this->Now].own.Empty();
    return isNeeded ? this->FreeIterate() : this->Now;
  }

  /// Frees what resilient steps do not need, since they have fields of their own.
  void FreeWhatSweepsNeed()
  {
    this->Lagged.Clear();
    this->KeepIterates(this->Now, this->BestOf);
  }

  /// Frees all other iterates.
  void KeepIterates(std::size_t one, std::size_t other)
  {
    for (std::size_t i = 0; i < this->Iterates.size(); ++i)
    {
      if (i != one && i != other)
      {
        this->Iterates[i] = {};
      }
    }
  }

  /// Makes a policy sweep to the next iterate, and returns its record.
  IterationRecord Advance(const Turn& turn)
  {
    const std::size_t free = this->FreeIterate();
    const float* last = this->Iterates[this->Now].values;
    limpid::Iterate<AnyDevice>& next = this->Iterates[free];
    this->Prepare(*turn.swept, last, next);
    this->LookBefore(turn, last);
    this->Sweep(turn, last, next.own.Data());
    this->LookAfter(turn, next.own.Data());
    const IterationRecord record = this->Energy.Record();
    this->Now = free;
    this->LastEnergy = record.energy.Total();
    this->Change = record.meanChange;
    this->Weighed = turn.weighs;
    return record;
  }

  bool Allocate(limpid::Iterate<AnyDevice>& next) const
  {
    return AllocateIterate(
      this->Device, static_cast<std::size_t>(this->Given->grid.NodeCount()), next);
  }

  /// Makes `next` writable. It gets the values of `last` where sweeps do not write them, and where
  /// rays meet voxels of a frustum that is swept later.
  void Prepare(const Term& swept, const float* last, limpid::Iterate<AnyDevice>& next)
  {
    const bool isNew = this->Allocate(next);
    this->Energy.Distribution().CopyUnswept(
      swept.Number(), swept.Frusta().size(), isNew, last, next.own.Data());
  }

  /// Computes what a sweep needs to know of the last iterate: the optical depths of the rays, and
  /// the derivative of the other terms.
  void LookBefore(const Turn& turn, const float* last)
  {
    if (!this->Seeing.Contains(*turn.swept))
    {
      this->Energy.MeasureTerm(*turn.swept, last);
    }
    const bool first = this->Count == 1 && turn.transmittance == Transmittance::AssumeOne;
    if (!first && !this->Lagged.IsBeside(*turn.swept))
    {
      this->Lagged.Find(turn, last, this->Seeing);
    }
  }

  /// Measures by all terms what a sweep has made.
  void LookAfter(const Turn& turn, const float* next)
  {
    this->Lagged.Outdate();
    this->Seeing.Clear();
    this->Seeing.Add(*turn.swept);
    if (AnyDevice::readsHostMemory && this->SweepsSameNext(turn))
    {
      this->Lagged.Find(turn, next, this->Seeing); // also traverses the next iterate
      return;
    }
    for (Term* other : turn.others)
    {
      this->Energy.MeasureTerm(*other, next);
      this->Seeing.Add(*other);
    }
  }

  /// Returns whether the derivatives of the other terms by the next iterate are needed. Waits,
  /// since a device computes them only on demand.
  bool SweepsSameNext(const Turn& turn)
  {
    const bool again = this->Count < this->Turns.SweepLimit() &&
      (turn.weighs || !(this->Energy.MeanChange() < this->Given->settings.tolerance));
    return this->Turns.MainTerms() == 1 &&
      (turn.smoothing > 0 || (again && this->Turns.Of(this->Count).swept == turn.swept));
  }

  void Sweep(const Turn& turn, const float* last, float* next)
  {
    ExactDifferences moved;
    const bool scored = turn.swept->IsOfCamera() && this->Given->tellsScores;
    const Kept kept = scored ? Kept::Counted : Kept::Ignored;
    const bool afterCamera = this->Count > 1 &&
      std::any_of(turn.others.begin(), turn.others.end(),
        [](const Term* other) { return other->IsOfCamera(); });
    const float* alternative = afterCamera ? last : this->Cheapest();
    SweepPolicy(*this->Device, *turn.swept, this->Energy, *this->Given,
      { last, turn.smoothing > 0 ? this->Lagged.WithPull(turn, last) : this->Lagged.DataFor(turn),
        next, turn.swept->Weight(), this->PullsOf(turn, last), turn.transmittance, kept,
        turn.weighs ? alternative : nullptr, turn.reach, this->SweepsEmphasise() },
      moved);
    this->Energy.TakeSwept(*turn.swept, kept, moved, last, next);
  }

  /// Returns the pulls of a sweep: those of the energy, a proximal step, and smoothing.
  std::vector<Pull> PullsOf(const Turn& turn, const float* last) const
  {
    std::vector<Pull> pulls = this->Energy.Pulls();
    if (this->Proximal.Proximity() > 0)
    {
      pulls.push_back({ last, RegularizationOf(*this->Given) * this->Proximal.Proximity() });
    }
    pulls.push_back({ this->Energy.Fields().base.Data(), turn.smoothing });
    return pulls;
  }

  /// Returns the reference with the strongest pull, which costs least to stay at.
  const float* Cheapest() const
  {
    const std::vector<Pull>& pulls = this->Energy.Pulls();
    return std::max_element(pulls.begin(), pulls.end(),
      [](const Pull& one, const Pull& other) { return one.weight < other.weight; })
      ->reference;
  }

  static constexpr double hardlyThick = 0.6; ///< optical depth from node to node
  static constexpr int fewSteps = 7;         ///< resilient ones
  static constexpr int mostSteps = 24;       ///< of a descent
  static constexpr auto none = std::size_t(-1);

  const Problem* Given;
  std::shared_ptr<AnyDevice> Device;
  Terms<AnyDevice> Energy;
  bool Warm;
  PolicyTurns<AnyDevice> Turns;
  int Count = 0;
  double Change = 0;
  bool Weighed = false; ///< whether the last iteration changed weights; it is not stationary then
  ProximalDescent Proximal;
  TermsThatSee<AnyDevice> Seeing;
  LaggedDerivative<AnyDevice> Lagged;
  ResilientDescent<AnyDevice> Resilient;
  bool IsRefining = false; ///< whether resilient steps continue from the last iterate
  bool IsSmoothing = false;
  bool HasBranched = false;                           ///< whether steps have started elsewhere, too
  DescentProgress Steps;                              ///< resilient steps since the last start
  double FirstEnergy = 0;                             ///< energy of the initial extinction
  double LastEnergy = 0;                              ///< energy of the last iterate
  IterationRecord Lowest;                             ///< record of the best iterate
  std::array<limpid::Iterate<AnyDevice>, 4> Iterates; ///< filled as needed
  std::size_t Now = 0;                                ///< index of the last iterate
  std::size_t BranchedAt = none;                      ///< index of the start of a descent
  std::size_t BestOf = 0;                             ///< index of the best iterate
  mutable FieldOnHost Readable;                       ///< the best iterate
};
}

template <class AnyDevice>
std::unique_ptr<Minimizer> MakePolicy(const std::shared_ptr<AnyDevice>& device,
  const Problem& problem, const StartingExtinction& start, bool warm)
{
  return std::make_unique<Policy<AnyDevice>>(device, problem, start, warm);
}

template std::unique_ptr<Minimizer> MakePolicy(
  const std::shared_ptr<CompiledDevice>&, const Problem&, const StartingExtinction&, bool);
}
