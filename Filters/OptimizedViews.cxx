// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "OptimizedViews.h"

#include "backend/Interruption.h"
#include "optimize/Solver.h"
#include "scene/Placement.h"

#include <algorithm>
#include <utility>

namespace limpid
{
namespace
{
// Most rounds of a climb. Each is a solver run, after which the camera moves to the best view of
// that extinction.
constexpr int LargestNumberOfRounds = 4;
}

OptimizedViews::OptimizedViews(
  std::shared_ptr<PreparedScene> scene, const Orbit& orbit, const Settings& settings)
  : Scene(std::move(scene))
  , From(orbit)
  , Options(settings)
{
}

// Returns the scored view from a direction; it is invalid if `goOn` returns false.
ScoredView OptimizedViews::At(
  const Vec3& direction, const GoOn& goOn, std::vector<float>* extinction) const
{
  try
  {
    const Interruptible interruptible(goOn);
    return this->Optimized(direction, extinction);
  }
  catch (const Interrupted&)
  {
    ScoredView view;
    view.direction = direction;
    return view;
  }
}

ScoredView OptimizedViews::Optimized(const Vec3& direction, std::vector<float>* extinction) const
{
  ScoredView view;
  view.direction = direction;
  const Camera camera = this->From.At(direction);
  Light light;
  light.focalPoint = camera.focalPoint;
  PlaceLight(camera, light);
  Solver solver(this->Scene, camera, light, this->Options);
  solver.Run();
  view.score = solver.BestScore();
  view.worth = view.score.fraction;
  view.valid = true;
  if (extinction)
  {
    *extinction = solver.TakeExtinctions()[0].Take();
  }
  return view;
}

std::vector<ScoredView> OptimizedViews::ScoreAll(
  const std::vector<Vec3>& directions, const SearchProgress& progress) const
{
  std::vector<ScoredView> views(directions.size());
  bool stopped = false;
  for (std::size_t i = 0; i < directions.size(); ++i)
  {
    const auto report = [&](std::size_t done)
    {
      stopped = stopped || !progress(double(done) / double(directions.size()));
      return !stopped;
    };
    views[i].direction = directions[i];
    if (!stopped)
    {
      views[i] = this->At(
        directions[i], [&] { return report(i); }, nullptr);
      report(i + 1);
    }
  }
  return views;
}

// Returns the end of a climb with one extinction; no viewpoint if `goOn` returns false.
SearchResult OptimizedViews::Top(const Vec3& start, const std::vector<float>& extinction,
  const SearchSettings& settings, const GoOn& goOn) const
{
  try
  {
    const Interruptible interruptible(goOn);
    const SceneFields& scene = this->Scene->Arrays();
    const ViewScore fixed(
      scene.grid, { extinction.data(), scene.importance }, this->Options.rayDensity);
    return FindViewpoints(fixed, this->From, { ViewAt(fixed, this->From, start) }, settings,
      [&goOn](double) { return goOn(); });
  }
  catch (const Interrupted&)
  {
    return {};
  }
}

// Climbs from a sample, until `goOn` returns false. Returns the number of solver runs, scores and
// derivatives.
Index OptimizedViews::Climb(const ScoredView& sample, const SearchSettings& settings,
  const GoOn& goOn, std::vector<ScoredView>& path) const
{
  Index evaluations = 1;
  std::vector<float> extinction;
  path.push_back(sample);
  const ScoredView start = this->At(sample.direction, goOn, &extinction);
  if (!start.valid)
  {
    return evaluations;
  }
  path.back() = start;
  SearchSettings climb = settings;
  climb.viewpoints = 1;
  for (int round = 0; round < LargestNumberOfRounds; ++round)
  {
    const SearchResult top = this->Top(path.back().direction, extinction, climb, goOn);
    if (top.viewpoints.empty())
    {
      break;
    }
    const ScoredView next = this->At(top.viewpoints.front().direction, goOn, &extinction);
    evaluations += top.evaluations + 1;
    if (!next.valid || !IsBetter(next, path.back()))
    {
      break;
    }
    path.push_back(next);
  }
  return evaluations;
}

SearchResult OptimizedViews::Find(const std::vector<ScoredView>& samples,
  const SearchSettings& settings, const SearchProgress& progress) const
{
  SearchResult result;
  std::vector<ScoredView> candidates = WithAllowed(samples, settings,
    [&](const Vec3& direction)
    {
      return this->At(
        direction, [&] { return progress(0); }, nullptr);
    });
  result.evaluations = std::count_if(
    candidates.begin(), candidates.end(), [](const ScoredView& view) { return view.valid; });
  const std::vector<ScoredView> starts = RankedViews(candidates, settings);
  for (std::size_t i = 0; i < starts.size() && settings.refine; ++i)
  {
    const auto goOn = [&] { return progress(double(i) / double(starts.size())); };
    if (!goOn())
    {
      break;
    }
    result.paths.emplace_back();
    result.evaluations += this->Climb(starts[i], settings, goOn, result.paths.back());
    candidates.push_back(result.paths.back().back());
  }
  result.viewpoints = RankedViews(std::move(candidates), settings);
  return result;
}
}
