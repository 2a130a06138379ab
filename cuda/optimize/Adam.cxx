// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Adam.h"

#include "backend/Backend.h"
#include "backend/LargePages.h"
#include "energy/NodeImportance.h"
#include "optimize/ExtinctionBounds.h"
#include "optimize/FieldsOfRanks.h"
#include "optimize/Levels.h"
#include "optimize/Neighbourhood.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace limpid
{
namespace
{
/// The problem on one resolution and Adam's state there.
struct Level
{
  int number = 0; ///< 0 full, 1 half, 2 quarter resolution
  Problem problem;
  std::vector<float> base; ///< the fields; empty on the full resolution
  std::vector<float> importance;
  std::vector<float> nodeImportance;
  std::vector<float> previous;
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
    // The base is measured where the user sees it, on the full resolution.
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
    const FieldsOfRanks& fields = *this->Given.shared;
    const Slab own = this->Given.OwnSlab();
    Spread(*fields.ranks, FieldView::Part(const_cast<float*>(this->Best().data()), own.Box()),
      RegionsOf(SlabsOf(*fields.ranks, own.nodes)), piece, fields.wanted,
      this->Given.occupancy.get());
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

  Grid GridOf(int level) const
  {
    return level == 0 ? this->Given.grid : CoarseGrid(this->Given.grid, level == 1 ? 2 : 4);
  }

  /// A field on another grid; where ranks share the problem, this rank's slab from its slab.
  std::vector<float> Moved(const Grid& from, const float* field, const Grid& to) const
  {
    if (!this->Given.shared)
    {
      return Resampled(from, field, to);
    }
    const Communicator& ranks = *this->Given.shared->ranks;
    return ResampledBox(ranks, from,
      FieldView::Part(const_cast<float*>(field), OwnSlab(ranks, from.nodes).Box()),
      SlabsOf(ranks, from.nodes), to, SlabsOf(ranks, to.nodes));
  }

  /// A field of the problem there, of the full resolution.
  std::vector<float> Restricted(const float* field, const Grid& to) const
  {
    return this->Moved(this->Given.grid, field + this->Given.OwnSlab().Begin(), to);
  }

  /// The base extinction of this rank's slab.
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
      ? this->FromCoarser(target)
      : this->Moved(this->Given.grid, this->BestIterate.data(), target);
  }

  /// What the coarser level changed, added to the finer base: detail of the base survives, and
  /// voxels that nothing asked to change keep their base bit by bit.
  std::vector<float> FromCoarser(const Grid& target) const
  {
    const Level& coarse = *this->Here;
    const std::vector<float> found = coarse.state->Extinction();
    std::vector<float> change(found.size());
    const float* coarser = coarse.problem.baseExtinction + coarse.problem.OwnSlab().Begin();
    ParallelFor(static_cast<Index>(change.size()), 65536,
      [&](Index voxel)
      { change[std::size_t(voxel)] = found[std::size_t(voxel)] - coarser[voxel]; });
    std::vector<float> extinction = this->Moved(coarse.problem.grid, change.data(), target);
    const bool full = target.nodes == this->Given.grid.nodes;
    const std::vector<float> coarseBase =
      full ? std::vector<float>() : this->Restricted(this->Given.baseExtinction, target);
    const std::vector<float> coarseImportance =
      full ? std::vector<float>() : this->Restricted(this->Given.importance, target);
    const Index begin = this->Given.OwnSlab().Begin();
    const float* baseField = full ? this->Given.baseExtinction + begin : coarseBase.data();
    const float* importanceField = full ? this->Given.importance + begin : coarseImportance.data();
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

  void Enter(int number, const StartingExtinction& extinction)
  {
    this->Here = std::make_unique<Level>();
    Level& here = *this->Here;
    here.number = number;
    here.problem = this->Given;
    if (number > 0)
    {
      this->MakeCoarse(here);
    }
    here.state = this->Maker(here.problem, extinction);
  }

  /// The problem on the grid of a coarse level.
  void MakeCoarse(Level& level) const
  {
    const Problem& given = this->Given;
    Problem& problem = level.problem;
    problem.grid = this->GridOf(level.number);
    problem.resident = nullptr; // these fields are the level's own
    level.base = this->Restricted(given.baseExtinction, problem.grid);
    level.importance = this->Restricted(given.importance, problem.grid);
    if (given.previous)
    {
      level.previous = this->Restricted(given.previous, problem.grid);
    }
    given.shared ? this->ShareFields(level) : this->UseFields(level);
    problem.camera = Rescaled(given.camera, given.grid, problem.grid);
    for (RaySource& other : problem.otherCameras)
    {
      other = Rescaled(other, given.grid, problem.grid);
    }
    problem.light = Rescaled(given.light, given.grid, problem.grid);
  }

  static void UseFields(Level& level)
  {
    Problem& problem = level.problem;
    level.nodeImportance =
      NodeImportanceOfFilled(problem.grid, level.base.data(), level.importance.data());
    problem.baseExtinction = level.base.data();
    problem.importance = level.importance.data();
    problem.nodeImportance = level.nodeImportance.data();
    problem.previous = level.previous.empty() ? nullptr : level.previous.data();
    problem.occupancy = std::make_shared<const Occupancy>(
      problem.grid, problem.baseExtinction, problem.nodeImportance, problem.settings.skipUnneeded);
  }

  /// The same where each rank has a slab of the fields.
  static void ShareFields(Level& level)
  {
    Problem& problem = level.problem;
    const std::shared_ptr<const Communicator> ranks = problem.shared->ranks;
    const bool staysNear = problem.previous != nullptr;
    const std::vector<NodeBox> slabs = SlabsOf(*ranks, problem.grid.nodes);
    const NodeBox own = slabs[std::size_t(ranks->Rank())];
    const Neighbourhood around(*ranks, problem.grid, slabs, slabs);
    const NodeValues bases = around.Extended(level.base.data());
    const NodeValues importances = around.Extended(level.importance.data());
    const NodeValues nodeImportance = around.Inside(
      NodeImportanceOfFilled(around.Around(), bases.Data(), importances.Data()).data());
    level.nodeImportance.assign(nodeImportance.Data(), nodeImportance.Data() + own.Count());
    const auto fieldOf = [&](std::vector<float>& values)
    {
      return FieldsOfRanks::Field{ FieldView::Part(values.data(), own),
        NodeValues(problem.grid.NodeCount()) };
    };
    const auto fields = std::make_shared<FieldsOfRanks>();
    fields->ranks = ranks;
    fields->pieces = RegionsOf(slabs);
    fields->inSlabs = true;
    fields->places = problem.shared->places;
    fields->base = fieldOf(level.base);
    fields->importance = fieldOf(level.importance);
    fields->nodeImportance = fieldOf(level.nodeImportance);
    if (staysNear)
    {
      fields->previous = fieldOf(level.previous);
    }
    problem.Use(fields);
    problem.occupancy = std::make_shared<const Occupancy>(*ranks, problem.grid, own,
      level.base.data(), level.nodeImportance.data(), problem.settings.skipUnneeded);
  }

  const Problem& Given;
  StartingExtinction First; ///< until it is entered
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

std::unique_ptr<Minimizer> MakeAdam(const Problem& problem, StartingExtinction&& start,
  const AdamLevelMaker& maker, const SuccessorMaker& smoother)
{
  return std::make_unique<Adam>(problem, std::move(start), maker, smoother);
}
}
