// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Runs.h"

#include "Errors.h"
#include "PeakMemory.h"

#include "backend/Backend.h"
#include "optimize/Levels.h"

#include <iomanip>
#include <numeric>
#include <sstream>

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
  std::ostringstream text;
  text << "ρ = " << std::fixed << std::setprecision(rayDensity < 1 ? 2 : 0) << rayDensity;
  return text.str();
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
      if (middle && !options.Flag("quick"))
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
  if (!options.Flag("quick"))
  {
    add("levels 16, 16, 16", 1, { { 16, 16, 16 } });
    add("levels 8, 8, 8", 1, { { 8, 8, 8 } });
  }
}

Json Follow(Solver& solver, const Stopwatch& start)
{
  Json history = Json::array();
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

  CoarseScene(const SceneForSolver& scene, int coarsening)
    : grid(CoarseGrid(scene.grid, coarsening))
    , extinction(Restrict(scene.grid, scene.extinction.data(), this->grid))
    , importance(Restrict(scene.grid, scene.importance.data(), this->grid))
  {
    for (float& value : this->importance)
    {
      value = std::min(value, 1.0f); // a mean of ones may round up
    }
  }
};

Json Describe(const WholeRun& run)
{
  const Settings& settings = run.settings;
  const bool plotted = run.group == "default" || run.group == "solver";
  return { { "name", run.name }, { "group", run.group },
    { "solver", settings.solver == SolverKind::Policy ? "policy" : "Adam" },
    { "ray_density", settings.rayDensity }, { "maximum_iterations", settings.maximumIterations },
    { "iterations_per_level", settings.iterationsPerLevel },
    { "derivative", settings.derivative == Derivative::Volume ? "Volume" : "Ray" },
    { "skip", settings.skipUnneeded }, { "threads", run.threads }, { "coarsening", run.coarsening },
    { "iterations", run.iterations },
    { "history_iteration_level_seconds_S_F", plotted ? run.history : Json::array() } };
}
}

std::vector<float> Execute(const SceneForSolver& scene, WholeRun& run)
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

Json MeasureRuns(const Truth& truth, const Effort& effort, const Options& options)
{
  std::vector<WholeRun> runs;
  PlanPolicies(options, runs);
  PlanTimes(runs);
  PlanAdams(options, runs);
  std::vector<std::vector<double>> times(runs.size());
  Json results;
  for (std::size_t n = 0; n < runs.size(); ++n) // once, for memory and worth
  {
    const PeakMemory memory;
    const std::vector<float> extinction = Execute(truth.Source(), runs[n]);
    results.push_back(Describe(runs[n]));
    results[n]["bytes"] = memory.Bytes();
    const bool same = n > 0 && extinction == truth.Extinction(1);
    const Json worth = same
      ? Json{ { "S", results[0]["S"] }, { "S_light", results[0]["S_light"] },
          { "F", results[0]["F"] } }
      : WorthOf(truth.Source(), extinction, runs[n].settings.weights, effort.worthRays);
    results[n].update(worth);
    if (runs[n].seconds > effort.warmLimit)
    {
      times[n].push_back(runs[n].seconds);
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
    results[n].update(FigureOf(times[n]));
  }
  return results;
}
}
