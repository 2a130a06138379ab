// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/HighestView.h"

#include <glm/gtc/constants.hpp>

#include <cmath>

namespace limpid
{
namespace
{
/// Number of directions whose ceilings are compared before a climb, about 0.5 radians apart.
constexpr int startDirections = 48;

/// Returns directions spread evenly over the sphere, on a spiral from pole to pole.
std::vector<Vec3> SpiralOfDirections(int count)
{
  const double goldenAngle = glm::pi<double>() * (3 - std::sqrt(5.0));
  std::vector<Vec3> directions;
  for (int i = 0; i < count; ++i)
  {
    const double height = 1 - (2 * i + 1) / double(count);
    const double radius = std::sqrt(1 - height * height);
    const double turn = goldenAngle * i;
    directions.emplace_back(radius * std::cos(turn), height, radius * std::sin(turn));
  }
  return directions;
}
}

Orbit OrbitOf(const Camera& camera)
{
  Orbit orbit;
  orbit.centre = camera.focalPoint;
  orbit.distance = glm::length(camera.position - camera.focalPoint);
  orbit.parallel = camera.parallel;
  orbit.parallelScale = camera.parallelScale;
  return orbit;
}

HighestView FindHighestView(const ViewScore& score, const Orbit& orbit, const ScoredView& start,
  const SearchProgress& progress)
{
  SearchSettings search;
  search.viewpoints = 2;
  search.firstStep = firstMove;
  const auto half = [&progress](double from)
  {
    return SearchProgress(
      [&progress, from](double share) { return !progress || progress(from + 0.5 * share); });
  };
  std::vector<ScoredView> samples =
    ScoreViews(score, orbit, SpiralOfDirections(startDirections), half(0));
  samples.push_back(start);
  const SearchResult climbs = FindViewpoints(score, orbit, samples, search, half(0.5));
  return { climbs.viewpoints.empty() ? start : climbs.viewpoints.front(), climbs.evaluations };
}
}
