// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Runs.h"

#include "../Markdown.h"
#include "../Timing.h"
#include "PeakMemory.h"
#include "Truth.h"

#include "backend/Backend.h"
#include "optimize/Levels.h"

#include <algorithm>
#include <numeric>

namespace limpid::benchmark
{
namespace
{
Settings CpuSettings()
{
  Settings settings;
  settings.backend = BackendKind::Cpu;
  return settings;
}

WholeRun Planned(const std::string& name, const std::string& group, const Settings& settings)
{
  WholeRun run;
  run.name = name;
  run.group = group;
  run.settings = settings;
  run.threads = ThreadCount();
  return run;
}

std::string Rays(double rayDensity)
{
  return "ρ = " + Significant(rayDensity, rayDensity < 1 ? 2 : 1);
}

void PlanPolicies(const Options& options, std::vector<WholeRun>& runs)
{
  const Settings standard = CpuSettings();
  runs.push_back(Planned("default", "default", standard));
  for (const int iterations : { 1, 2, 4 })
  {
    Settings settings = standard;
    settings.maximumIterations = iterations;
    runs.push_back(Planned("iterations ≤ " + std::to_string(iterations), "iterations", settings));
  }
  for (const double rayDensity : { 0.25, 0.5, 2.0, 3.0 })
  {
    Settings settings = standard;
    settings.rayDensity = rayDensity;
    runs.push_back(Planned(Rays(rayDensity), "ray density", settings));
    const bool middle = rayDensity == 0.5 || rayDensity == 2.0;
    for (const int iterations : { 1, 4 })
    {
      if (middle && !options.quick)
      {
        settings.maximumIterations = iterations;
        runs.push_back(Planned(
          Rays(rayDensity) + ", iterations ≤ " + std::to_string(iterations), "grid", settings));
      }
    }
  }
  Settings ray = standard;
  ray.derivative = Derivative::Ray;
  runs.push_back(Planned("derivative Ray", "derivative", ray));
  for (const int coarsening : { 2, 4 })
  {
    runs.push_back(
      Planned("1/" + std::to_string(coarsening) + " of the nodes", "resolution", standard));
    runs.back().coarsening = coarsening;
  }
}

/// Settings that change nothing but the time.
void PlanTimes(std::vector<WholeRun>& runs)
{
  Settings off = CpuSettings();
  off.skipUnneeded = false;
  runs.push_back(Planned("skips off", "skips", off));
  runs.push_back(Planned("1 thread", "threads", CpuSettings()));
  runs.back().threads = 1;
  if (FindCuda().usable)
  {
    Settings cuda;
    cuda.backend = BackendKind::Cuda;
    runs.push_back(Planned("CUDA", "backend", cuda));
  }
}

void PlanAdams(const Options& options, std::vector<WholeRun>& runs)
{
  Settings adam = CpuSettings();
  adam.solver = SolverKind::Adam;
  runs.push_back(Planned("Adam", "solver", adam));
  const auto add = [&](const std::string& name, double rayDensity, const std::array<int, 3>& levels)
  {
    Settings settings = adam;
    settings.rayDensity = rayDensity;
    settings.iterationsPerLevel = levels;
    runs.push_back(Planned("Adam, " + name, "levels", settings));
  };
  add("levels 32, 32, 16", 1, { { 32, 32, 16 } });
  add("full resolution, 64", 1, { { 0, 0, 64 } });
  add(Rays(0.5), 0.5, { { 32, 32, 64 } });
  if (!options.quick)
  {
    add("levels 16, 16, 16", 1, { { 16, 16, 16 } });
    add("levels 8, 8, 8", 1, { { 8, 8, 8 } });
  }
}

std::vector<WholeRun> PlannedRuns(const Options& options)
{
  std::vector<WholeRun> runs;
  PlanPolicies(options, runs);
  PlanTimes(runs);
  PlanAdams(options, runs);
  return runs;
}

std::vector<HistoryPoint> Follow(Solver& solver, const Stopwatch& start)
{
  std::vector<HistoryPoint> history;
  const auto note = [&]()
  {
    const IterationRecord& record = solver.History().back();
    history.push_back({ record.iteration, record.level, start.Elapsed(), record.visibilityScore,
      record.energy.Total() });
  };
  note();
  for (bool done = solver.Done(); !done;)
  {
    done = solver.Step(1);
    note();
  }
  return history;
}

/// A scene with fewer nodes over the same box.
struct CoarseScene
{
  Grid grid;
  std::vector<float> extinction;
  std::vector<float> importance;

  CoarseScene(const Scene& scene, int coarsening)
    : grid(CoarseGrid(scene.grid, coarsening))
    , extinction(Restrict(scene.grid, scene.file.extinction.data(), this->grid))
    , importance(Restrict(scene.grid, scene.file.importance.data(), this->grid))
  {
    for (float& value : this->importance)
    {
      value = std::min(value, 1.0f); // a mean of ones may round up
    }
  }
};

/// Once, for memory and worth. Returns the time if it counts, otherwise 0.
double FirstRun(const Truth& truth, const Effort& effort, const WholeRun& standard, WholeRun& run)
{
  const PeakMemory memory;
  const std::vector<float> extinction = Execute(truth.Source(), run);
  run.bytes = memory.Bytes();
  const bool same =
    extinction == truth.Extinction(1) && !standard.history.empty() && &standard != &run;
  run.worth = same ? standard.worth
                   : WorthOf(truth.Source(), extinction, run.settings.weights, effort.worthRays);
  return run.seconds > effort.warmLimit ? run.seconds : 0;
}
}

std::vector<float> Execute(const Scene& scene, WholeRun& run)
{
  const ThreadLimit limit(run.threads);
  std::vector<float> extinction;
  Stopwatch watch;
  if (run.coarsening == 1)
  {
    Solver solver = scene.MakeSolver(run.settings);
    run.history = Follow(solver, watch);
    run.iterations = solver.Iterations();
    run.seconds = watch.Elapsed();
    extinction = std::move(solver.TakeExtinctions()[0]);
  }
  else
  {
    const CoarseScene coarse(scene, run.coarsening);
    Solver solver({ coarse.grid, coarse.extinction.data(), coarse.importance.data() }, scene.camera,
      scene.light, run.settings);
    run.history = Follow(solver, watch);
    run.iterations = solver.Iterations();
    extinction = Prolong(coarse.grid, solver.Extinction().data(), scene.grid);
    run.seconds = watch.Elapsed();
  }
  return extinction;
}

std::vector<float> DefaultResult(const Scene& scene)
{
  WholeRun run = Planned("default", "default", CpuSettings());
  return Execute(scene, run);
}

std::vector<WholeRun> MeasureRuns(const Truth& truth, const Options& options, const Effort& effort)
{
  std::vector<WholeRun> runs = PlannedRuns(options);
  std::vector<std::vector<double>> times(runs.size());
  for (std::size_t n = 0; n < runs.size(); ++n)
  {
    const double seconds = FirstRun(truth, effort, runs.front(), runs[n]);
    if (seconds > 0)
    {
      times[n].push_back(seconds);
    }
  }
  for (int turn = 0; turn < effort.repeats; ++turn)
  {
    for (std::size_t n = 0; n < runs.size(); ++n)
    {
      const double spent = std::accumulate(times[n].begin(), times[n].end(), 0.0);
      if (times[n].empty() || spent < effort.secondsPerSetting)
      {
        Execute(truth.Source(), runs[n]);
        times[n].push_back(runs[n].seconds);
      }
    }
  }
  for (std::size_t n = 0; n < runs.size(); ++n)
  {
    runs[n].seconds = Median(times[n]);
    runs[n].spread = Spread(times[n]);
    runs[n].repeats = static_cast<int>(times[n].size());
  }
  return runs;
}
}
