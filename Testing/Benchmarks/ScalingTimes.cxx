// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ScalingTimes.h"

#include "Timing.h"

#include "backend/Backend.h"
#include "viewpoint/Search.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>

namespace limpid::benchmark
{
namespace
{
constexpr int directions = 8;       ///< of the scores
constexpr int largeSide = 300;      ///< volumes from here on take seconds ...
constexpr int mostLargeRepeats = 3; ///< ... and are measured so often at most

Settings SettingsFor(SolverKind solver, bool skip, int iterations)
{
  Settings settings;
  settings.skipUnneeded = skip;
  settings.backend = BackendKind::Cpu;
  settings.solver = solver;
  settings.tolerance = 0; // as many iterations as wanted
  settings.maximumIterations = iterations;
  settings.iterationsPerLevel = { { 0, 0, iterations } };
  return settings;
}

/// Median of the iterations to come but the next, which may still make memory. Not many of what
/// takes long.
double LaterSteps(Solver& solver, int most)
{
  solver.Step(1);
  constexpr int least = 2;
  constexpr double enough = 1; // [s]
  std::vector<double> seconds;
  double sum = 0;
  Stopwatch watch;
  while (int(seconds.size()) < least || (int(seconds.size()) < most && sum < enough))
  {
    solver.Step(1);
    seconds.push_back(watch.Lap());
    sum += seconds.back();
  }
  return Median(seconds);
}

void TimePolicy(const TimedScene& scene, StepTimes& times)
{
  constexpr int later = 3;
  const Settings settings = SettingsFor(SolverKind::Policy, scene.skip, 2 + later);
  Stopwatch watch;
  Solver solver(scene.fields, scene.camera, scene.light, settings);
  times[Step::Setup] = watch.Lap();
  solver.Step(1);
  times[Step::FirstPass] = watch.Lap();
  times[Step::Iteration] = LaterSteps(solver, later);
}

void TimeAdam(const TimedScene& scene, StepTimes& times)
{
  constexpr int later = 2;
  const Settings settings = SettingsFor(SolverKind::Adam, scene.skip, 1 + later);
  Solver solver(scene.fields, scene.camera, scene.light, settings);
  times[Step::Adam] = LaterSteps(solver, later);
}

void TimeScores(const TimedScene& scene, StepTimes& times)
{
  const Grid& grid = scene.fields.grid;
  Orbit orbit;
  orbit.centre = grid.Centre();
  orbit.distance = 3 * grid.Radius();
  std::vector<Vec3> around;
  for (int i = 0; i < directions; ++i)
  {
    const double z = 1 - (2.0 * i + 1) / directions;
    const double r = std::sqrt(1 - z * z);
    around.emplace_back(r * std::cos(2.4 * i), r * std::sin(2.4 * i), z); // the golden angle
  }
  const ViewScore score(grid, scene.fields.baseExtinction, scene.fields.importance, 1);
  Stopwatch watch;
  ScoreViews(score, orbit, around, nullptr);
  times[Step::Score] = watch.Lap() / directions;
}

/// One set of times, or several of what is so quick that a single one tells little.
void TimeRound(const TimedScene& scene, std::vector<StepTimes>& runs)
{
  const double voxels = double(scene.fields.grid.NodeCount());
  const int sets = voxels < 3e5 ? 5 : (voxels < 3e6 ? 2 : 1);
  for (int set = 0; set < sets; ++set)
  {
    StepTimes times;
    TimePolicy(scene, times);
    if (scene.skip) // without skips all takes long, and scores have no such setting
    {
      TimeAdam(scene, times);
      TimeScores(scene, times);
    }
    runs.push_back(times);
  }
}

StepResult MediansOf(const std::vector<StepTimes>& runs)
{
  StepResult result;
  for (const Step step : allSteps)
  {
    std::vector<double> values;
    for (const StepTimes& run : runs)
    {
      values.push_back(run[step]);
    }
    result.seconds[step] = Median(values);
    result.spread[step] = Spread(values);
  }
  return result;
}

/// Steps of a random number generator: arithmetic that waits for no memory.
unsigned Compute(unsigned seed)
{
  constexpr int steps = 8000000;
  for (int step = 0; step < steps; ++step)
  {
    seed = seed * 1664525u + 1013904223u;
  }
  return seed;
}

/// Seconds of the same arithmetic on each of so many threads.
double ComputeOn(int threads)
{
  const ThreadLimit limit(threads);
  std::vector<unsigned> results(static_cast<std::size_t>(threads));
  Stopwatch watch;
  ParallelFor(
    threads, [&](Index thread) { results[std::size_t(thread)] = Compute(unsigned(thread)); });
  const double seconds = watch.Lap();
  volatile unsigned sink = results.front(); // lest it be left out
  return sink == results.front() ? seconds : 0;
}

/// Slope of a straight line by least squares; 0 for fewer than two points.
double Slope(const std::vector<double>& x, const std::vector<double>& y)
{
  const auto count = double(x.size());
  double meanX = 0;
  double meanY = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    meanX += x[i] / count;
    meanY += y[i] / count;
  }
  double above = 0;
  double below = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    above += (x[i] - meanX) * (y[i] - meanY);
    below += (x[i] - meanX) * (x[i] - meanX);
  }
  return below > 0 ? above / below : 0;
}
}

std::string NameOf(Step step)
{
  switch (step)
  {
    case Step::Setup:
      return "setup";
    case Step::FirstPass:
      return "first pass";
    case Step::Iteration:
      return "policy iteration";
    case Step::Adam:
      return "Adam iteration";
    default:
      return "score of a direction";
  }
}

double ThreadResult::Efficiency(Step step) const
{
  return this->times.front().seconds[step] /
    (this->threads.back() * this->times.back().seconds[step]);
}

int LargestThatFits()
{
  constexpr double bytesPerVoxel = 80; // all sizes of a scene and the run of the largest, roomily
  std::ifstream file("/proc/meminfo");
  for (std::string line; std::getline(file, line);)
  {
    if (line.rfind("MemAvailable:", 0) == 0)
    {
      const double available = 1024 * std::stod(line.substr(line.find(':') + 1));
      return static_cast<int>(std::cbrt(available / bytesPerVoxel));
    }
  }
  return 256;
}

std::vector<SizeResult> MeasureSizes(
  const Series& series, int repeats, const std::function<void(const std::string&)>& say)
{
  std::vector<std::unique_ptr<GpuScene>> scenes;
  for (const int side : series.sides)
  {
    scenes.push_back(std::make_unique<GpuScene>(series.filling, side));
  }
  const auto sceneOf = [&](std::size_t i)
  {
    TimedScene scene = SceneOf(*scenes[i]);
    scene.skip = series.skip;
    return scene;
  };
  std::vector<StepTimes> warmUp;
  TimeRound(sceneOf(0), warmUp);
  std::vector<std::vector<StepTimes>> runs(series.sides.size());
  for (int repeat = 0; repeat < repeats; ++repeat)
  {
    say("sizes, " + series.Name() + ", repeat " + std::to_string(repeat + 1));
    for (std::size_t i = 0; i < series.sides.size(); ++i)
    {
      if (repeat < mostLargeRepeats || series.sides[i] < largeSide)
      {
        TimeRound(sceneOf(i), runs[i]);
      }
    }
  }
  std::vector<SizeResult> results;
  for (std::size_t i = 0; i < series.sides.size(); ++i)
  {
    results.push_back({ series.Name(), series.sides[i], MediansOf(runs[i]) });
  }
  return results;
}

Exponents FitExponents(const std::string& name, const std::vector<SizeResult>& sizes)
{
  Exponents fit;
  fit.scene = name;
  for (const Step step : allSteps)
  {
    std::vector<double> x;
    std::vector<double> y;
    for (const SizeResult& size : sizes)
    {
      if (size.scene == name && size.side >= smallestFitted && size.times.seconds[step] > 0)
      {
        x.push_back(3 * std::log(double(size.side)));
        y.push_back(std::log(size.times.seconds[step]));
        fit.smallest = fit.smallest ? std::min(fit.smallest, size.side) : size.side;
        fit.largest = std::max(fit.largest, size.side);
      }
    }
    fit.values[step] = Slope(x, y);
  }
  return fit;
}

ThreadResult MeasureThreads(const TimedScene& scene, int allThreads, int repeats)
{
  ThreadResult result;
  result.scene = scene.name;
  result.nodes = scene.fields.grid.nodes;
  for (int threads = 1; threads < allThreads; threads *= 2)
  {
    result.threads.push_back(threads);
  }
  result.threads.push_back(allThreads);
  std::vector<std::vector<StepTimes>> runs(result.threads.size());
  std::vector<StepTimes> warmUp;
  TimeRound(scene, warmUp);
  std::vector<double> cores;
  for (int repeat = 0; repeat < repeats; ++repeat)
  {
    cores.push_back(allThreads * ComputeOn(1) / ComputeOn(allThreads));
    for (std::size_t i = 0; i < runs.size(); ++i)
    {
      const ThreadLimit limit(result.threads[i]);
      TimeRound(scene, runs[i]);
    }
  }
  result.cores = Median(cores);
  for (const std::vector<StepTimes>& times : runs)
  {
    result.times.push_back(MediansOf(times));
  }
  return result;
}
}
