// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Measure.h"
#include "PeakMemory.h"

#include "PaperScheme/PaperScheme.h"

#include <memory>

namespace limpid::benchmark
{
namespace
{
/// Memory of runs to the end in child processes.
Json MemoryOf(const std::string& path)
{
  std::map<std::string, Settings> kinds;
  kinds["policy"];
  kinds["separate"].mode = Mode::Separate;
  kinds["adam"].solver = SolverKind::Adam;
  kinds["adam"].iterationsPerLevel = { { 2, 2, 2 } }; // all arrays are there after one
  Json memory;
  for (const auto& [name, settings] : kinds)
  {
    memory[name] = PeakInChild(
      [&path, wanted = settings]() -> std::function<void()>
      {
        const auto scene = std::make_shared<SceneForSolver>(truth::ReadSceneFile(path));
        return [=] { scene->MakeSolver(wanted).Run(); };
      });
  }
  return memory;
}

/// A score as it is reported beside that of the independent march [length^2].
Json Checked(const SceneOfFile& scene, double reported, const std::vector<float>& extinction,
  const Options& options)
{
  return { { "reported", reported },
    { "march", scene.March(extinction, options.Number("march-rays")) } };
}

Json RunToTheEnd(const SceneOfFile& scene, SolverKind kind, const Options& options)
{
  Settings settings;
  settings.solver = kind;
  Stopwatch watch;
  Solver solver = scene.MakeSolver(settings);
  solver.Run();
  const double seconds = watch.Lap();
  const IterationRecord& first =
    solver.History()[std::min<std::size_t>(1, solver.History().size() - 1)];
  return { { "seconds", seconds }, { "iterations", solver.Iterations() },
    { "S", Checked(scene, solver.BestScore().visibility, solver.Extinction(), options) },
    { "F", solver.BestEnergy().Total() }, { "fraction", solver.BestScore().fraction },
    { "first_F", first.energy.Total() }, { "first_S", first.score.visibility } };
}

Json QualityOf(const SceneOfFile& scene, const Options& options)
{
  const Score base = scene.MakeSolver(Settings()).BaseScore();
  return { { "base", Checked(scene, base.visibility, scene.extinction, options) },
    { "base_fraction", base.fraction },
    { "policy", RunToTheEnd(scene, SolverKind::Policy, options) },
    { "adam", RunToTheEnd(scene, SolverKind::Adam, options) } };
}

/// F of any extinction by Limpid's sweeps.
double EnergyOf(const SceneOfFile& scene, const std::vector<float>& extinction)
{
  Solver solver = scene.MakeSolver(Settings());
  solver.SetInitialExtinction(extinction.data());
  return solver.History().front().energy.Total();
}

/// Adam iterations of the paper's scheme to the letter beside ours, in turns: the same process,
/// threads and compiler flags, full resolution, from the base extinction.
Json AgainstPaper(const SceneOfFile& scene, const Options& options)
{
  reference::PaperSettings paperSettings;
  paperSettings.samplesPerVoxel = options.Number("paper-samples");
  reference::PaperScheme<float> paper(
    scene.Fields(), scene.camera.position, scene.light.position, paperSettings);
  Settings settings;
  settings.solver = SolverKind::Adam;
  settings.iterationsPerLevel = { { 0, 0, options.Count("paper-iterations") + 1 } };
  settings.tolerance = 0; // all iterations, please
  Solver limpid = scene.MakeSolver(settings);
  Json result{ { "camera_cells", ToJson(paper.CameraMap().cells) },
    { "light_cells", ToJson(paper.LightMap().cells) },
    { "base_march", scene.March(scene.extinction, options.Number("march-rays")) } };
  Json ofPaper{ { "base_score", paper.Score() } };
  Json ofLimpid{ { "base_score", limpid.BaseScore().visibility } };

  paper.Step(); // warms up
  limpid.Step(1);
  std::vector<double> paperSeconds;
  std::vector<double> limpidSeconds;
  double spent = 0;
  while (int(paperSeconds.size()) < options.Count("paper-iterations") &&
    (paperSeconds.size() < 3 || spent < options.Number("paper-seconds")))
  {
    Stopwatch watch;
    paper.Step();
    paperSeconds.push_back(watch.Lap());
    limpid.Step(1);
    limpidSeconds.push_back(watch.Lap());
    spent += paperSeconds.back();
  }
  ofPaper["time"] = FigureOf(paperSeconds);
  ofPaper["F"] = EnergyOf(scene, paper.Extinction());
  ofPaper["S"] = Checked(scene, paper.Score(), paper.Extinction(), options);
  ofLimpid["time"] = FigureOf(limpidSeconds);
  ofLimpid["F"] = limpid.BestEnergy().Total();
  ofLimpid["S"] = Checked(scene, limpid.BestScore().visibility, limpid.Extinction(), options);
  result["paper"] = ofPaper;
  result["limpid"] = ofLimpid;
  return result;
}
}

Json TimeRuns(const SceneOfFile& scene, int repeats)
{
  Rounds on;
  Rounds off;
  Json result;
  for (int repeat = -1; repeat < repeats; ++repeat)
  {
    for (const bool skip : { true, false })
    {
      Settings settings;
      settings.skipUnneeded = skip;
      Stopwatch watch;
      Solver solver = scene.MakeSolver(settings);
      const double setup = watch.Lap();
      bool done = solver.Step(1);
      const double first = watch.Lap();
      std::vector<double> later;
      double whole = setup + first;
      while (!done && (repeat >= 0 || later.empty()))
      {
        done = solver.Step(1);
        later.push_back(watch.Lap());
        whole += later.back();
      }
      if (repeat < 0) // warms up
      {
        continue;
      }
      Rounds& kept = skip ? on : off;
      kept["setup"].push_back(setup);
      kept["first"].push_back(first);
      kept["ready"].push_back(setup + first);
      kept["later"].push_back(Median(later));
      kept["whole"].push_back(whole);
      if (skip)
      {
        result["iterations"] = solver.Iterations();
      }
    }
  }
  result["skips on"] = MediansOf(on);
  result["skips off"] = MediansOf(off);
  return result;
}

void MeasureSolvers(const Options& options, Json& results, const std::function<void()>& save)
{
  std::vector<Json> memory;
  for (const std::string& path : options.words) // first: children must not inherit threads
  {
    Say("memory, " + path);
    memory.push_back(options.Has("parts", "memory") ? MemoryOf(path) : Json());
  }
  for (std::size_t n = 0; n < options.words.size(); ++n)
  {
    const SceneOfFile scene(options.words[n]);
    Json result{ { "scene", scene.name }, { "nodes", ToJson(scene.grid.nodes) },
      { "memory", memory[n] } };
    Say(scene.name);
    if (options.Has("parts", "quality"))
    {
      result["quality"] = QualityOf(scene, options);
    }
    if (options.Has("parts", "time"))
    {
      result["time"] = TimeRuns(scene, options.Count("repeats"));
    }
    if (options.Has("parts", "paper"))
    {
      result["paper"] = AgainstPaper(scene, options);
    }
    results["scenes"].push_back(result);
    save();
  }
}
}
