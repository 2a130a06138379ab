// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Errors.h"
#include "PeakMemory.h"

#include "Resampled.h"
#include "backend/Backend.h"
#include "scene/Resampling.h"

#include <iomanip>
#include <numeric>
#include <sstream>

namespace limpid::benchmark
{
namespace
{
std::string Rays(double rayDensity)
{
  std::ostringstream text;
  text << "ρ = " << std::fixed << std::setprecision(rayDensity < 1 ? 2 : 0) << rayDensity;
  return text.str();
}

/// All runs that are compared, first the default.
std::vector<WholeRun> PlannedRuns(bool quick)
{
  std::vector<WholeRun> runs;
  const auto plan = [&](const std::string& name, const char* group,
                      const std::function<void(WholeRun&, Settings&)>& change)
  {
    WholeRun run;
    run.name = name;
    run.group = group;
    run.threads = ThreadCount();
    run.settings.backend = BackendKind::Cpu;
    change(run, run.settings);
    runs.push_back(run);
  };
  plan("default", "default", [](WholeRun&, Settings&) {});
  for (const int iterations : { 1, 2, 4 })
  {
    plan("iterations ≤ " + std::to_string(iterations), "iterations",
      [=](WholeRun&, Settings& settings) { settings.maximumIterations = iterations; });
  }
  for (const double rayDensity : { 0.25, 0.5, 2.0, 3.0 })
  {
    plan(Rays(rayDensity), "ray density",
      [=](WholeRun&, Settings& settings) { settings.rayDensity = rayDensity; });
    for (const int iterations : { 1, 4 })
    {
      if (!quick && (rayDensity == 0.5 || rayDensity == 2))
      {
        plan(Rays(rayDensity) + ", iterations ≤ " + std::to_string(iterations), "grid",
          [=](WholeRun&, Settings& settings)
          {
            settings.rayDensity = rayDensity;
            settings.maximumIterations = iterations;
          });
      }
    }
  }
  plan("derivative Ray", "derivative",
    [](WholeRun&, Settings& settings) { settings.derivative = Derivative::Ray; });
  for (const int coarsening : { 2, 4 })
  {
    plan("1/" + std::to_string(coarsening) + " of the nodes", "resolution",
      [=](WholeRun& run, Settings&) { run.coarsening = coarsening; });
  }
  plan("skips off", "skips", [](WholeRun&, Settings& settings) { settings.skipUnneeded = false; });
  plan("1 thread", "threads", [](WholeRun& run, Settings&) { run.threads = 1; });
  if (FindCuda().usable)
  {
    plan("CUDA", "backend",
      [](WholeRun&, Settings& settings) { settings.backend = BackendKind::Cuda; });
  }
  const auto adam = [&](
                      const std::string& name, double rayDensity, const std::array<int, 3>& levels)
  {
    plan("Adam" + name, name.empty() ? "solver" : "levels",
      [=](WholeRun&, Settings& settings)
      {
        settings.solver = SolverKind::Adam;
        settings.rayDensity = rayDensity;
        settings.iterationsPerLevel = levels;
      });
  };
  adam("", 1, Settings().iterationsPerLevel);
  adam(", levels 32, 32, 16", 1, { { 32, 32, 16 } });
  adam(", full resolution, 64", 1, { { 0, 0, 64 } });
  adam(", " + Rays(0.5), 0.5, { { 32, 32, 64 } });
  if (!quick)
  {
    adam(", levels 16, 16, 16", 1, { { 16, 16, 16 } });
    adam(", levels 8, 8, 8", 1, { { 8, 8, 8 } });
  }
  return runs;
}

Json Follow(Solver& solver, const Stopwatch& start)
{
  Json history = Json::array();
  const auto note = [&]()
  {
    const IterationRecord& record = solver.History().back();
    history.push_back({ record.iteration, record.level, start.Elapsed(), record.score.visibility,
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
SceneForSolver Coarse(const SceneForSolver& scene, int coarsening)
{
  SceneForSolver coarse;
  coarse.camera = scene.camera;
  coarse.light = scene.light;
  coarse.grid = CoarseGrid(scene.grid, coarsening);
  coarse.extinction = Resampled(scene.grid, scene.extinction.data(), coarse.grid);
  coarse.importance = Resampled(scene.grid, scene.importance.data(), coarse.grid);
  for (float& value : coarse.importance)
  {
    value = std::min(value, 1.0f); // a mean of ones may round up
  }
  return coarse;
}

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
  const bool whole = run.coarsening == 1;
  Stopwatch watch;
  const SceneForSolver coarse = whole ? SceneForSolver() : Coarse(scene, run.coarsening);
  Solver solver = (whole ? scene : coarse).MakeSolver(run.settings);
  run.history = Follow(solver, watch);
  run.iterations = solver.Iterations();
  std::vector<float> extinction = solver.TakeExtinctions()[0].Take();
  if (!whole)
  {
    extinction = Resampled(coarse.grid, extinction.data(), scene.grid);
  }
  run.seconds = watch.Elapsed();
  return extinction;
}

Json MeasureRuns(const Truth& truth, const Effort& effort, const Options& options)
{
  std::vector<WholeRun> runs = PlannedRuns(options.Flag("quick"));
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
