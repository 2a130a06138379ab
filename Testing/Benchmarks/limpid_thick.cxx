// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How exact scores are, and how long runs take and how low they end, where matter stops most light
// from one node to the next. Prints a page in Markdown.
//   limpid_thick [--quick] SCENE.scene.json...
// --quick: one run of each and a tiny onion, to see whether the program works.

#include "LeastEnergy.h"
#include "Program.h"
#include "SceneForSolver.h"
#include "Volume.h"

#include "Resampled.h"
#include "optimize/Presets.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using namespace limpid;

namespace
{
const char* const head =
  R"(# Thick media: run time against error

[README.md](README.md) explains the tables. The command of this page is `build/bin/limpid_thick SCENE.scene.json ... > Documentation/Benchmarks/Thick.md`.
Its numbers are from

    %s

* processor: %s, %d cores visible, %d threads used
* compiler: %s, build type %s
* date: %s
* load average before the start: %.2f

Runs of each: %d. Times are their medians: wall clock, and processor seconds of all threads.
)";

const char* const rampHead =
  R"(
## The default ramp

The opacity is ParaView's default: 0 to 1 over the range of the data, with a unit distance of one cell. The top 3 % of the data are
important. The march has 3 rays per voxel and axis.

)";

const char* const ownHead =
  R"(
## Own functions

The scenes have their own transfer functions of opacity and importance, and the same march.

)";

const char* const onionHead =
  R"(
## Onion

The scene is a core in a shell on %d³ nodes, with a majorant scaled from thin to opaque. It has the display's *Clearing Threshold* (%g).
With the paper's weight, as above, the thickest shells would not be cleared at all. The march samples the same trilinear fields on four
times as many nodes along each axis, with half a ray for each of these.

)";

/// How much is measured.
struct Amount
{
  int runs = 3;
  int onionNodes = 48;                                                       ///< along each axis
  std::vector<double> onionDepths{ 0.1, 0.3, 1, 3, 10, 30, 100, 300, 1000 }; ///< node to node
};

Amount QuickAmount()
{
  return { 1, 12, { 1, 10 } };
}

/// S of an extinction on the nodes of a scene by an independent march [length^2].
using March = std::function<double(const std::vector<float>& extinction)>;

/// A march through the trilinear fields of a scene on four times as many nodes along each axis.
/// The axes of the scene's grid are those of the world.
class FineMarch
{
public:
  explicit FineMarch(const SceneForSolver& scene)
    : Coarse(scene.grid)
    , Fine(scene.grid)
    , Eye(truth::Source::Point(
        { { scene.camera.position.x, scene.camera.position.y, scene.camera.position.z } }))
  {
    this->Fine.nodes = (scene.grid.nodes - 1) * finer + 1;
    this->Fine.spacing = scene.grid.spacing / double(finer);
    this->Importance = Resampled(this->Coarse, scene.importance.data(), this->Fine);
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Lattice.nodes[axis] = this->Fine.nodes[axis];
      this->Lattice.origin[axis] = this->Fine.origin[axis];
      this->Lattice.spacing[axis] = this->Fine.spacing[axis];
    }
  }

  double operator()(const std::vector<float>& extinction) const
  {
    const std::vector<float> fine = Resampled(this->Coarse, extinction.data(), this->Fine);
    truth::Sampling sampling;
    sampling.raysPerVoxel = 0.5;
    return truth::VisibilityScore(
      truth::Volume<float>{ this->Lattice, fine.data(), this->Importance.data() }, this->Eye,
      sampling);
  }

private:
  static constexpr int finer = 4;

  Grid Coarse;
  Grid Fine;
  truth::Lattice Lattice;
  truth::Source Eye;
  std::vector<float> Importance; ///< at the nodes of the fine grid [0, 1]
};

/// A solver that has run, and how long that took, with its setup.
struct TimedRun
{
  Solver solver;
  double seconds;          ///< wall clock
  double processorSeconds; ///< of all threads
};

TimedRun RunOf(const SceneForSolver& scene, const Settings& settings, int runs)
{
  std::optional<Solver> solver;
  std::vector<double> seconds;
  std::vector<double> processorSeconds;
  for (int run = 0; run < runs; ++run)
  {
    solver.reset(); // its memory is not the next one's
    const std::clock_t before = std::clock();
    benchmark::Stopwatch stopwatch;
    solver.emplace(scene.MakeSolver(settings));
    solver->Run();
    seconds.push_back(stopwatch.Lap());
    processorSeconds.push_back(double(std::clock() - before) / CLOCKS_PER_SEC);
  }
  return { std::move(*solver), benchmark::Median(seconds), benchmark::Median(processorSeconds) };
}

void PrintColumns()
{
  const char* const columns[] = { "protect", "depth", "S, base", "error", "S, result", "error",
    "F, policy", "F, Adam", "difference", "policy [s]", "processor [s]", "Adam [s]",
    "processor [s]", "S / ceiling", "visible", "base", "at most" };
  std::printf("| scene |");
  for (const char* const column : columns)
  {
    std::printf(" %s |", column);
  }
  std::printf("\n| --- |");
  for (std::size_t column = 0; column < std::size(columns); ++column)
  {
    std::printf(" ---: |");
  }
  std::printf("\n");
}

/// How far a value is from another one, or a dash where that is next to nothing beside it, or
/// beside `most`.
void PrintDifference(double value, double other, double most)
{
  if (std::abs(other) <= std::max(1e-6 * std::abs(most), 1e-4 * std::abs(value)))
  {
    std::printf(" – |");
    return;
  }
  std::printf(" %+.3f %% |", 100 * (value - other) / std::abs(other));
}

/// What a solver says of S, and how far it is from the march.
void PrintScore(const Score& reported, double march, const Ceiling& most)
{
  std::printf(" %.6g |", reported.visibility);
  PrintDifference(reported.visibility, march, most.visibility);
}

/// `least`: a lower bound.
void PrintEnergies(const Solver& policy, const Solver& adam, double least)
{
  const double found = policy.BestEnergy().Total();
  const double other = adam.BestEnergy().Total();
  std::printf(" %.6g | %.6g |", found, other);
  PrintDifference(found, other, least);
}

void PrintTimes(const TimedRun& run)
{
  std::printf(" %.3f | %.3f |", run.seconds, run.processorSeconds);
}

/// How much is seen, and how much of what can be.
void PrintVisible(const Solver& solver, const Ceiling& most)
{
  const Score found = solver.BestScore();
  std::printf(" %.1f %% | %.1f %% | %.1f %% | %.1f %% |", 100 * found.visibility / most.visibility,
    100 * found.fraction, 100 * solver.BaseScore().fraction, 100 * most.fraction);
}

/// One row. `base`: S of the base extinction by the march [length^2].
void ReportRun(
  const SceneForSolver& scene, Settings settings, const March& march, double base, int runs)
{
  const TimedRun policy = RunOf(scene, settings, runs);
  settings.solver = SolverKind::Adam;
  const TimedRun adam = RunOf(scene, settings, runs);

  const Solver& solver = policy.solver;
  const Ceiling most = solver.FindCeiling();
  const double depth = solver.Majorant() * std::cbrt(scene.grid.CellVolume());
  std::printf("| %s | %g | %.4g |", scene.name.c_str(), settings.protectImportance, depth);
  PrintScore(solver.BaseScore(), base, most);
  PrintScore(solver.BestScore(), march(solver.Extinction()), most);
  PrintEnergies(
    solver, adam.solver, LeastEnergyOf(scene.Fields(), scene.camera, scene.light, settings));
  PrintTimes(policy);
  PrintTimes(adam);
  PrintVisible(solver, most);
  std::printf("\n");
  std::fflush(stdout);
}

/// A row with the display's bounds, and one where important structures may be removed.
void ReportRuns(const SceneForSolver& scene, Settings settings, const March& march, int runs)
{
  const double base = march(scene.extinction);
  settings.emphasis = 0;
  for (const double protect : { 1.0, 0.0 })
  {
    settings.protectImportance = protect;
    ReportRun(scene, settings, march, base, runs);
  }
}

void ReportScene(const SceneOfFile& scene, int runs)
{
  const auto march = [&](const std::vector<float>& extinction) { return scene.March(extinction); };
  ReportRuns(scene, Settings(), march, runs);
}

/// `depth`: of the majorant from node to node.
SceneForSolver MakeOnion(int nodes, double depth)
{
  SceneForSolver onion = benchmark::MakeVolume("onion", nodes);
  const float majorant = *std::max_element(onion.extinction.begin(), onion.extinction.end());
  const double scale = depth / (majorant * std::cbrt(onion.grid.CellVolume()));
  for (float& value : onion.extinction)
  {
    value = static_cast<float>(scale * value);
  }
  return onion;
}

/// With the display's clearing threshold, which does not depend on the density as the paper's
/// weight does.
Settings OnionSettings()
{
  Settings settings;
  settings.clearingThreshold = defaultPreset.clearingThreshold;
  return settings;
}

void PrintHead(const benchmark::Json& machine, int runs)
{
  const auto text = [&](const char* name) { return machine.at(name).get<std::string>(); };
  const auto count = [&](const char* name) { return machine.at(name).get<int>(); };
  const double load = machine.at("load_before").get<double>();
  std::printf(head, text("command").c_str(), text("processor").c_str(), count("cores"),
    count("threads"), text("compiler").c_str(), text("build_type").c_str(), text("date").c_str(),
    load, runs);
  if (load > 0.25 * count("cores"))
  {
    std::printf("\n**The machine was not idle: times are preliminary.** Scores and energies do not "
                "depend on the load.\n");
  }
}

void PrintPage(const std::vector<std::string>& paths, const Amount& amount)
{
  std::fputs(rampHead, stdout);
  PrintColumns();
  for (const std::string& path : paths)
  {
    SceneOfFile scene(path);
    scene.Classify(/*ramp=*/true, 1);
    ReportScene(scene, amount.runs);
  }
  std::fputs(ownHead, stdout);
  PrintColumns();
  for (const std::string& path : paths)
  {
    ReportScene(SceneOfFile(path), amount.runs);
  }
  std::printf(onionHead, amount.onionNodes, OnionSettings().clearingThreshold);
  PrintColumns();
  for (const double depth : amount.onionDepths)
  {
    const SceneForSolver onion = MakeOnion(amount.onionNodes, depth);
    ReportRuns(onion, OnionSettings(), FineMarch(onion), amount.runs);
  }
}
}

int main(int argc, char* argv[])
{
  try
  {
    const double load = benchmark::LoadAverage();
    const benchmark::Options options(
      std::vector<std::string>(argv + 1, argv + argc), { { "quick", "no" } });
    if (options.words.empty())
    {
      std::fprintf(stderr, "usage: limpid_thick [--quick] SCENE.scene.json...\n");
      return EXIT_FAILURE;
    }
    const Amount amount = options.Flag("quick") ? QuickAmount() : Amount();
    PrintHead(benchmark::Machine({ argv, argv + argc }, load), amount.runs);
    PrintPage(options.words, amount);
    std::printf(
      "\nLoad average at the end: %.2f, this program included.\n", benchmark::LoadAverage());
    return EXIT_SUCCESS;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
}
