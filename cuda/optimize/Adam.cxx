// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Adam.h"

#include "energy/NodeImportance.h"
#include "optimize/AdamVoxel.h"
#include "optimize/Levels.h"
#include "optimize/Sums.h"
#include "optimize/Terms.h"

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
  Problem task;
  std::vector<float> baseStorage; ///< empty on the full resolution
  std::vector<float> importanceStorage;
  std::vector<float> nodeImportanceStorage;
  Terms terms;
  std::vector<float> extinction;
  std::vector<float> gradient;
  std::vector<float> first;
  std::vector<float> second;
  Index filledVoxels = 0;
  int count = 0;
};

/// The eye as seen from a grid over the same box with other nodes.
Eye Rescaled(const Eye& eye, const Grid& from, const Grid& to)
{
  Eye other = eye;
  const Vec3 scale = from.spacing / to.spacing;
  other.origin = eye.origin * scale;
  other.direction = eye.direction * scale;
  for (Eye::Plane& plane : other.frustum)
  {
    plane.normal = plane.normal / scale;
  }
  return other;
}

LIMPID_MULTIVERSION
void StepRange(const AdamVoxel<float>& body, Index begin, Index end)
{
  const AdamVoxel<float> voxel = body;
#pragma GCC ivdep
  for (Index i = begin; i < end; ++i)
  {
    voxel(i);
  }
}

/// A step in [begin, end). Returns the sum of the changes [1/length].
double StepBlock(const AdamVoxel<float>& body, Index begin, Index end)
{
  constexpr Index chunk = 1024;
  float before[chunk];
  double sum = 0;
  for (Index first = begin; first < end; first += chunk)
  {
    const Index last = std::min(first + chunk, end);
    std::copy(body.extinction + first, body.extinction + last, before);
    StepRange(body, first, last);
    sum += SumOfChanges(body.extinction + first, before, last - first);
  }
  return sum;
}

class Adam : public Minimizer
{
public:
  Adam(const Problem& problem, std::vector<float> start)
    : Task(problem)
    , Remaining(problem.settings.iterationsPerLevel)
    , BestIterate(std::move(start))
  {
  }

  IterationRecord Start() override
  {
    // The base is measured where the user sees it, on the full resolution.
    std::vector<float> start = this->BestIterate;
    this->Enter(0, std::move(start));
    const IterationRecord record = this->Here.terms.Measure(this->Here.task, this->Here.extinction);
    this->BestEnergy = record.energy.Total();
    return record;
  }

  IterationRecord Iterate() override
  {
    const int wanted = this->NextLevel();
    if (wanted != this->Here.number || this->Here.gradient.empty())
    {
      this->Enter(wanted, this->ExtinctionOn(wanted));
      this->Here.gradient.assign(this->Here.extinction.size(), 0.0f);
      this->Here.first = this->Here.gradient;
      this->Here.second = this->Here.gradient;
      this->Here.terms.Measure(this->Here.task, this->Here.extinction);
    }
    --this->Remaining[std::size_t(2 - wanted)];
    this->Step();
    IterationRecord record = this->Here.terms.Measure(this->Here.task, this->Here.extinction);
    record.meanChange = this->Change;
    record.level = this->Here.number;
    if (this->Here.number == 0 && record.energy.Total() < this->BestEnergy)
    {
      this->BestEnergy = record.energy.Total();
      this->BestIterate = this->Here.extinction;
    }
    return record;
  }

  bool Converged() const override
  {
    return this->Here.number == 0 && this->Here.count > 0 && this->Remaining[0] == 0 &&
      this->Remaining[1] == 0 && this->Change < this->Task.settings.tolerance;
  }

  int IterationLimit() const override
  {
    const std::array<int, 3>& limits = this->Task.settings.iterationsPerLevel;
    return std::accumulate(limits.begin(), limits.end(), 0);
  }

  const std::vector<float>& Best() const override { return this->BestIterate; }

  std::vector<float> TakeBest() override { return std::move(this->BestIterate); }

private:
  int NextLevel() const { return this->Remaining[0] > 0 ? 2 : (this->Remaining[1] > 0 ? 1 : 0); }

  std::vector<float> ExtinctionOn(int level) const
  {
    const Grid target =
      level == 0 ? this->Task.grid : CoarseGrid(this->Task.grid, level == 1 ? 2 : 4);
    if (this->Here.number > level)
    {
      return this->FromCoarser(target);
    }
    return level == this->Here.number ? this->Here.extinction
                                      : Restrict(this->Task.grid, this->BestIterate.data(), target);
  }

  /// What the coarser level changed, added to the finer base: detail of the base survives, and
  /// voxels that nothing asked to change keep their base bit by bit.
  std::vector<float> FromCoarser(const Grid& target) const
  {
    const Level& coarse = this->Here;
    std::vector<float> change(coarse.extinction.size());
    ParallelFor(static_cast<Index>(change.size()), 65536,
      [&](Index voxel)
      {
        change[std::size_t(voxel)] =
          coarse.extinction[std::size_t(voxel)] - coarse.task.baseExtinction[voxel];
      });
    std::vector<float> extinction = Prolong(coarse.task.grid, change.data(), target);
    const bool full = target.nodes == this->Task.grid.nodes;
    const std::vector<float> base =
      full ? std::vector<float>() : Restrict(this->Task.grid, this->Task.baseExtinction, target);
    const std::vector<float> importance =
      full ? std::vector<float>() : Restrict(this->Task.grid, this->Task.importance, target);
    const float* baseField = full ? this->Task.baseExtinction : base.data();
    const float* importanceField = full ? this->Task.importance : importance.data();
    const float majorant = this->Task.majorant;
    ParallelFor(static_cast<Index>(extinction.size()), 65536,
      [&](Index voxel)
      {
        float& value = extinction[std::size_t(voxel)];
        const bool empty = !(baseField[voxel] > 0) && !(importanceField[voxel] > 0);
        value = empty ? 0.0f : std::min(std::max(baseField[voxel] + value, 0.0f), majorant);
      });
    return extinction;
  }

  void Enter(int number, std::vector<float> extinction)
  {
    this->Here = Level();
    Level& here = this->Here;
    here.number = number;
    here.task = this->Task;
    here.extinction = std::move(extinction);
    if (number > 0)
    {
      here.task.grid = CoarseGrid(this->Task.grid, number == 1 ? 2 : 4);
      here.baseStorage = Restrict(this->Task.grid, this->Task.baseExtinction, here.task.grid);
      here.importanceStorage = Restrict(this->Task.grid, this->Task.importance, here.task.grid);
      here.task.baseExtinction = here.baseStorage.data();
      here.nodeImportanceStorage = NodeImportanceOfFilled(
        here.task.grid, here.baseStorage.data(), here.importanceStorage.data());
      here.task.importance = here.importanceStorage.data();
      here.task.nodeImportance = here.nodeImportanceStorage.data();
      here.task.camera = Rescaled(this->Task.camera, this->Task.grid, here.task.grid);
      here.task.light = Rescaled(this->Task.light, this->Task.grid, here.task.grid);
      here.task.occupancy = std::make_shared<const Occupancy>(here.task.grid,
        here.task.baseExtinction, here.task.nodeImportance, here.task.settings.skipUnneeded);
    }
    here.filledVoxels = here.task.occupancy->FilledVoxels();
    here.terms = Terms(here.task);
  }

  void Step()
  {
    Level& here = this->Here;
    const Settings& settings = here.task.settings;
    const TermFields fields{ here.extinction.data(), here.task.importance,
      here.task.nodeImportance };
    std::fill(here.gradient.begin(), here.gradient.end(), 0.0f);
    if (here.terms.camera)
    {
      here.terms.camera->AddGradient(fields, settings.derivative,
        static_cast<float>(settings.weights.view), here.gradient.data());
    }
    if (here.terms.light)
    {
      here.terms.light->AddGradient(fields, settings.derivative,
        static_cast<float>(settings.weights.light), here.gradient.data());
    }
    ++here.count;
    AdamVoxel<float> body{};
    body.gradient = here.gradient.data();
    body.base = here.task.baseExtinction;
    body.first = here.first.data();
    body.second = here.second.data();
    body.extinction = here.extinction.data();
    body.regularization = static_cast<float>(here.task.RegularizationWeight());
    body.step = static_cast<float>(
      settings.learningRate * here.task.majorant / (1.0 - std::pow(0.9, here.count)));
    body.secondCorrection = static_cast<float>(1.0 / (1.0 - std::pow(0.999, here.count)));
    body.floor = static_cast<float>(1e-6 * std::max(settings.weights.view, settings.weights.light));
    body.majorant = here.task.majorant;
    const double sum = ParallelBlockSum(here.task.grid.NodeCount(),
      [&](Index begin, Index end) { return StepBlock(body, begin, end); });
    const double scale = double(std::max<Index>(here.filledVoxels, 1)) * here.task.majorant;
    this->Change = scale > 0 ? sum / scale : 0.0;
  }

  const Problem& Task;
  std::array<int, 3> Remaining; ///< iterations left: quarter, half, full
  Level Here;
  double Change = 0;
  double BestEnergy = 0;
  std::vector<float> BestIterate;
};
}

std::unique_ptr<Minimizer> MakeAdam(const Problem& problem, std::vector<float> start)
{
  return std::make_unique<Adam>(problem, std::move(start));
}
}
