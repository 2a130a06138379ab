// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Measure.h"
#include "PeakMemory.h"
#include "SweepCounts.h"
#include "Volume.h"

#include "backend/Backend.h"
#include "math/Require.h"
#include "optimize/PreparedScene.h"

#include <cmath>
#include <memory>

namespace limpid::benchmark
{
namespace
{

/// `kind` from the base extinction at full resolution, for as long as is wanted.
Settings SettingsFor(SolverKind kind, bool skip)
{
  Settings settings;
  settings.skipUnneeded = skip;
  settings.backend = BackendKind::Cpu;
  settings.solver = kind;
  settings.tolerance = 0;
  settings.maximumIterations = 1000;
  settings.iterationsPerLevel = { { 0, 0, 1000 } };
  return settings;
}

/// Median of the iterations to come but the next, which may still make memory. Not many of what
/// takes long.
double LaterSteps(Solver& solver, std::size_t most)
{
  solver.Step(1);
  constexpr double enough = 1; // [s]
  std::vector<double> seconds;
  Stopwatch whole;
  Stopwatch watch;
  while (seconds.size() < 2 || (seconds.size() < most && whole.Elapsed() < enough))
  {
    solver.Step(1);
    seconds.push_back(watch.Lap());
  }
  return Median(seconds);
}

/// One set of times, or several of what is so quick that a single one tells little.
void TimeRound(const SceneForSolver& scene, bool skip, Rounds& runs)
{
  const double voxels = double(scene.grid.NodeCount());
  const int sets = voxels < 3e5 ? 5 : (voxels < 3e6 ? 2 : 1);
  for (int set = 0; set < sets; ++set)
  {
    Stopwatch watch;
    {
      Solver policy = scene.MakeSolver(SettingsFor(SolverKind::Policy, skip));
      runs["setup"].push_back(watch.Lap());
      policy.Step(1);
      runs["first pass"].push_back(watch.Lap());
      runs["policy iteration"].push_back(LaterSteps(policy, 3));
    }
    if (skip) // without skips all takes long, and scores have no such setting
    {
      {
        Solver adam = scene.MakeSolver(SettingsFor(SolverKind::Adam, true));
        runs["Adam iteration"].push_back(LaterSteps(adam, 2));
      }
      constexpr int directions = 8;
      const ViewScore score(scene.grid, { scene.extinction.data(), scene.importance.data() }, 1);
      watch.Lap();
      ScoreViews(score, OrbitAround(scene.grid), SpreadDirections(directions), nullptr);
      runs["score of a direction"].push_back(watch.Lap() / directions);
    }
  }
}

/// Nodes along each axis of the volumes that are wanted and whose runs fit into free memory.
std::vector<int> SidesOf(const Options& options)
{
  constexpr double bytesPerVoxel = 80; // all sizes of a scene and the run of the largest, roomily
  const double free = BytesIn("/proc/meminfo", "MemAvailable:");
  std::vector<int> sides;
  for (const int side : { 32, 64, 96, 128, 192, 256, 384, 512 })
  {
    const bool fits = std::pow(side, 3) * bytesPerVoxel < free;
    if (side <= options.Count("largest") && fits)
    {
      sides.push_back(side);
    }
    else if (!fits)
    {
      Say(std::to_string(side) + "³ is left out: there is too little memory");
    }
  }
  LIMPID_REQUIRE(!sides.empty(),
    "Not even the smallest volume, of 32 nodes along each axis, may be measured (--largest is "
      << options.Text("largest") << "). Give 32 or more, or make memory free.");
  return sides;
}

/// All sizes in turns.
void MeasureSizes(const std::string& filling, bool skip, const std::vector<int>& sides,
  const Options& options, Json& results)
{
  constexpr int largeSide = 300;      // larger volumes take seconds
  constexpr int mostLargeRepeats = 3; // most repeats of these
  std::vector<SceneForSolver> scenes;
  scenes.reserve(sides.size());
  for (const int side : sides)
  {
    scenes.push_back(MakeVolume(filling, side));
  }
  std::vector<Rounds> runs(sides.size());
  Rounds warmUp;
  TimeRound(scenes.front(), skip, warmUp);
  const std::string name = filling + (skip ? "" : ", skips off");
  for (int repeat = 0; repeat < options.Count("repeats"); ++repeat)
  {
    Say("sizes, " + name + ", repeat " + std::to_string(repeat + 1));
    for (std::size_t i = 0; i < sides.size(); ++i)
    {
      if (repeat < mostLargeRepeats || sides[i] < largeSide)
      {
        TimeRound(scenes[i], skip, runs[i]);
      }
    }
  }
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    results.push_back({ { "scene", name }, { "side", sides[i] } });
    results.back().update(MediansOf(runs[i]));
  }
}

Json MemoryOf(const std::string& filling, int side)
{
  const double bytes = PeakInChild(
    [&]() -> std::function<void()>
    {
      const auto scene = std::make_shared<SceneForSolver>(MakeVolume(filling, side));
      Settings settings;
      settings.backend = BackendKind::Cpu;
      return [=] { scene->MakeSolver(settings).Run(); };
    });
  return { { "scene", filling }, { "side", side }, { "voxels", std::pow(side, 3) },
    { "bytes", bytes } };
}

/// Seconds of arithmetic that waits for no memory, the same on each of so many threads.
double ComputeOn(int threads)
{
  const ThreadLimit limit(threads);
  std::vector<unsigned> seeds(static_cast<std::size_t>(threads));
  Stopwatch watch;
  ParallelFor(threads,
    [&](Index thread)
    {
      unsigned seed = unsigned(thread);
      for (int step = 0; step < 8000000; ++step)
      {
        seed = seed * 1664525u + 1013904223u;
      }
      seeds[std::size_t(thread)] = seed;
    });
  const double seconds = watch.Lap();
  volatile unsigned sink = seeds.front(); // lest it be left out
  return sink == seeds.front() ? seconds : 0;
}

/// All numbers of threads in turns. "cores": what the machine lent to plain arithmetic.
Json MeasureThreads(const SceneForSolver& scene, int repeats)
{
  Say("threads, " + scene.name);
  const int all = ThreadCount();
  std::vector<int> threads;
  for (int count = 1; count < all; count *= 2)
  {
    threads.push_back(count);
  }
  threads.push_back(all);
  std::vector<Rounds> runs(threads.size());
  Rounds warmUp;
  TimeRound(scene, true, warmUp);
  std::vector<double> cores;
  for (int repeat = 0; repeat < repeats; ++repeat)
  {
    cores.push_back(all * ComputeOn(1) / ComputeOn(all));
    for (std::size_t i = 0; i < runs.size(); ++i)
    {
      const ThreadLimit limit(threads[i]);
      TimeRound(scene, true, runs[i]);
    }
  }
  Json times = Json::array();
  for (std::size_t i = 0; i < runs.size(); ++i)
  {
    times.push_back({ { "threads", threads[i] } });
    times.back().update(MediansOf(runs[i]));
  }
  return { { "scene", scene.name }, { "nodes", ToJson(scene.grid.nodes) }, { "times", times },
    { "cores", Median(cores) } };
}

/// What the sweeps of an iteration visit with skips and without, and the time that they save.
Json MeasureSkips(const SceneOfFile& scene, const Options& options)
{
  Say("skips, " + scene.name);
  PreparedScene prepared(scene.Fields());
  Json result{ { "scene", scene.name }, { "voxels", scene.grid.NodeCount() } };
  for (const bool skip : { true, false })
  {
    Settings settings;
    settings.backend = BackendKind::Cpu;
    settings.skipUnneeded = skip;
    const Problem problem = prepared.ProblemFor(scene.camera, scene.light, settings);
    const SweepCounts camera = CountSweep(problem, problem.Camera());
    const SweepCounts light = CountSweep(problem, problem.Light());
    result["camera samples"][skip ? "taken" : "all"] = camera.samples;
    result["light samples"][skip ? "taken" : "all"] = light.samples;
    if (skip)
    {
      NodeSet touched = camera.read;
      for (const NodeSet* more : { &light.read, &camera.updated, &light.updated })
      {
        Add(*more, touched);
      }
      result["filled"] = problem.occupancy->FilledVoxels();
      result["read by camera"] = CountOf(camera.read);
      result["read by light"] = CountOf(light.read);
      result["touched"] = CountOf(touched);
    }
  }
  result.update(TimeRuns(scene, options.Count("repeats")));
  return result;
}
}

void MeasureScaling(const Options& options, Json& results, const std::function<void()>& save)
{
  const std::vector<int> sides = SidesOf(options);
  const std::vector<std::string> fillings{ "dense", "onion" };
  const int repeats = options.Count("repeats");
  for (const char* part : { "sizes", "memory", "threads", "skips" })
  {
    results[part] = Json::array();
  }
  if (options.Has("parts", "memory")) // first: children must not inherit threads
  {
    for (const std::string& filling : fillings)
    {
      Say("memory, " + filling);
      for (const int side : sides)
      {
        results["memory"].push_back(MemoryOf(filling, side));
      }
    }
  }
  if (options.Has("parts", "sizes"))
  {
    for (const std::string& filling : fillings)
    {
      MeasureSizes(filling, true, sides, options, results["sizes"]);
    }
    const std::vector<int> fitted(std::lower_bound(sides.begin(), sides.end(), 64), sides.end());
    if (!fitted.empty()) // of the time without skips only the exponent matters
    {
      MeasureSizes("dense", false, fitted, options, results["sizes"]);
    }
    save();
  }
  if (options.Has("parts", "threads"))
  {
    for (const std::string& filling : fillings)
    {
      results["threads"].push_back(
        MeasureThreads(MakeVolume(filling, std::min(256, sides.back())), repeats));
    }
  }
  for (const std::string& path : options.words)
  {
    const SceneOfFile scene(path);
    if (options.Has("parts", "threads"))
    {
      results["threads"].push_back(MeasureThreads(scene, repeats));
    }
    if (options.Has("parts", "skips"))
    {
      results["skips"].push_back(MeasureSkips(scene, options));
    }
    save();
  }
}
}
