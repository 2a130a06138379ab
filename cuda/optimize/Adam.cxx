// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Adam.h"

#include "backend/Backend.h"
#include "backend/LargePages.h"
#include "energy/NodeImportance.h"
#include "optimize/ExtinctionBounds.h"
#include "optimize/Levels.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace limpid
{
namespace
{
/// The problem on one resolution and Adam's state there.
struct Level
{
  int number = 0; ///< 0 full, 1 half, 2 quarter resolution
  Problem problem;
  std::vector<float> baseStorage; ///< empty on the full resolution
  std::vector<float> importanceStorage;
  std::vector<float> nodeImportanceStorage;
  std::vector<float> previousStorage;
  std::unique_ptr<AdamLevel> state;
  int count = 0; ///< of steps
};

/// The source as seen from a grid over the same box with other nodes.
RaySource Rescaled(const RaySource& source, const Grid& from, const Grid& to)
{
  RaySource other = source;
  const Vec3 scale = from.spacing / to.spacing;
  other.origin = source.origin * scale;
  other.direction = source.direction * scale;
  for (RaySource::Plane& plane : other.viewPlanes)
  {
    plane.normal = plane.normal / scale;
  }
  return other;
}

class Adam : public Minimizer
{
public:
  Adam(const Problem& problem, std::vector<float> start, bool fromBase, AdamLevelMaker maker,
    SuccessorMaker smoother)
    : Given(problem)
    , FromBase(fromBase)
    , Maker(std::move(maker))
    , SmootherMaker(std::move(smoother))
    , Remaining(problem.settings.iterationsPerLevel)
    , BestIterate(std::move(start))
  {
  }

  IterationRecord Start() override
  {
    // The base is measured where the user sees it, on the full resolution.
    this->Enter(0, std::vector<float>(this->BestIterate));
    const IterationRecord record =
      this->FromBase ? this->Here->state->MeasureBase() : this->Here->state->Measure();
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

  std::vector<float> ExtinctionOn(int level) const
  {
    const Grid target =
      level == 0 ? this->Given.grid : CoarseGrid(this->Given.grid, level == 1 ? 2 : 4);
    return this->Here->number > level
      ? this->FromCoarser(target)
      : Restrict(this->Given.grid, this->BestIterate.data(), target);
  }

  /// What the coarser level changed, added to the finer base: detail of the base survives, and
  /// voxels that nothing asked to change keep their base bit by bit.
  std::vector<float> FromCoarser(const Grid& target) const
  {
    const Level& coarse = *this->Here;
    const std::vector<float> found = coarse.state->Extinction();
    std::vector<float> change(found.size());
    ParallelFor(static_cast<Index>(change.size()), 65536,
      [&](Index voxel) {
        change[std::size_t(voxel)] =
          found[std::size_t(voxel)] - coarse.problem.baseExtinction[voxel];
      });
    std::vector<float> extinction = Prolong(coarse.problem.grid, change.data(), target);
    const bool full = target.nodes == this->Given.grid.nodes;
    const std::vector<float> coarseBase =
      full ? std::vector<float>() : Restrict(this->Given.grid, this->Given.baseExtinction, target);
    const std::vector<float> coarseImportance =
      full ? std::vector<float>() : Restrict(this->Given.grid, this->Given.importance, target);
    const float* baseField = full ? this->Given.baseExtinction : coarseBase.data();
    const float* importanceField = full ? this->Given.importance : coarseImportance.data();
    const ExtinctionBounds<float> bounds = BoundsOf(this->Given);
    ParallelFor(static_cast<Index>(extinction.size()), 65536,
      [&](Index voxel)
      {
        float& value = extinction[std::size_t(voxel)];
        const float base = baseField[voxel];
        const float importance = importanceField[voxel];
        const bool empty = !(base > 0) && !(importance > 0);
        value = empty ? 0.0f : bounds.Clamp(base + value, importance, base);
      });
    return extinction;
  }

  void Enter(int number, const std::vector<float>& extinction)
  {
    this->Here = std::make_unique<Level>();
    Level& here = *this->Here;
    here.number = number;
    here.problem = this->Given;
    if (number > 0)
    {
      here.problem.grid = CoarseGrid(this->Given.grid, number == 1 ? 2 : 4);
      here.problem.resident = nullptr; // these fields are the level's own
      here.baseStorage = Restrict(this->Given.grid, this->Given.baseExtinction, here.problem.grid);
      here.importanceStorage =
        Restrict(this->Given.grid, this->Given.importance, here.problem.grid);
      here.problem.baseExtinction = here.baseStorage.data();
      here.nodeImportanceStorage = NodeImportanceOfFilled(
        here.problem.grid, here.baseStorage.data(), here.importanceStorage.data());
      here.problem.importance = here.importanceStorage.data();
      here.problem.nodeImportance = here.nodeImportanceStorage.data();
      if (this->Given.previous)
      {
        here.previousStorage = Restrict(this->Given.grid, this->Given.previous, here.problem.grid);
        here.problem.previous = here.previousStorage.data();
      }
      here.problem.camera = Rescaled(this->Given.camera, this->Given.grid, here.problem.grid);
      for (RaySource& other : here.problem.otherCameras)
      {
        other = Rescaled(other, this->Given.grid, here.problem.grid);
      }
      here.problem.light = Rescaled(this->Given.light, this->Given.grid, here.problem.grid);
      here.problem.occupancy =
        std::make_shared<const Occupancy>(here.problem.grid, here.problem.baseExtinction,
          here.problem.nodeImportance, here.problem.settings.skipUnneeded);
    }
    here.state = this->Maker(here.problem, extinction);
  }

  const Problem& Given;
  bool FromBase; ///< whether the iterations start there
  AdamLevelMaker Maker;
  SuccessorMaker SmootherMaker;
  std::unique_ptr<Minimizer> Smoother; ///< null: nothing was smoothed yet
  std::array<int, 3> Remaining;        ///< iterations left: quarter, half, full
  std::unique_ptr<Level> Here;
  double Change = 0;
  double BestEnergy = 0;
  Score Base;
  std::vector<float> BestIterate; ///< before there was a better one
  bool BestIsHere = false;        ///< whether that is with the level
};
}

std::unique_ptr<Minimizer> MakeAdam(const Problem& problem, std::vector<float>&& start,
  const AdamLevelMaker& maker, const SuccessorMaker& smoother)
{
  const bool fromBase = start.empty();
  if (fromBase)
  {
    start = RoomFor(problem.grid.NodeCount());
    start.assign(problem.baseExtinction, problem.baseExtinction + problem.grid.NodeCount());
  }
  return std::make_unique<Adam>(problem, std::move(start), fromBase, maker, smoother);
}
}
