// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Measure.h"
#include "Volume.h"

#include "backend/Backend.h"

#include <cmath>

namespace limpid::benchmark
{
namespace
{
constexpr int searchDirections = 642; // the filter's default
constexpr int fewDirections = 8;      // of single scores, timed and marched

/// A scene with one of the extinctions that a search may look at.
struct Searched
{
  const SceneOfFile& scene;
  std::string field;
  std::vector<float> extinction; // [1/length]

  ViewScore MakeScore(double rayDensity) const
  {
    return ViewScore(scene.grid, { extinction.data(), scene.importance.data() }, rayDensity);
  }
};

double FilledShare(const Searched& searched)
{
  std::size_t filled = 0;
  for (std::size_t node = 0; node < searched.extinction.size(); ++node)
  {
    filled += searched.extinction[node] > 0 || searched.scene.importance[node] > 0 ? 1 : 0;
  }
  return double(filled) / double(searched.extinction.size());
}

/// Mean time of what is done for some cameras, one after the other.
template <class Evaluate>
double TimePerCamera(const Orbit& orbit, Evaluate evaluate)
{
  Stopwatch watch;
  for (const Vec3& direction : SpreadDirections(fewDirections))
  {
    evaluate(orbit.At(direction));
  }
  return watch.Lap() / fewDirections;
}

double TimePerScore(const ViewScore& score, const Orbit& orbit)
{
  return TimePerCamera(orbit, [&](const Camera& camera) { score.At(camera); });
}

/// One search with the filter's defaults; `result` gets what it finds.
void Search(const Searched& searched, Rounds& rounds, Json& result)
{
  const Orbit orbit = OrbitAround(searched.scene.grid);
  SearchSettings settings; // the first step is half the side of a triangle between directions
  settings.firstStep = 0.5 * std::sqrt(2 / std::sqrt(3.0) * 4 * std::acos(-1.0) / searchDirections);
  Stopwatch whole;
  Stopwatch watch;
  const auto lap = [&](const char* part) { rounds[part].push_back(watch.Lap()); };
  const ViewScore score = searched.MakeScore(1);
  lap("setup");
  const std::vector<ScoredView> samples =
    ScoreViews(score, orbit, SpreadDirections(searchDirections), nullptr);
  lap("directions");
  const SearchResult found = FindViewpoints(score, orbit, samples, settings, nullptr);
  lap("climbs");
  rounds["search"].push_back(whole.Lap());
  rounds["score"].push_back(TimePerScore(score, orbit));
  rounds["slope"].push_back(
    TimePerCamera(orbit, [&](const Camera& camera) { score.SlopeAt(camera); }));

  result["evaluations"] = found.evaluations;
  result["best"] = found.viewpoints.empty() ? 0 : found.viewpoints.front().score.fraction;
  result["worst"] = std::max_element(samples.begin(), samples.end(), IsBetter)->score.fraction;
}

/// S of some directions by sweeps of several ray densities, against the march.
Json MeasureDensities(const Searched& searched, const Options& options)
{
  const SceneOfFile& scene = searched.scene;
  const Orbit orbit = OrbitAround(scene.grid);
  truth::Sampling sampling;
  sampling.raysPerVoxel = options.Number("march-rays");
  sampling.threads = static_cast<unsigned>(ThreadCount());
  std::vector<double> truths;
  for (const Vec3& direction : SpreadDirections(fewDirections))
  {
    const Vec3 position = orbit.At(direction).position;
    truths.push_back(truth::VisibilityScore(scene.file.FieldsWith(searched.extinction),
      truth::Source::Point({ { position.x, position.y, position.z } }), sampling));
  }
  const std::vector<double> rayDensities{ 1.0, 1.5, 2.0, 3.0 };
  std::vector<ViewScore> scores;
  Json results;
  for (const double rayDensity : rayDensities)
  {
    scores.push_back(searched.MakeScore(rayDensity));
    double mean = 0;
    double largest = 0;
    for (std::size_t i = 0; i < truths.size(); ++i)
    {
      const Camera camera = orbit.At(SpreadDirections(fewDirections)[i]);
      const double error =
        truths[i] > 0 ? std::abs(scores.back().At(camera).visibility / truths[i] - 1) : 0;
      mean += error / double(truths.size());
      largest = std::max(largest, error);
    }
    results.push_back(
      { { "ray_density", rayDensity }, { "mean_error", mean }, { "largest_error", largest } });
  }
  std::vector<std::vector<double>> seconds(scores.size());
  for (int repeat = 0; repeat < options.Count("repeats"); ++repeat)
  {
    for (std::size_t i = 0; i < scores.size(); ++i) // in turns
    {
      seconds[i].push_back(TimePerScore(scores[i], orbit));
    }
  }
  for (std::size_t i = 0; i < scores.size(); ++i)
  {
    results[i]["seconds"] = Median(seconds[i]);
  }
  return results;
}
}

Json MeasureViewpoints(const SceneOfFile& scene, const Options& options)
{
  const std::vector<Searched> fields{ { scene, "proxy", scene.Proxy() },
    { scene, "base", scene.extinction } };
  std::vector<Rounds> rounds(fields.size());
  Json results;
  for (const Searched& field : fields)
  {
    results.push_back({ { "field", field.field }, { "filled", FilledShare(field) } });
    TimePerScore(field.MakeScore(1), OrbitAround(scene.grid)); // warms up
  }
  for (int repeat = 0; repeat < options.Count("repeats"); ++repeat)
  {
    for (std::size_t i = 0; i < fields.size(); ++i) // in turns
    {
      Search(fields[i], rounds[i], results[i]);
    }
  }
  for (std::size_t i = 0; i < fields.size(); ++i)
  {
    results[i].update(MediansOf(rounds[i]));
    results[i]["densities"] = MeasureDensities(fields[i], options);
  }
  return { { "scene", scene.name }, { "nodes", ToJson(scene.grid.nodes) },
    { "directions", searchDirections }, { "timed_directions", fewDirections },
    { "fields", results } };
}
}
