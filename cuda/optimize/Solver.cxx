// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Solver.h"

#include "backend/Backend.h"
#include "energy/NodeImportance.h"
#include "math/Require.h"
#include "optimize/Adam.h"
#include "optimize/Policy.h"
#include "optimize/Problem.h"
#include "optimize/Terms.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>

namespace limpid
{
namespace
{
using Clock = std::chrono::steady_clock;

void RequireFields(const SceneFields& scene)
{
  scene.grid.Require();
  LIMPID_REQUIRE(scene.baseExtinction != nullptr,
    "There is no base extinction (the optimisation starts from it). Give an array.");
  LIMPID_REQUIRE(scene.importance != nullptr,
    "There is no importance (nothing tells what is to be seen). Give an array.");
}

/// Checks all values of a field and returns the largest.
template <class Valid>
float LargestValue(
  Index count, const float* field, const char* name, const char* range, const Valid& valid)
{
  constexpr Index blockSize = 65536;
  const Index blocks = (count + blockSize - 1) / blockSize;
  std::vector<float> largest(static_cast<std::size_t>(blocks), 0.0f);
  std::vector<Index> bad(static_cast<std::size_t>(blocks), -1);
  ParallelFor(blocks,
    [&](Index block)
    {
      const Index end = std::min(count, (block + 1) * blockSize);
      float most = 0;
      bool allValid = true;
      for (Index voxel = block * blockSize; voxel < end; ++voxel)
      {
        allValid &= valid(field[voxel]);
        most = field[voxel] > most ? field[voxel] : most;
      }
      largest[std::size_t(block)] = most;
      for (Index voxel = block * blockSize; voxel < end && !allValid; ++voxel)
      {
        allValid = !valid(field[voxel]);
        bad[std::size_t(block)] = voxel;
      }
    });
  for (const Index voxel : bad)
  {
    LIMPID_REQUIRE(voxel < 0,
      "The " << name << " of voxel " << voxel << " is " << field[voxel]
             << " (the energy of Eq. 21 is not defined there). Keep it " << range << '.');
  }
  return *std::max_element(largest.begin(), largest.end());
}

void RequireSettings(const Settings& settings)
{
  settings.Require();
  LIMPID_REQUIRE(settings.backend != BackendKind::Cuda,
    "CUDA was asked for, but this build has no CUDA backend (nothing would run on a GPU). Choose "
    "the backend Auto or CPU.");
}

void RequireReach(const char* what, const Eye& eye, const Grid& grid)
{
  const double distance = glm::length(eye.origin - 0.5 * Vec3(grid.nodes - 1));
  LIMPID_REQUIRE(eye.parallel || distance < 1e12 * glm::length(Vec3(grid.nodes)),
    "The " << what << " is " << distance / glm::length(Vec3(grid.nodes))
           << " image diagonals away (its rays cannot be told apart). Move it closer or use a "
              "parallel projection.");
}
}

struct Solver::Internals
{
  SceneFields scene;
  Camera camera;
  Light light;
  Settings settings;
  float majorant = 0;
  bool somethingImportant = false;
  std::vector<float> nodeImportance; ///< see NodeImportanceOfFilled; for voxels
  std::vector<float> initial;        ///< empty: the base extinction

  /// One run of a minimiser: the joint field, or in separate mode first the camera's field and
  /// then the light's.
  Problem problem;
  std::unique_ptr<Minimizer> minimizer;
  int runIterations = 0;
  bool lightRun = false;

  std::vector<float> extinction; ///< result of a finished run
  std::vector<float> lightExtinction;
  std::vector<IterationRecord> history;
  Score base;
  Score best;
  Energy bestEnergy;
  int iterations = 0;
  double seconds = 0;
  bool done = false;
  bool stopped = false;
  bool warm = false;

  void Prepare()
  {
    RequireSettings(this->settings);
    RequireFields(this->scene);
    const Index count = this->scene.grid.NodeCount();
    this->majorant = LargestValue(count, this->scene.baseExtinction, "base extinction",
      "finite and not negative", [](float value) { return (value >= 0) & (value < 3e38f); });
    this->somethingImportant =
      LargestValue(count, this->scene.importance, "importance", "between 0 and 1",
        [](float value) { return (value >= 0) & (value <= 1); }) > 0;
    this->nodeImportance =
      NodeImportanceOfFilled(this->scene.grid, this->scene.baseExtinction, this->scene.importance);
    this->Begin();
  }

  /// Starts the first run.
  void Begin()
  {
    this->history.clear();
    this->iterations = 0;
    this->seconds = 0;
    this->done = false;
    this->stopped = false;
    this->lightRun = false;
    this->base = Score();
    this->best = Score();
    this->bestEnergy = Energy();
    this->lightExtinction.clear();
    if (this->settings.mode == Mode::Separate)
    {
      this->AssignBase(this->lightExtinction); // until the light's own run
    }
    const Clock::time_point start = Clock::now();
    this->problem = this->MakeProblem();
    RequireReach("camera", this->problem.camera, this->scene.grid);
    RequireReach("light", this->problem.light, this->scene.grid);
    this->MakeMinimizer(this->FirstIterate());
    this->seconds += std::chrono::duration<double>(Clock::now() - start).count();
  }

  Problem MakeProblem() const
  {
    Problem task;
    task.grid = this->scene.grid;
    task.baseExtinction = this->scene.baseExtinction;
    task.importance = this->scene.importance;
    task.nodeImportance = this->nodeImportance.data();
    task.majorant = this->majorant;
    task.camera = EyeOfCamera(this->camera, task.grid, this->settings.restrictToView);
    task.light = EyeOfLight(this->light, task.grid);
    task.settings = this->settings;
    if (this->settings.mode == Mode::Separate)
    {
      (this->lightRun ? task.settings.weights.view : task.settings.weights.light) = 0;
    }
    return task;
  }

  void AssignBase(std::vector<float>& field) const
  {
    const float* baseField = this->scene.baseExtinction;
    field.assign(baseField, baseField + this->scene.grid.NodeCount());
  }

  std::vector<float> FirstIterate() const
  {
    const Index count = this->scene.grid.NodeCount();
    const float* baseField = this->scene.baseExtinction;
    std::vector<float> start(baseField, baseField + count);
    if (!this->initial.empty())
    {
      const float* wish = this->initial.data();
      const float* importance = this->scene.importance;
      const float most = this->majorant;
      ParallelFor(count, 65536,
        [&](Index voxel)
        {
          const bool empty = !(baseField[voxel] > 0) && !(importance[voxel] > 0);
          const float value = wish[voxel] > 0 ? std::min(wish[voxel], most) : 0.0f;
          start[std::size_t(voxel)] = empty ? 0.0f : value;
        });
    }
    return start;
  }

  void MakeMinimizer(std::vector<float> start)
  {
    const Weights& weights = this->problem.settings.weights;
    this->runIterations = 0;
    const bool nothingAtStake = !(weights.view > 0 || weights.light > 0) ||
      !this->somethingImportant || !(this->majorant > 0) || !this->scene.grid.HasVolume();
    if (nothingAtStake)
    {
      // Only the regularisation is left, whose minimum is the base extinction.
      this->AssignBase(this->lightRun ? this->lightExtinction : this->extinction);
      this->minimizer.reset();
      if (!this->lightRun)
      {
        this->base = this->best = this->ScoreOf(this->scene.baseExtinction);
        this->bestEnergy.view = -weights.view * this->base.visibility;
        IterationRecord record;
        record.energy = this->bestEnergy;
        record.visibilityScore = this->base.visibility;
        record.visibleFraction = this->base.fraction;
        this->history.push_back(record);
      }
      return;
    }
    this->minimizer = this->problem.settings.solver == SolverKind::Adam
      ? MakeAdam(this->problem, std::move(start))
      : MakePolicy(this->problem,
          Occupancy(this->scene.grid, this->scene.baseExtinction, this->nodeImportance.data(),
            this->problem.settings.skipUnneeded),
          std::move(start), this->warm);
    IterationRecord record = this->minimizer->Start();
    record.iteration = this->iterations;
    this->history.push_back(record);
    if (this->lightRun)
    {
      return;
    }
    const Score seen{ record.visibilityScore, record.visibleFraction };
    this->base =
      this->warm || !(weights.view > 0) ? this->ScoreOf(this->scene.baseExtinction) : seen;
    this->best = weights.view > 0 ? seen : this->base;
    this->bestEnergy = record.energy;
  }

  Score ScoreOf(const float* field) const
  {
    const Occupancy occupancy(this->scene.grid, this->scene.baseExtinction, this->scene.importance,
      this->settings.skipUnneeded);
    VisibilityTerm term(
      this->scene.grid, occupancy, this->problem.camera, this->settings.rayDensity);
    const Visible seen = term.Forward(field, this->scene.importance);
    return { seen.visible, seen.plain > 0 ? seen.visible / seen.plain : 0.0 };
  }

  double Share() const
  {
    const double limit = this->minimizer ? std::max(1, this->minimizer->IterationLimit()) : 1;
    return std::min(1.0, this->runIterations / limit);
  }

  void Iterate(const Progress& progress)
  {
    const Clock::time_point start = Clock::now();
    IterationRecord record = this->minimizer->Iterate();
    ++this->iterations;
    ++this->runIterations;
    this->seconds += std::chrono::duration<double>(Clock::now() - start).count();
    record.iteration = this->iterations;
    record.seconds = this->seconds;
    this->history.push_back(record);
    const bool better = record.level == 0 && record.energy.Total() < this->bestEnergy.Total();
    if (better && !this->lightRun)
    {
      this->bestEnergy = record.energy;
      this->best = { record.visibilityScore, record.visibleFraction };
    }
    if (progress && !progress(this->Share(), this->Describe(record)))
    {
      this->stopped = true;
    }
    const bool late =
      this->settings.maximumSeconds > 0 && this->seconds >= this->settings.maximumSeconds;
    if (this->stopped || late || this->minimizer->Converged() ||
      this->runIterations >= this->minimizer->IterationLimit())
    {
      this->FinishRun();
    }
  }

  std::string Describe(const IterationRecord& record) const
  {
    std::ostringstream text;
    text.precision(3);
    text << "Iteration " << record.iteration;
    if (record.level > 0)
    {
      text << " at 1/" << (1 << record.level) << " resolution";
    }
    if (!this->lightRun)
    {
      text << ": " << 100 * record.visibleFraction << " % of the important structures visible";
    }
    return text.str();
  }

  void FinishRun()
  {
    std::vector<float>& result = this->lightRun ? this->lightExtinction : this->extinction;
    if (this->minimizer)
    {
      result = this->minimizer->Best();
      this->minimizer.reset();
    }
    const bool lightFollows = this->settings.mode == Mode::Separate && !this->lightRun;
    if (!lightFollows || this->stopped)
    {
      this->done = true;
      return;
    }
    this->lightRun = true;
    this->problem = this->MakeProblem();
    this->MakeMinimizer(this->FirstIterate());
    this->done = !this->minimizer;
  }
};

Solver::Solver(
  const SceneFields& scene, const Camera& camera, const Light& light, const Settings& settings)
  : State(std::make_unique<Internals>())
{
  this->State->scene = scene;
  this->State->camera = camera;
  this->State->light = light;
  this->State->settings = settings;
  this->State->Prepare();
}

Solver::~Solver() = default;
Solver::Solver(Solver&&) noexcept = default;
Solver& Solver::operator=(Solver&&) noexcept = default;

void Solver::SetInitialExtinction(const float* extinction)
{
  Internals& state = *this->State;
  LIMPID_REQUIRE(state.settings.mode == Mode::Joint,
    "An initial extinction was given in separate mode (there are two extinctions to start). Use "
    "the joint mode.");
  state.initial.assign(extinction, extinction + state.scene.grid.NodeCount());
  state.warm = true;
  state.Begin();
}

void Solver::Restart(const Camera& camera, const Light& light, const Settings& settings)
{
  Internals& state = *this->State;
  RequireSettings(settings);
  if (settings.mode == Mode::Joint && state.settings.mode == Mode::Joint)
  {
    state.initial = this->Extinction();
    state.warm = true;
  }
  state.camera = camera;
  state.light = light;
  state.settings = settings;
  state.Begin();
}

bool Solver::Step(int iterations, const Progress& progress)
{
  Internals& state = *this->State;
  state.stopped = false;
  for (int i = 0; i < iterations && !state.done; ++i)
  {
    if (!state.minimizer || state.runIterations >= state.minimizer->IterationLimit())
    {
      state.FinishRun();
      continue;
    }
    state.Iterate(progress);
    if (state.stopped)
    {
      break;
    }
  }
  return state.done;
}

void Solver::Run(const Progress& progress)
{
  while (!this->Step(1, progress) && !this->State->stopped)
  {
  }
}

bool Solver::Done() const
{
  return this->State->done;
}

bool Solver::Stopped() const
{
  return this->State->stopped;
}

const std::vector<float>& Solver::Extinction() const
{
  const Internals& state = *this->State;
  return state.minimizer && !state.lightRun ? state.minimizer->Best() : state.extinction;
}

const std::vector<float>& Solver::LightExtinction() const
{
  const Internals& state = *this->State;
  return state.minimizer && state.lightRun ? state.minimizer->Best() : state.lightExtinction;
}

double Solver::Majorant() const
{
  return this->State->majorant;
}

Score Solver::BaseScore() const
{
  return this->State->base;
}

Score Solver::BestScore() const
{
  return this->State->best;
}

Energy Solver::BestEnergy() const
{
  return this->State->bestEnergy;
}

int Solver::Iterations() const
{
  return this->State->iterations;
}

double Solver::Seconds() const
{
  return this->State->seconds;
}

std::string Solver::BackendName() const
{
  return CpuName();
}

const std::vector<IterationRecord>& Solver::History() const
{
  return this->State->history;
}

namespace
{
void FillTransmittance(const Grid& grid, const Eye& eye, double rayDensity,
  const std::vector<float>& extinction, float* transmittance)
{
  const Occupancy everything(grid, extinction.data(), extinction.data(), false);
  VisibilityTerm term(grid, everything, eye, rayDensity);
  term.Transmittance(extinction.data(), transmittance);
}
}

void Solver::Transmittance(float* transmittance) const
{
  const Internals& state = *this->State;
  FillTransmittance(state.scene.grid, state.problem.camera, state.settings.rayDensity,
    this->Extinction(), transmittance);
}

void Solver::LightTransmittance(float* transmittance) const
{
  const Internals& state = *this->State;
  FillTransmittance(state.scene.grid, state.problem.light, state.settings.rayDensity,
    state.settings.mode == Mode::Separate ? this->LightExtinction() : this->Extinction(),
    transmittance);
}
}
