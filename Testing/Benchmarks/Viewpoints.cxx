// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Viewpoints.h"

#include "Markdown.h"
#include "Timing.h"

#include "backend/Backend.h"
#include "viewpoint/Search.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace limpid::benchmark
{
namespace
{
constexpr int searchDirections = 642; // the filter's default
constexpr int timedDirections = 8;    // of single scores
constexpr int marchedDirections = 8;

/// Evenly spread over the sphere, by the golden angle.
std::vector<Vec3> SpreadDirections(int count)
{
  const double goldenAngle = std::acos(-1.0) * (3 - std::sqrt(5.0));
  std::vector<Vec3> directions;
  for (int i = 0; i < count; ++i)
  {
    const double z = 1 - 2 * (i + 0.5) / count;
    const double r = std::sqrt(1 - z * z);
    directions.emplace_back(
      r * std::cos(goldenAngle * (i + 0.5)), r * std::sin(goldenAngle * (i + 0.5)), z);
  }
  return directions;
}

/// The filter's default.
Orbit OrbitOf(const Grid& grid)
{
  Orbit orbit;
  orbit.centre = grid.Centre();
  orbit.distance = 3 * grid.Radius();
  return orbit;
}

/// The filter's default for that many directions.
SearchSettings SettingsFor(int directions)
{
  const double area = 4 * std::acos(-1.0) / directions;
  SearchSettings settings;
  settings.firstStep = 0.5 * std::sqrt(2 / std::sqrt(3.0) * area); // half of a triangle's side
  return settings;
}

/// A scene with one of the extinctions that a search may look at.
struct Searched
{
  const Scene& scene;
  std::string field;
  std::vector<float> extinction; // [1/length]

  ViewScore MakeScore(double rayDensity) const
  {
    return ViewScore(scene.grid, extinction.data(), scene.file.importance.data(), rayDensity);
  }
};

/// What is important, as dense as the scene gets, and nothing else (Section 3.4).
Searched ProxyOf(const Scene& scene)
{
  const auto& base = scene.file.extinction;
  const float majorant = *std::max_element(base.begin(), base.end());
  std::vector<float> proxy(scene.file.importance.begin(), scene.file.importance.end());
  std::for_each(proxy.begin(), proxy.end(), [=](float& value) { value *= majorant; });
  return { scene, "proxy", std::move(proxy) };
}

double FilledShare(const Searched& searched)
{
  std::size_t filled = 0;
  for (std::size_t node = 0; node < searched.extinction.size(); ++node)
  {
    filled += searched.extinction[node] > 0 || searched.scene.file.importance[node] > 0 ? 1 : 0;
  }
  return double(filled) / double(searched.extinction.size());
}

/// Mean wall time of an evaluation, one after the other [s].
template <class Evaluate>
double TimePerDirection(const std::vector<Vec3>& directions, const Orbit& orbit, Evaluate evaluate)
{
  Stopwatch watch;
  for (const Vec3& direction : directions)
  {
    evaluate(orbit.At(direction));
  }
  return watch.Lap() / double(directions.size());
}

double TimePerScore(const ViewScore& score, const Orbit& orbit)
{
  return TimePerDirection(
    SpreadDirections(timedDirections), orbit, [&](const Camera& camera) { score.At(camera); });
}

double TimePerSlope(const ViewScore& score, const Orbit& orbit)
{
  return TimePerDirection(
    SpreadDirections(timedDirections), orbit, [&](const Camera& camera) { score.SlopeAt(camera); });
}

SearchTimes TimeSearch(const Searched& searched, SearchResultTimes& result)
{
  const Orbit orbit = OrbitOf(searched.scene.grid);
  const std::vector<Vec3> directions = SpreadDirections(searchDirections);
  SearchTimes times;
  Stopwatch watch;
  const ViewScore score = searched.MakeScore(1);
  times.fields = watch.Lap();
  const std::vector<ScoredView> samples = ScoreViews(score, orbit, directions, nullptr);
  times.directions = watch.Lap();
  const SearchResult found =
    FindViewpoints(score, orbit, samples, SettingsFor(searchDirections), nullptr);
  times.climbs = watch.Lap();
  times.whole = times.fields + times.directions + times.climbs;
  times.score = TimePerScore(score, orbit);
  times.slope = TimePerSlope(score, orbit);

  result.evaluations = found.evaluations;
  const auto shareOf = [](const ScoredView& view)
  { return view.score.unattenuated > 0 ? view.score.visible / view.score.unattenuated : 0; };
  result.best = found.viewpoints.empty() ? 0 : shareOf(found.viewpoints.front());
  result.worst = shareOf(*std::min_element(samples.begin(), samples.end(),
    [](const ScoredView& a, const ScoredView& b) { return a.score.visible < b.score.visible; }));
  return times;
}

void TakeMedians(const std::vector<SearchTimes>& runs, SearchResultTimes& result)
{
  for (double SearchTimes::*part : { &SearchTimes::fields, &SearchTimes::score, &SearchTimes::slope,
         &SearchTimes::directions, &SearchTimes::climbs, &SearchTimes::whole })
  {
    std::vector<double> values;
    for (const SearchTimes& run : runs)
    {
      values.push_back(run.*part);
    }
    result.median.*part = Median(values);
    result.spread = Spread(values); // the last part is the whole
  }
}

/// Scores of some directions by the march [length^2].
std::vector<double> MarchedScores(
  const Searched& searched, const std::vector<Vec3>& directions, double raysPerVoxel)
{
  const Orbit orbit = OrbitOf(searched.scene.grid);
  truth::Sampling sampling;
  sampling.raysPerVoxel = raysPerVoxel;
  sampling.threads = static_cast<unsigned>(ThreadCount());
  std::vector<double> scores;
  for (const Vec3& direction : directions)
  {
    const Vec3 position = orbit.At(direction).position;
    scores.push_back(truth::VisibilityScore(searched.scene.file.FieldsWith(searched.extinction),
      truth::Source::Point({ { position.x, position.y, position.z } }), sampling));
  }
  return scores;
}

std::vector<DensityResult> MeasureDensities(const Searched& searched, const Options& options)
{
  const std::vector<Vec3> directions = SpreadDirections(marchedDirections);
  const std::vector<double> truths = MarchedScores(searched, directions, options.marchRays);
  const Orbit orbit = OrbitOf(searched.scene.grid);
  std::vector<DensityResult> results;
  std::vector<ViewScore> scores;
  std::vector<std::vector<double>> seconds;
  for (const double rayDensity : { 1.0, 1.5, 2.0, 3.0 })
  {
    DensityResult result;
    result.rayDensity = rayDensity;
    scores.push_back(searched.MakeScore(rayDensity));
    for (std::size_t i = 0; i < directions.size(); ++i)
    {
      const double score = scores.back().At(orbit.At(directions[i])).visible;
      const double error = truths[i] > 0 ? std::abs(score / truths[i] - 1) : 0;
      result.meanError += error / double(directions.size());
      result.largestError = std::max(result.largestError, error);
    }
    results.push_back(result);
  }
  seconds.resize(scores.size());
  for (int repeat = 0; repeat < options.repeats; ++repeat)
  {
    for (std::size_t i = 0; i < scores.size(); ++i) // in turns
    {
      seconds[i].push_back(TimePerScore(scores[i], orbit));
    }
  }
  for (std::size_t i = 0; i < scores.size(); ++i)
  {
    results[i].score = Median(seconds[i]);
  }
  return results;
}

std::string Percent(double share, int decimals)
{
  return Fixed(100 * share, decimals) + " %";
}

void WriteTimes(std::ostream& stream, const std::vector<ViewpointResult>& results)
{
  Table table({ "scene", "field", "nodes", "not empty", "setup [ms]", "score [ms]",
    "score and slope [ms]", "slope / score", "642 directions [s]", "climbs [s]", "search [s]",
    "evaluations", "visible, worst → best", "spread" });
  bool noisy = false;
  for (const ViewpointResult& result : results)
  {
    const SearchTimes& times = result.search.median;
    noisy |= result.search.spread > 0.2;
    table.Add({ result.scene, result.field, Sizes(result.nodes), Percent(result.filled, 1),
      Milliseconds(times.fields), Milliseconds(times.score), Milliseconds(times.slope),
      Fixed(times.slope / times.score, 1), Significant(times.directions, 3),
      Significant(times.climbs, 3), Significant(times.whole, 3),
      std::to_string(result.search.evaluations),
      Fixed(100 * result.search.worst, 1) + " → " + Percent(result.search.best, 1),
      Percent(result.search.spread, 0) });
  }
  table.Write(stream);
  if (noisy)
  {
    stream << "**The machine was busy while this was measured (a spread above 20 %): all times are "
              "preliminary.**\n\n";
  }
}

void WriteDensities(std::ostream& stream, const std::vector<ViewpointResult>& results)
{
  std::vector<std::string> headings{ "scene", "field" };
  for (const DensityResult& density : results.front().densities)
  {
    headings.push_back("ρ = " + Significant(density.rayDensity, 2) + ": score [ms]");
    headings.push_back("mean error");
    headings.push_back("largest");
  }
  Table table(headings);
  for (const ViewpointResult& result : results)
  {
    std::vector<std::string> row{ result.scene, result.field };
    for (const DensityResult& density : result.densities)
    {
      row.push_back(Milliseconds(density.score));
      row.push_back(Percent(density.meanError, 3));
      row.push_back(Percent(density.largestError, 3));
    }
    table.Add(row);
  }
  table.Write(stream);
}
}

std::vector<ViewpointResult> MeasureViewpoints(const Scene& scene, const Options& options)
{
  const std::vector<Searched> fields{ ProxyOf(scene), { scene, "base", scene.file.extinction } };
  std::vector<ViewpointResult> results(fields.size());
  std::vector<std::vector<SearchTimes>> runs(fields.size());
  for (const Searched& field : fields) // warms up
  {
    TimePerSlope(field.MakeScore(1), OrbitOf(scene.grid));
  }
  for (int repeat = 0; repeat < options.repeats; ++repeat)
  {
    for (std::size_t i = 0; i < fields.size(); ++i) // in turns
    {
      runs[i].push_back(TimeSearch(fields[i], results[i].search));
    }
  }
  for (std::size_t i = 0; i < fields.size(); ++i)
  {
    results[i].scene = scene.file.name;
    results[i].field = fields[i].field;
    results[i].nodes = scene.grid.nodes;
    results[i].filled = FilledShare(fields[i]);
    TakeMedians(runs[i], results[i].search);
    results[i].densities = MeasureDensities(fields[i], options);
  }
  return results;
}

void WriteViewpoints(
  std::ostream& stream, const std::vector<ViewpointResult>& results, const Options& options)
{
  stream << "\n## A search\n\n"
         << "Cameras at three radii, rays one per voxel and axis, " << ThreadCount()
         << " threads, wall time, medians of " << options.repeats << " runs. Score, and score and "
         << "slope: one direction after the other, mean over " << timedDirections
         << ". Search: setup, " << searchDirections << " directions, and climbs from the best.\n";
  WriteTimes(stream, results);
  stream << "## Run time against error\n\n"
         << "S of " << marchedDirections << " directions against the march of Testing/Reference: "
         << "double precision, " << Significant(options.marchRays, 2)
         << " rays per voxel and axis, four Gauss points in every piece of a cell, no code of the "
            "sweeps. ρ: rays per voxel and axis of the sweep; times as above.\n";
  WriteDensities(stream, results);
}
}
