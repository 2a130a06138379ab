// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "OptimizedViews.h"

#include "ScenePlacement.h"

#include <algorithm>
#include <utility>

namespace limpid
{
namespace
{
// Rounds of a climb: each is a solver run, and moves the camera as far as one extinction leads.
constexpr int LargestNumberOfRounds = 4;
}

OptimizedViews::OptimizedViews(
  std::shared_ptr<PreparedScene> scene, const Orbit& orbit, const Settings& settings)
  : Scene(std::move(scene))
  , From(orbit)
  , Options(settings)
{
}

ScoredView OptimizedViews::At(const Vec3& direction, std::vector<float>* extinction) const
{
  const Camera camera = this->From.At(direction);
  Light light;
  light.focalPoint = camera.focalPoint;
  PlaceLight(camera, light);
  Solver solver(this->Scene, camera, light, this->Options);
  solver.Run();

  const Score best = solver.BestScore();
  ScoredView view;
  view.direction = direction;
  view.score.visible = best.visibility;
  view.score.unattenuated = best.fraction > 0 ? best.visibility / best.fraction : 0;
  view.valid = true;
  if (extinction)
  {
    *extinction = std::move(solver.TakeExtinctions()[0]);
  }
  return view;
}

std::vector<ScoredView> OptimizedViews::ScoreAll(
  const std::vector<Vec3>& directions, const SearchProgress& progress) const
{
  std::vector<ScoredView> views(directions.size());
  bool goOn = true;
  for (std::size_t i = 0; i < directions.size(); ++i)
  {
    views[i].direction = directions[i];
    if (goOn)
    {
      views[i] = this->At(directions[i], nullptr);
      goOn = progress(double(i + 1) / double(directions.size()));
    }
  }
  return views;
}

// Returns the number of solver runs, scores and derivatives.
Index OptimizedViews::Climb(
  const ScoredView& sample, const SearchSettings& settings, std::vector<ScoredView>& path) const
{
  const SceneFields& scene = this->Scene->Arrays();
  Index evaluations = 1;
  std::vector<float> extinction;
  path.push_back(this->At(sample.direction, &extinction));
  SearchSettings climb = settings;
  climb.viewpoints = 1;
  for (int round = 0; round < LargestNumberOfRounds; ++round)
  {
    const ViewScore fixed(
      scene.grid, extinction.data(), scene.importance, this->Options.rayDensity);
    const SearchResult top = FindViewpoints(fixed, this->From, { path.back() }, climb, {});
    const ScoredView next = this->At(top.viewpoints.front().direction, &extinction);
    evaluations += top.evaluations + 1;
    if (!(next.score.visible > path.back().score.visible))
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
  result.evaluations = std::count_if(
    samples.begin(), samples.end(), [](const ScoredView& view) { return view.valid; });
  const std::vector<ScoredView> starts = RankedViews(samples, settings);
  std::vector<ScoredView> candidates = samples;
  for (std::size_t i = 0; i < starts.size() && settings.refine; ++i)
  {
    if (!progress(double(i) / double(starts.size())))
    {
      break;
    }
    result.paths.emplace_back();
    result.evaluations += this->Climb(starts[i], settings, result.paths.back());
    candidates.push_back(result.paths.back().back());
  }
  result.viewpoints = RankedViews(std::move(candidates), settings);
  return result;
}
}
