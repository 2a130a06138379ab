// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Adam.h"

#include "backend/Backend.h"
#include "backend/LargePages.h"
#include "optimize/CoarseProblem.h"
#include "scene/Resampling.h"

#include <numeric>
#include <utility>

namespace limpid
{
namespace
{
/// The problem at one resolution and Adam's state there.
struct Level
{
  int number = 0;                        ///< 0: full, 1: half, 2: quarter resolution
  std::unique_ptr<CoarseProblem> coarse; ///< null at full resolution
  std::unique_ptr<AdamLevel> state;
  int count = 0; ///< number of steps
};

class Adam : public Minimizer
{
public:
  Adam(const Problem& problem, StartingExtinction&& start, AdamLevelMaker maker,
    SuccessorMaker smoother)
    : Given(problem)
    , First(std::move(start))
    , Maker(std::move(maker))
    , SmootherMaker(std::move(smoother))
    , Remaining(problem.settings.iterationsPerLevel)
  {
  }

  IterationRecord Start() override
  {
    // The base is measured at full resolution, as shown to the user.
    this->Enter(0, this->First);
    const IterationRecord record =
      this->First ? this->Here->state->Measure() : this->Here->state->MeasureBase();
    this->BestIterate = this->First ? *std::exchange(this->First, {}) : this->OwnBase();
    this->BestEnergy = record.energy.Total();
    this->Base = this->Here->state->BaseScore();
    return record;
  }

  Score BaseScore() const override { return this->Base; }

  IterationRecord Iterate() override
  {
    const int wanted = this->NextLevel();
    if (wanted != this->Here->number)
    {
      this->Enter(wanted, this->ExtinctionOn(wanted));
    }
    --this->Remaining[std::size_t(2 - wanted)];
    IterationRecord record = this->Here->state->Step(++this->Here->count);
    this->Change = record.meanChange;
    record.level = this->Here->number;
    if (this->Here->number == 0 && record.energy.Total() < this->BestEnergy)
    {
      this->BestEnergy = record.energy.Total();
      this->Here->state->KeepBest();
      this->BestIsHere = true;
    }
    return record;
  }

  IterationRecord Smooth() override
  {
    if (!this->Smoother)
    {
      this->Smoother = this->SmootherMaker(this->TakeBest());
      this->Smoother->Start();
    }
    return this->Smoother->Smooth();
  }

  bool Converged() const override
  {
    return this->Here->number == 0 && this->Here->count > 0 && this->Remaining[0] == 0 &&
      this->Remaining[1] == 0 && this->Change < this->Given.settings.tolerance;
  }

  int IterationLimit() const override
  {
    const std::array<int, 3>& limits = this->Given.settings.iterationsPerLevel;
    return std::accumulate(limits.begin(), limits.end(), 0);
  }

  const std::vector<float>& Best() const override
  {
    return this->Smoother ? this->Smoother->Best()
      : this->BestIsHere  ? this->Here->state->Best()
                          : this->BestIterate;
  }

  void BestToPiece(const FieldView& piece) const override
  {
    if (this->Smoother)
    {
      this->Smoother->BestToPiece(piece);
      return;
    }
    this->Given.SlabToPiece(this->Best().data(), piece);
  }

  std::vector<float> TakeBest() override
  {
    if (this->Smoother)
    {
      return this->Smoother->TakeBest();
    }
    return this->BestIsHere ? this->Here->state->TakeBest() : std::move(this->BestIterate);
  }

private:
  int NextLevel() const { return this->Remaining[0] > 0 ? 2 : (this->Remaining[1] > 0 ? 1 : 0); }

  static int FactorOf(int level) { return level == 1 ? 2 : 4; }

  Grid GridOf(int level) const
  {
    return level == 0 ? this->Given.grid : CoarseGrid(this->Given.grid, FactorOf(level));
  }

  /// Returns the base extinction of the owned slab.
  std::vector<float> OwnBase() const
  {
    const Slab own = this->Given.OwnSlab();
    const float* base = this->Given.baseExtinction + own.Begin();
    std::vector<float> values = RoomFor(own.Count());
    values.assign(base, base + own.Count());
    return values;
  }

  std::vector<float> ExtinctionOn(int level) const
  {
    const Grid target = this->GridOf(level);
    return this->Here->number > level
      ? this->Here->coarse->ChangedOn(target, this->Here->state->Extinction())
      : MovedTo(this->Given, this->Given.grid, this->BestIterate.data(), target);
  }

  void Enter(int number, const StartingExtinction& extinction)
  {
    this->Here = std::make_unique<Level>();
    Level& here = *this->Here;
    here.number = number;
    if (number > 0)
    {
      here.coarse = std::make_unique<CoarseProblem>(this->Given, FactorOf(number));
    }
    here.state = this->Maker(number > 0 ? here.coarse->Made() : this->Given, extinction);
  }

  const Problem& Given;
  StartingExtinction First; ///< moved out when the first level is entered
  AdamLevelMaker Maker;
  SuccessorMaker SmootherMaker;
  std::unique_ptr<Minimizer> Smoother; ///< null until the first smoothing
  std::array<int, 3> Remaining;        ///< iterations left at quarter, half and full resolution
  std::unique_ptr<Level> Here;
  double Change = 0;
  double BestEnergy = 0;
  Score Base;
  std::vector<float> BestIterate; ///< unless the best one is held by the level
  bool BestIsHere = false;        ///< whether the best iterate is held by the level
};
}

std::unique_ptr<Minimizer> MakeAdam(const Problem& problem, StartingExtinction&& start,
  const AdamLevelMaker& maker, const SuccessorMaker& smoother)
{
  return std::make_unique<Adam>(problem, std::move(start), maker, smoother);
}
}
