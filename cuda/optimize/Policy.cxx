// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled twice, see CompiledDevice.h.

#include "optimize/Policy.h"

#include "optimize/FieldsOfRanks.h"
#include "optimize/Iterate.h"
#include "optimize/PolicySweep.h"
#include "optimize/ProximalDescent.h"
#include "optimize/ResilientDescent.h"
#include "optimize/Smoothing.h"

#include <algorithm>
#include <array>

namespace limpid
{
namespace
{
/// Whether it can cost more to clear a way through the volume than it can show: where the majorant
/// is cleared all along the diameter, p (R majorant)^2 in normalised coordinates, against a V of 1.
bool CanCostMoreThanItShows(const Problem& problem, double weight)
{
  const double radius = problem.grid.Radius();
  const double diameter = radius * problem.majorant;
  const double change = problem.NormalisedRegularization() + problem.CoherenceWeight() / radius;
  return weight < change * diameter * diameter;
}

/// For ProximalDescent: it doubles the regularisation at least, and moves voxels through their
/// whole range where T (V - g) is 0.1 or more.
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
    , Descent(FirstProximity(problem))
    , Resilient(device, problem, this->Energy)
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
    this->LastEnergy = this->Lowest.energy.Total();
    for (const Term* term : this->Energy.All())
    {
      this->SeeLast.push_back(term);
    }
    this->Descent.BeginAt(this->Lowest.energy.Total());
    return this->Lowest;
  }

  Score BaseScore() const override { return this->Energy.BaseScore(); }

  IterationRecord Iterate() override
  {
    [[maybe_unused]] const typename AnyDevice::Team team;
    this->OnHost.clear();
    if (this->Refines())
    {
      return this->Refine();
    }
    if (this->DescendsFromBase() && this->Count == 0)
    {
      this->DescendFromHere();
    }
    const Turn turn = this->TurnOf(this->Count++);
    const IterationRecord record = this->Advance(turn);
    const double energy = record.energy.Total();
    if (turn.transmittance == Transmittance::AssumeOne)
    {
      this->Descent.BeginAt(energy);
    }
    else if (!this->Descent.Keeps(energy, this->Lowest.energy.Total()))
    {
      return this->GoBack();
    }
    this->KeepIfLowest(record);
    if (this->DescendsFromFirstSweeps() && this->Count == this->MainTerms())
    {
      this->DescendFromHere();
    }
    return this->DescendsFromBase() ? this->BestRecord() : record;
  }

  IterationRecord Smooth() override
  {
    [[maybe_unused]] const typename AnyDevice::Team team;
    this->OnHost.clear();
    if (this->Now != this->BestOf)
    {
      this->GoBack();
    }
    this->IsRefining = this->IsRefining && this->IsSmoothing; // steps are short by now
    this->IsSmoothing = true;
    IterationRecord record = this->Given->IsThick()
      ? this->StepResiliently(this->Given->SmoothingStrength())
      : this->Advance(this->SmoothingTurn());
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

  int IterationLimit() const override
  {
    return this->Given->settings.maximumIterations * int(this->Given->NumberOfCameras());
  }

  void BestToPiece([[maybe_unused]] const FieldView& piece) const override
  {
    if constexpr (AnyDevice::readsHostMemory)
    {
      this->Energy.OnRanks()->ToPieces(
        this->Iterates[this->BestOf].values, this->Given->shared->wanted, piece);
    }
  }

  const float* BestValues() const override
  {
    return AnyDevice::readsHostMemory ? this->Iterates[this->BestOf].values : this->Best().data();
  }

  const std::vector<float>& Best() const override
  {
    if (this->OnHost.empty())
    {
      this->OnHost = limpid::OnHost(
        *this->Device, this->Iterates[this->BestOf].values, this->Given->grid.NodeCount());
    }
    return this->OnHost;
  }

  std::vector<float> TakeBest() override
  {
    this->Best();
    return std::move(this->OnHost);
  }

  ExtinctionOnDevice BestOnDevice() const override
  {
    if (AnyDevice::readsHostMemory)
    {
      return {};
    }
    return { this->Energy.Fields().base.Data(), this->Iterates[this->BestOf].values };
  }

  FoundExtinction TakeResult() override
  {
    if constexpr (AnyDevice::readsHostMemory)
    {
      return this->TakeBest();
    }
    else
    {
      return FoundExtinction(std::make_unique<ResultOn<AnyDevice>>(
        this->Device, this->Energy.SharedFields(), std::move(this->Iterates[this->BestOf].own)));
    }
  }

private:
  using Term = VisibilityTerm<AnyDevice>;

  /// How many policy sweeps there are at most: in thick media they find the structures to be
  /// cleared at once, and resilient steps are better at all else.
  int SweepLimit() const
  {
    const int iterations = this->IterationLimit();
    return this->Given->IsThick() ? (iterations + 1) / 2 : iterations;
  }

  /// Whether matter may become thicker in policy sweeps, too. Not in thick media, where that hides
  /// more than a sweep finds: what the sweeps have cleared is made thicker by resilient steps. But
  /// what is started from, or to stay near, may be thicker already.
  bool SweepsEmphasise() const
  {
    return this->Warm || !this->Given->IsThick() || this->Given->previous != nullptr;
  }

  /// Whether policy sweeps have found what they can, so that resilient steps follow.
  bool Refines() const
  {
    return this->Given->IsThick() &&
      (this->IsRefining || this->ChangesLess(1) || this->Count >= this->SweepLimit());
  }

  /// Whether the last resilient steps have gained next to nothing.
  bool HasStalled() const
  {
    const int patience = this->Given->IsSmall() ? 6 : 3;
    return this->StepsWithoutGain >= patience;
  }

  /// Whether that is so at the lowest energy.
  bool HasRefined() const
  {
    return this->HasStalled() && !(this->LowestRefined > this->Lowest.energy.Total());
  }

  /// Whether steps also descend from the base: where important matter is opaque and may be removed,
  /// a sweep can remove too much of it at once. In a small volume that takes next to no time.
  bool DescendsFromBase() const
  {
    constexpr double opaque = 4;
    const bool removes =
      this->Given->settings.protectImportance < 1 && this->Given->MostNodeDepth() > opaque;
    return this->Given->IsThick() && !this->Warm && (this->Given->IsSmall() || removes);
  }

  /// ... and from what the first sweeps have cleared.
  bool DescendsFromFirstSweeps() const
  {
    return this->DescendsFromBase() && this->Given->IsSmall();
  }

  /// Resilient steps from the last iterate, where sweeps go on then.
  void DescendFromHere()
  {
    constexpr int mostSteps = 24;
    const double energy = this->LastEnergy;
    const double change = this->Change;
    this->BranchedAt = this->Now;
    this->BeginRefinement();
    for (int step = 0; step < mostSteps && !this->HasStalled(); ++step)
    {
      this->TryResilientStep();
    }
    this->BeginRefinement();
    this->Now = this->BranchedAt;
    this->BranchedAt = none;
    this->LastEnergy = energy;
    this->Change = change;
  }

  /// Several resilient steps. They begin at the last iterate, as one that clears much may be worth
  /// more in the end than one of a lower energy that clears little; where they end above the lowest
  /// energy, others begin at that. Returns the record of the best.
  IterationRecord Refine()
  {
    constexpr int stepsPerIteration = 7;
    constexpr int mostStepsAbove = 10;
    for (int step = 0; step < stepsPerIteration && !this->HasRefined(); ++step)
    {
      const bool isAbove = this->LowestRefined > this->Lowest.energy.Total();
      if (isAbove && (this->HasStalled() || this->Steps >= mostStepsAbove))
      {
        this->GoBack();
        this->BeginRefinement();
      }
      this->TryResilientStep();
    }
    return this->BestRecord();
  }

  /// The record of the best iterate, with the last change.
  IterationRecord BestRecord() const
  {
    IterationRecord record = this->Lowest;
    record.meanChange = this->Change;
    return record;
  }

  /// Makes the next resilient step the first one from the last iterate.
  void BeginRefinement()
  {
    this->IsRefining = false;
    this->StepsWithoutGain = 0;
    this->Steps = 0;
  }

  void TryResilientStep()
  {
    ++this->Steps;
    const double before = this->IsRefining ? this->LowestRefined : this->LastEnergy;
    const IterationRecord record = this->StepResiliently(0);
    const double energy = record.energy.Total();
    const bool gains =
      before - energy > leastGain * this->Given->settings.tolerance * std::abs(before);
    this->StepsWithoutGain = gains ? 0 : this->StepsWithoutGain + 1;
    this->LowestRefined = std::min(energy, before);
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
    const std::size_t free = this->FreeIterate();
    const float* last = this->Iterates[this->Now].values;
    limpid::Iterate<AnyDevice>& next = this->Iterates[free];
    PrepareIterate(this->Device, *this->Given, 1, last, next); // room alone
    if (!this->IsRefining)
    {
      this->Resilient.BeginAt(last);
      this->IsRefining = true;
    }
    const IterationRecord record = this->Resilient.Step(last, next.own.Data(), smoothing);
    this->Now = free;
    this->LastEnergy = record.energy.Total();
    this->Change = record.meanChange;
    this->LagBeside = nullptr;
    this->SeeLast.clear(); // derivatives leave no optical depths
    return record;
  }

  /// Than so many times what is tolerated.
  bool ChangesLess(double times) const
  {
    constexpr double little = 5; // change of the extinction, per tolerance
    const double tolerance = times * this->Given->settings.tolerance;
    const bool gains = this->Descent.EnergyChange() >= leastGain * tolerance;
    return this->Count >= this->MainTerms() && !this->Weighed &&
      this->Change < (gains ? 1 : little) * tolerance;
  }

  /// What an iteration sweeps.
  struct Turn
  {
    Term* swept;
    std::vector<Term*> others; ///< act with their derivatives at the last iterate
    Transmittance transmittance;
    bool weighs; ///< its clearing against its cost
    Reach reach;
    double smoothing = 0; ///< see PolicySweep [length]
  };

  /// How many terms are swept in turn: those of the cameras or, without one, the light's.
  int MainTerms() const { return std::max(1, int(this->Energy.cameras.size())); }

  Term& Main(int iteration)
  {
    return this->Energy.cameras.empty()
      ? *this->Energy.light
      : this->Energy.cameras[std::size_t(iteration % this->MainTerms())];
  }

  std::vector<Term*> AllBut(const Term& swept)
  {
    std::vector<Term*> others = this->Energy.All();
    others.erase(std::find(others.begin(), others.end(), &swept));
    return others;
  }

  /// The cameras are swept in turn, or the light without one. But each has a turn in which nothing
  /// is in its way: what is hidden from it must be able to say what it would gain.
  Turn TurnOf(int iteration)
  {
    const int round = this->MainTerms();
    const bool litBeside = !this->Energy.cameras.empty() && this->Energy.light;
    const bool returns = this->SweepLimit() > round + 1; // a camera has the last word
    const bool lightFirst = iteration == round && litBeside && returns && !this->Warm;
    Term& swept = lightFirst ? *this->Energy.light : this->Main(iteration);
    const bool first = lightFirst || iteration < round;
    return { &swept, this->AllBut(swept),
      first && !this->Warm ? Transmittance::AssumeOne : Transmittance::OfLastIterate,
      iteration < 3 * round && CanCostMoreThanItShows(*this->Given, this->Energy.WeightOf(swept)),
      first ? Reach::Unlimited : Reach::OfLastSweep };
  }

  Turn SmoothingTurn()
  {
    Term& swept = this->Main(this->Count++);
    return { &swept, this->AllBut(swept), Transmittance::OfLastIterate, false, Reach::OfLastSweep,
      this->Given->SmoothingStrength() };
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

  /// Goes back to the best iterate. Returns its record, with the change that was not made.
  IterationRecord GoBack()
  {
    this->Now = this->BestOf;
    this->LastEnergy = this->Lowest.energy.Total();
    this->LagBeside = nullptr;
    this->SeeLast.clear();
    return this->BestRecord();
  }

  /// A place for the next iterate that overwrites neither the last nor the best.
  std::size_t FreeIterate() const
  {
    std::size_t free = 0;
    while (free == this->Now || free == this->BestOf || free == this->BranchedAt)
    {
      ++free;
    }
    return free;
  }

  /// One policy sweep to the next iterate, and what that is worth.
  IterationRecord Advance(const Turn& turn)
  {
    const std::size_t free = this->FreeIterate();
    const float* last = this->Iterates[this->Now].values;
    limpid::Iterate<AnyDevice>& next = this->Iterates[free];
    this->Prepare(*turn.swept, last, next);
    const IterationRecord record = this->Sweep(turn, last, next.own.Data());
    this->Now = free;
    this->LastEnergy = record.energy.Total();
    this->Change = record.meanChange;
    this->Weighed = turn.weighs;
    return record;
  }

  /// See PrepareIterate.
  void Prepare(const Term& swept, const float* last, limpid::Iterate<AnyDevice>& next)
  {
    if constexpr (AnyDevice::readsHostMemory)
    {
      if (const TermsOnRanks* ranks = this->Energy.OnRanks())
      {
        PrepareIterate(this->Device, *this->Given, 1, last, next); // room alone
        if (swept.Frusta().size() > 1)
        {
          ranks->CopyNeeded(&swept.Frusta(), last, next.own.Data());
        }
        return;
      }
    }
    PrepareIterate(this->Device, *this->Given, swept.Frusta().size(), last, next);
  }

  IterationRecord Sweep(const Turn& turn, const float* last, float* next)
  {
    if (!this->Sees(*turn.swept))
    {
      this->Energy.MeasureTerm(*turn.swept, last);
    }
    const bool first = this->Count == 1 && turn.transmittance == Transmittance::AssumeOne;
    if (!first && this->LagBeside != turn.swept)
    {
      this->FindLagged(turn, last);
    }
    this->SweepOnce(turn, last, next);
    this->LagBeside = nullptr;
    this->SeeLast = { turn.swept };
    if (AnyDevice::readsHostMemory && this->SweepsSameNext(turn))
    {
      this->FindLagged(turn, next); // sees the next iterate along the way
    }
    else
    {
      for (Term* other : turn.others)
      {
        this->Energy.MeasureTerm(*other, next);
        this->SeeLast.push_back(other);
      }
    }
    return this->Energy.Record();
  }

  /// Whether the derivatives of the other terms by the next iterate will be needed. Waits: a device
  /// finds them when they are.
  bool SweepsSameNext(const Turn& turn)
  {
    const bool again = this->Count < this->SweepLimit() &&
      (turn.weighs || !(this->Energy.MeanChange() < this->Given->settings.tolerance));
    return this->MainTerms() == 1 &&
      (turn.smoothing > 0 || (again && this->TurnOf(this->Count).swept == turn.swept));
  }

  /// Whether a term's rays have the last iterate's optical depths.
  bool Sees(const Term& term) const
  {
    return std::find(this->SeeLast.begin(), this->SeeLast.end(), &term) != this->SeeLast.end();
  }

  void SweepOnce(const Turn& turn, const float* last, float* next)
  {
    ExactDifferences moved;
    const bool scored = this->Energy.IsOfCamera(*turn.swept) && this->Given->tellsScores;
    const Kept kept = scored ? Kept::Counted : Kept::Ignored;
    const bool afterCamera = this->Count > 1 &&
      std::any_of(turn.others.begin(), turn.others.end(),
        [this](const Term* other) { return this->Energy.IsOfCamera(*other); });
    const float* alternative = afterCamera ? last : this->Cheapest();
    SweepPolicy(*this->Device, *turn.swept, *this->Given, this->Energy.Fields(),
      { last, turn.smoothing > 0 ? this->FindPull(turn, last) : this->Lagged.Data(), next,
        this->Energy.WeightOf(*turn.swept), turn.transmittance, kept, this->Descent.Proximity(),
        turn.weighs ? alternative : nullptr, turn.reach, turn.smoothing, this->Energy.Previous(),
        this->SweepsEmphasise(), this->Energy.OnRanks() },
      moved);
    if constexpr (AnyDevice::readsHostMemory)
    {
      if (const TermsOnRanks* ranks = this->Energy.OnRanks())
      {
        moved.SumOver(ranks->Ranks());
        ranks->Share(next, &turn.swept->Frusta());
      }
      this->Energy.Sums()->moved = moved.Values();
    }
    else
    {
      this->Energy.TakeMoved(next, last);
    }
    this->Energy.TakeSeen(*turn.swept, kept);
  }

  /// What costs less to keep, the base or what was before.
  const float* Cheapest() const
  {
    const Problem& problem = *this->Given;
    return problem.CoherenceWeight() > problem.RegularizationWeight()
      ? this->Energy.Previous()
      : this->Energy.Fields().base.Data();
  }

  /// The pull of neighbours beside the derivative of the other terms.
  const float* FindPull(const Turn& turn, const float* last)
  {
    if (this->Pull.Empty())
    {
      this->Pull = DeviceArray<AnyDevice, float>::Zeros(
        this->Device, static_cast<std::size_t>(this->Given->grid.NodeCount()), "the pull");
    }
    this->Energy.Pass(this->Lagged.Data(), this->Lagged.Empty() ? nullptr : turn.swept, nullptr);
    limpid::FindPull(*this->Device,
      { this->Given->grid.nodes, this->Energy.Fields().base.Data(),
        this->Energy.Fields().importance.Data(), last, this->Lagged.Data(),
        static_cast<float>(turn.smoothing), this->Pull.Data() },
      this->Given->OwnSlab().slices);
    if constexpr (AnyDevice::readsHostMemory)
    {
      if (const TermsOnRanks* ranks = this->Energy.OnRanks())
      {
        ranks->Pass(this->Pull.Data(), TermsOnRanks::slabs, &turn.swept->Frusta());
      }
    }
    return this->Pull.Data();
  }

  /// The sum of the derivatives of all terms that are not swept.
  void FindLagged(const Turn& turn, const float* extinction)
  {
    const bool several = turn.others.size() > 1;
    if (turn.others.empty())
    {
      return;
    }
    if (several && !this->Lagged.Empty() && !this->Energy.OnRanks())
    {
      this->Lagged.SetZero();
    }
    else if (several || this->LagFilledBy != turn.others[0]) // each writes voxels of its own
    {
      this->Lagged = {};
      this->Lagged = DeviceArray<AnyDevice, float>::Zeros(this->Device,
        static_cast<std::size_t>(this->Given->grid.NodeCount()), "the lagged derivative");
    }
    const Term* before = nullptr;
    for (Term* other : turn.others)
    {
      this->Energy.Pass(this->Lagged.Data(), before, other);
      before = other;
      const float kept = several ? 1 : 0;
      this->Sees(*other)
        ? this->Energy.DifferentiateSeen(*other, extinction, kept, this->Lagged.Data())
        : this->Energy.DifferentiateTerm(*other, extinction, kept, this->Lagged.Data());
    }
    this->Energy.Pass(this->Lagged.Data(), before, turn.swept);
    this->SeeLast.erase(std::remove_if(this->SeeLast.begin(), this->SeeLast.end(),
                          [&turn](const Term* term) { return term != turn.swept; }),
      this->SeeLast.end()); // derivatives leave no optical depths
    this->LagFilledBy = several ? nullptr : turn.others[0];
    this->LagBeside = turn.swept;
  }

  static constexpr auto none = std::size_t(-1);
  static constexpr double leastGain = 0.1; ///< of an energy, per tolerance

  const Problem* Given;
  std::shared_ptr<AnyDevice> Device;
  Terms<AnyDevice> Energy;
  bool Warm;
  int Count = 0;
  double Change = 0;
  bool Weighed = false; ///< in the last iteration, which is not stationary then
  ProximalDescent Descent;
  ResilientDescent<AnyDevice> Resilient;
  bool IsRefining = false; ///< whether resilient steps go on from the last iterate
  bool IsSmoothing = false;
  int Steps = 0;                    ///< resilient steps since they began
  int StepsWithoutGain = 0;         ///< resilient steps since the last one that was worth it
  double LowestRefined = 0;         ///< energy of resilient steps since they began
  double LastEnergy = 0;            ///< of the last iterate
  IterationRecord Lowest;           ///< of the best iterate
  std::vector<const Term*> SeeLast; ///< those whose rays have the last iterate's optical depths
  std::array<limpid::Iterate<AnyDevice>, 4> Iterates; ///< filled as needed
  std::size_t Now = 0;                                ///< the last iterate
  std::size_t BranchedAt = none;                      ///< where a descent began
  std::size_t BestOf = 0;                             ///< the best
  DeviceArray<AnyDevice, float> Lagged; ///< derivative of the terms not swept; empty: none
  const Term* LagFilledBy = nullptr;    ///< the one term that it is of
  const Term* LagBeside = nullptr;      ///< the swept term if it is at the last iterate
  DeviceArray<AnyDevice, float> Pull;   ///< that less the pull of neighbours; empty: not needed
  mutable std::vector<float> OnHost;    ///< the best; empty: not read yet
};
}

template <class AnyDevice>
std::unique_ptr<Minimizer> MakePolicy(const std::shared_ptr<AnyDevice>& device,
  const Problem& problem, const StartingExtinction& start, bool warm)
{
  return std::make_unique<Policy<AnyDevice>>(device, problem, start, warm);
}

#define LIMPID_INSTANTIATE_POLICY(AnyDevice)                                                       \
  template std::unique_ptr<Minimizer> MakePolicy(                                                  \
    const std::shared_ptr<AnyDevice>&, const Problem&, const StartingExtinction&, bool);
LIMPID_FOR_EACH_COMPILED_DEVICE(LIMPID_INSTANTIATE_POLICY)
}
