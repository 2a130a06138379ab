// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How close results come to the ceiling, and whether the ceiling ranks views as full runs do.
// Prints a page in Markdown.
//   limpid_ceilings SCENE.scene.json...

#include "CeilingMarch.h"
#include "SceneForSolver.h"
#include "Today.h"

#include "optimize/PreparedScene.h"
#include "viewpoint/Search.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <numeric>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
constexpr int directionCount = 32;

const char* const page =
  R"(This page has the bounds that no extinction can exceed ([Method.md](../Method.md), 5), for the scenes of the tests
(`Testing/Benchmarks/limpid_ceilings.cxx`):

    build/bin/limpid_ceilings SCENE.scene.json ... > Documentation/Benchmarks/Ceilings.md

## Results below their ceilings

The table has S and the visible fraction of two kinds of runs, with light, over their ceilings of the camera alone. The first kind
has the values of the preset *Paper*. The second has *Protect Importance* 1, *Median* and *Smoothness* 0.2 of the display, and
otherwise the values of *Paper* (Emphasis 1, no Clearing Threshold).

| scene | *Paper*: S / ceiling | visible / at most | protected: S / ceiling | visible / at most |
| --- | ---: | ---: | ---: | ---: |
)";

const char* const marchPage =
  R"(
## Against an independent march

The table has the largest difference from an independent march over protection 0 and 1 and emphasis 0 and 1. S is the difference of
the ceiling of S in percent, *fraction* that of the ceiling of the visible fraction. The march has double precision, 1.5 rays per voxel and
16 steps per cell, and shares no code with the core (`Testing/Reference/CeilingMarch.h`).

| scene | S | fraction |
| --- | ---: | ---: |
)";

const char* const viewsPage =
  R"(
## Views

There are 32 directions (Fibonacci, at three radii). The table has rank correlations (Spearman) with the visible fraction after a full run
for each direction, with the protected values and a light beside the camera. The correlated quantities are the ceiling, the proxy and the
base extinction. *Best* is the visible fraction of the direction with the highest ceiling, over the largest one. Times are processor times
per direction, and the score is that of the base extinction.

| scene | ceiling | proxy | base | best | score [ms] | ceiling [ms] | ratio | full run [ms] |
| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |
)";

/// CPU time of all threads, independent of other programs [s].
double ProcessorSeconds()
{
  return double(std::clock()) / CLOCKS_PER_SEC;
}

Settings OfDisplay()
{
  Settings settings;
  settings.protectImportance = 1;
  settings.importanceSmoothing = ImportanceSmoothing::Median;
  settings.smoothness = 0.2;
  return settings;
}

void ReportResults(const SceneOfFile& scene)
{
  std::printf("| %s |", scene.name.c_str());
  for (const Settings& settings : { Settings(), OfDisplay() })
  {
    Solver solver = scene.MakeSolver(settings);
    solver.Run();
    const Score found = solver.BestScore();
    const Ceiling most = solver.FindCeiling();
    std::printf(" %.6g / %.6g (%.1f %%) | %.1f / %.1f %% |", found.visibility, most.visibility,
      100 * found.visibility / most.visibility, 100 * found.fraction, 100 * most.fraction);
  }
  std::printf("\n");
  std::fflush(stdout);
}

/// The ceiling of the march with an upper bound.
double MarchOf(const SceneOfFile& scene, double protect, double emphasis)
{
  const float majorant = *std::max_element(scene.extinction.begin(), scene.extinction.end());
  std::vector<float> least(scene.extinction.size());
  std::vector<float> most(scene.extinction.size());
  for (std::size_t node = 0; node < least.size(); ++node)
  {
    const double base = scene.extinction[node];
    least[node] = static_cast<float>(protect * scene.importance[node] * base);
    most[node] = static_cast<float>(base + emphasis * (majorant - base));
  }
  truth::Sampling sampling;
  sampling.raysPerVoxel = 1.5;
  sampling.samplesPerVoxel = 16;
  return truth::CeilingOf(
    { scene.file.lattice, scene.importance.data(), least.data(), most.data() }, scene.file.Eye(),
    sampling);
}

void ReportMarch(const SceneOfFile& scene)
{
  const double important = truth::ImportantExtinction(scene.file.FieldsWith(scene.extinction));
  double ofScore = 0;
  double ofFraction = 0;
  for (const double protect : { 0.0, 1.0 })
  {
    Settings settings;
    settings.protectImportance = protect;
    settings.maximumIterations = 0;
    const Ceiling ceiling = scene.MakeSolver(settings).FindCeiling();
    const double expected = MarchOf(scene, protect, 1);
    const double fraction = MarchOf(scene, protect, 0) / important;
    ofScore = std::max(ofScore, std::abs(ceiling.visibility / expected - 1));
    ofFraction = std::max(ofFraction, std::abs(ceiling.fraction - fraction));
  }
  std::printf("| %s | %.3f %% | %.5f |\n", scene.name.c_str(), 100 * ofScore, ofFraction);
  std::fflush(stdout);
}

std::vector<Vec3> Directions()
{
  const double goldenAngle = std::acos(-1.0) * (3 - std::sqrt(5.0));
  std::vector<Vec3> directions;
  for (int i = 0; i < directionCount; ++i)
  {
    const double height = 1 - (2 * i + 1) / double(directionCount);
    const double radius = std::sqrt(1 - height * height);
    directions.emplace_back(
      radius * std::cos(goldenAngle * i), height, radius * std::sin(goldenAngle * i));
  }
  return directions;
}

std::vector<double> RanksOf(const std::vector<double>& values)
{
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t place = 0; place < order.size(); ++place)
  {
    ranks[order[place]] = double(place);
  }
  return ranks;
}

/// Spearman's, of values without ties.
double RankCorrelation(const std::vector<double>& a, const std::vector<double>& b)
{
  const std::vector<double> one = RanksOf(a);
  const std::vector<double> other = RanksOf(b);
  double squares = 0;
  for (std::size_t i = 0; i < one.size(); ++i)
  {
    squares += std::pow(one[i] - other[i], 2);
  }
  const auto n = double(one.size());
  return 1 - 6 * squares / (n * (n * n - 1));
}

struct Scores
{
  std::vector<double> values;
  double seconds; ///< per direction
};

Scores ScoresOf(const SceneOfFile& scene, const Orbit& orbit, const ViewedFields& viewed)
{
  const ViewScore score(scene.grid, viewed, 1);
  score.At(orbit.At(Vec3(0, 0, 1))); // to warm up
  Scores scores;
  const double start = ProcessorSeconds();
  for (const Vec3& direction : Directions())
  {
    scores.values.push_back(score.At(orbit.At(direction)).visibility);
  }
  scores.seconds = (ProcessorSeconds() - start) / directionCount;
  return scores;
}

Light LightBeside(const Camera& camera, const Orbit& orbit)
{
  const Vec3 back = glm::normalize(camera.position - orbit.centre);
  const Vec3 right = glm::cross(camera.viewUp, back);
  Light light;
  light.position =
    orbit.centre + orbit.distance * glm::normalize(back + 0.5 * camera.viewUp + 0.3 * right);
  light.focalPoint = orbit.centre;
  return light;
}

Scores FullRuns(
  const std::shared_ptr<PreparedScene>& scene, const Orbit& orbit, const Settings& settings)
{
  Scores scores;
  const double start = ProcessorSeconds();
  for (const Vec3& direction : Directions())
  {
    const Camera camera = orbit.At(direction);
    Solver solver(scene, camera, LightBeside(camera, orbit), settings);
    solver.Run();
    scores.values.push_back(solver.BestScore().fraction);
  }
  scores.seconds = (ProcessorSeconds() - start) / directionCount;
  return scores;
}

void ReportViews(const SceneOfFile& scene)
{
  Orbit orbit;
  orbit.centre = scene.grid.Centre();
  orbit.distance = 3 * scene.grid.Radius();
  const Settings settings = OfDisplay();
  const auto prepared = std::make_shared<PreparedScene>(scene.Fields());
  const NodeValues least = prepared->LeastExtinction(settings);
  const float* base = scene.extinction.data();
  const float* importance = scene.importance.data();
  ViewedFields attainable{ base, importance };
  attainable.attainable = true;
  attainable.least = least.Data();
  const std::vector<float> proxy = scene.Proxy();

  const Scores ceilings = ScoresOf(scene, orbit, attainable);
  const Scores ofProxy = ScoresOf(scene, orbit, { proxy.data(), importance, base });
  const Scores ofBase = ScoresOf(scene, orbit, { base, importance });
  const Scores runs = FullRuns(prepared, orbit, settings);

  const auto best =
    std::max_element(ceilings.values.begin(), ceilings.values.end()) - ceilings.values.begin();
  const double most = *std::max_element(runs.values.begin(), runs.values.end());
  std::printf("| %s | %.4f | %.4f | %.4f | %.1f %% | %.1f | %.1f | %.2f | %.0f |\n",
    scene.name.c_str(), RankCorrelation(ceilings.values, runs.values),
    RankCorrelation(ofProxy.values, runs.values), RankCorrelation(ofBase.values, runs.values),
    100 * runs.values[std::size_t(best)] / most, 1e3 * ofBase.seconds, 1e3 * ceilings.seconds,
    ceilings.seconds / ofBase.seconds, 1e3 * runs.seconds);
  std::fflush(stdout);
}
}

int main(int argc, char* argv[])
{
  if (argc < 2)
  {
    std::fprintf(stderr, "usage: limpid_ceilings SCENE.scene.json...\n");
    return EXIT_FAILURE;
  }
  try
  {
    const std::vector<std::string> paths(argv + 1, argv + argc);
    using Report = void (*)(const SceneOfFile&);
    const std::pair<const char*, Report> parts[] = { { page, ReportResults },
      { viewsPage, ReportViews }, { marchPage, ReportMarch } };
    std::printf("# Ceilings\n\n* date: %s\n\n", Today().c_str());
    for (const auto& [head, report] : parts)
    {
      std::printf("%s", head);
      for (const std::string& path : paths)
      {
        report(SceneOfFile(path));
      }
    }
    return EXIT_SUCCESS;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return EXIT_FAILURE;
  }
}
