// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled for each device, see CompiledDevice.h.

#include "optimize/Policy.h"

#include "optimize/LaggedDerivative.h"
#include "optimize/PolicyRefinement.h"
#include "optimize/PolicyTurns.h"
#include "optimize/ProximalDescent.h"

#include <algorithm>
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
    , Iterates(device, static_cast<std::size_t>(problem.grid.NodeCount()),
        this->Energy.Fields().base.Data())
    , Refinement(device, problem, this->Energy, this->Iterates, warm)
  {
    if (start)
    {
      this->Iterates.Put(this->Iterates.LastSlot(), this->Energy.Everywhere(*start));
    }
  }

  IterationRecord Start() override
  {
    const IterationRecord first = this->MeasureFirst();
    this->Iterates.Begin(first);
    for (const Term& term : this->Energy.all)
    {
      this->Seeing.Add(term);
    }
    this->Proximal.BeginAt(first.energy.Total());
    return first;
  }

  Score BaseScore() const override { return this->Energy.BaseScore(); }

  IterationRecord Iterate() override
  {
    [[maybe_unused]] const typename AnyDevice::Team team;
    this->Readable.Outdate();
    if (this->Refines())
    {
      this->Lagged.Clear(); // steps have fields of their own
      this->Iterates.FreeAllButLastAndBest();
      const IterationRecord record = this->Refinement.Refine();
      this->ForgetLast();
      return record;
    }
    if (this->DescendsFromFirstSweeps() && this->Count == 0)
    {
      this->DescendFromLast();
    }
    const Turn turn = this->Turns.Of(this->Count++);
    const IterationRecord record = this->Advance(turn);
    const double energy = record.energy.Total();
    if (turn.transmittance == Transmittance::AssumeOne)
    {
      this->Proximal.BeginAt(energy);
    }
    else if (!this->Proximal.Keeps(energy, this->Iterates.LowestEnergy()))
    {
      this->GoBack();
      return this->Iterates.BestRecord(); // with the change that was rejected
    }
    this->Iterates.KeepLastIfLowest(record);
    if (this->DescendsFromFirstSweeps() && this->Count == this->Turns.MainTerms())
    {
      this->DescendFromLast();
    }
    return this->Refinement.DescendsFromBase() ? this->Iterates.BestRecord() : record;
  }

  IterationRecord Smooth() override
  {
    [[maybe_unused]] const typename AnyDevice::Team team;
    this->Readable.Outdate();
    if (!this->Iterates.IsAtBest())
    {
      this->GoBack();
    }
    IterationRecord record;
    if (this->Given->IsThick())
    {
      record = this->Refinement.Smooth();
      this->ForgetLast();
    }
    else
    {
      record = this->Advance(this->Turns.Smoothing(this->Count++));
    }
    record.isResult = true;
    this->Iterates.KeepLast();
    return record;
  }

  bool Converged() const override
  {
    return this->Given->IsThick() ? this->Refinement.IsDone() && this->Given->settings.tolerance > 0
                                  : this->ChangesLess(1);
  }

  bool IsNear() const override
  {
    constexpr double nearness = 10;
    return this->Given->IsThick() ? this->Refinement.IsDone() : this->ChangesLess(nearness);
  }

  int IterationLimit() const override { return this->Turns.IterationLimit(); }

  void BestToPiece(const FieldView& piece) const override
  {
    this->Energy.Distribution().ToPiece(this->Iterates.Best(), piece);
  }

  const float* BestValues() const override
  {
    return AnyDevice::readsHostMemory ? this->Iterates.Best() : this->Best().data();
  }

  const std::vector<float>& Best() const override
  {
    return this->Readable.Of(*this->Device, this->Iterates.Best(), this->Given->grid.NodeCount());
  }

  void KeepOnlyBest() override
  {
    this->Iterates.FreeAllButBest();
    this->Lagged.Clear();
    this->Refinement.Clear();
  }

  std::vector<float> TakeBest() override
  {
    this->KeepOnlyBest();
    this->Best();
    return this->Readable.Take();
  }

  ExtinctionOnDevice BestOnDevice() const override
  {
    return PlaceOnDevice(this->Energy.Fields(), this->Iterates.Best());
  }

  FoundExtinction TakeResult() override
  {
    return TakeResultOf(
      *this, this->Device, this->Energy.SharedFields(), this->Iterates.TakeBest());
  }

private:
  using Term = EnergyTerm<AnyDevice>;
  using Turn = PolicyTurn<AnyDevice>;
  using Slot = typename PolicyIterates<AnyDevice>::Slot;

  /// Returns whether policy sweeps may also raise extinction. In thick media they may not, since
  /// raised extinction hides more than a sweep accounts for; there, resilient steps raise what the
  /// sweeps have cleared. The initial extinction or the reference may already exceed the base,
  /// however.
  bool SweepsEmphasise() const
  {
    return this->Warm || IsHardlyThick(*this->Given) || !this->Given->furtherPulls.empty();
  }

  /// Returns whether policy sweeps have converged, so that resilient steps follow.
  bool Refines() const
  {
    return this->Given->IsThick() &&
      (this->Refinement.IsUnderWay() || this->ChangesLess(1) ||
        this->Count >= this->Turns.SweepLimit());
  }

  /// Returns whether to descend from the base and from the result of the first sweeps; both happen
  /// before further sweeps.
  bool DescendsFromFirstSweeps() const
  {
    return this->Refinement.DescendsFromBase() && this->Given->IsSmall();
  }

  void DescendFromLast()
  {
    this->Refinement.DescendFromLast();
    this->ForgetLast();
  }

  /// Returns whether the last change was below this multiple of the tolerance.
  bool ChangesLess(double times) const
  {
    constexpr double little = 5; // change of the extinction, in units of the tolerance
    const double tolerance = times * this->Given->settings.tolerance;
    const bool gains = this->Proximal.EnergyChange() >= DescentProgress::leastGain * tolerance;
    return this->Count >= this->Turns.MainTerms() && !this->Weighed &&
      this->Iterates.Change() < (gains ? 1 : little) * tolerance;
  }

  IterationRecord MeasureFirst()
  {
    if (this->Iterates.IsAtBase())
    {
      return this->Energy.MeasureBase();
    }
    this->Energy.SeeBase();
    return this->Energy.Measure(this->Iterates.Last());
  }

  /// Returns to the best iterate.
  void GoBack()
  {
    this->Iterates.GoBack();
    this->ForgetLast();
  }

  /// Forgets what is known of the last iterate, after it became another one without a sweep.
  void ForgetLast()
  {
    this->Lagged.Outdate();
    this->Seeing.Clear(); // derivatives do not store optical depths
  }

  /// Makes a policy sweep to the next iterate, and returns its record.
  IterationRecord Advance(const Turn& turn)
  {
    const Slot slot = this->Iterates.Free();
    const bool isNew = this->Iterates.Allocate(slot);
    const float* last = this->Iterates.Last();
    float* next = this->Iterates.Writable(slot);
    // Where sweeps do not write it, and where rays meet voxels of a frustum that is swept later,
    // the next iterate has the values of the last one.
    this->Energy.Distribution().CopyUnswept(
      turn.swept->Number(), turn.swept->Frusta().size(), isNew, last, next);
    this->LookBefore(turn, last);
    this->Sweep(turn, last, next);
    this->LookAfter(turn, next);
    const IterationRecord record = this->Energy.Record();
    this->Iterates.MoveTo(slot, record);
    this->Weighed = turn.weighs;
    return record;
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

  const Problem* Given;
  std::shared_ptr<AnyDevice> Device;
  Terms<AnyDevice> Energy;
  bool Warm;
  PolicyTurns<AnyDevice> Turns;
  int Count = 0;        ///< number of sweeps
  bool Weighed = false; ///< whether the last iteration changed weights; it is not stationary then
  ProximalDescent Proximal;
  TermsThatSee<AnyDevice> Seeing;
  LaggedDerivative<AnyDevice> Lagged;
  PolicyIterates<AnyDevice> Iterates;
  PolicyRefinement<AnyDevice> Refinement;
  mutable FieldOnHost Readable; ///< the best iterate
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
