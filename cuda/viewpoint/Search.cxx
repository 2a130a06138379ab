// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/Search.h"

#include "backend/Backend.h"
#include "backend/CallingThread.h"
#include "math/Angle.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace limpid
{
ViewAngles AnglesOf(const Vec3& direction)
{
  const double flat = std::hypot(direction.x, direction.z);
  ViewAngles angles;
  angles.azimuth = flat > 1e-12 ? std::atan2(direction.x, direction.z) : 0;
  angles.polar = std::atan2(-direction.y, flat);
  return angles;
}

Mat3 RotationOf(const ViewAngles& angles)
{
  const double c1 = std::cos(angles.azimuth);
  const double s1 = std::sin(angles.azimuth);
  const double c2 = std::cos(angles.polar);
  const double s2 = std::sin(angles.polar);
  return Mat3(Vec3(c1, 0, -s1), Vec3(s1 * s2, c2, c1 * s2), Vec3(s1 * c2, -s2, c1 * c2));
}

Vec3 ViewUpOf(const Vec3& direction, const Vec3& up)
{
  const Vec3 across = up - glm::dot(up, direction) * direction;
  const bool turns = up != Vec3(0, 1, 0) && glm::length(across) > 1e-12;
  return turns ? glm::normalize(across) : RotationOf(AnglesOf(direction))[1];
}

Camera Orbit::At(const Vec3& direction) const
{
  Camera camera;
  camera.position = this->centre + this->distance * direction;
  camera.focalPoint = this->centre;
  camera.viewUp = ViewUpOf(direction, this->up);
  camera.viewAngle = this->viewAngle;
  camera.parallel = this->parallel;
  camera.parallelScale = this->parallelScale;
  camera.aspect = this->aspect;
  return camera;
}

ScoredView ViewAt(const ViewScore& score, const Orbit& orbit, const Vec3& direction)
{
  ScoredView view;
  view.direction = direction;
  view.score = score.At(orbit.At(direction));
  view.worth = view.score.visibility;
  view.valid = true;
  return view;
}

namespace
{
/// Returns a progress function with the same answer on all processes that share the scene.
SearchProgress JointProgress(const ViewScore& score, const SearchProgress& progress)
{
  return [&score, progress](double share)
  { return !score.Seen().AnyOf(progress && !progress(share)); };
}

/// In distributed runs, scores one view after the other.
std::vector<ScoredView> ScoreViewsTogether(const ViewScore& score, const Orbit& orbit,
  const std::vector<Vec3>& directions, const SearchProgress& progress)
{
  std::vector<ScoredView> views(directions.size());
  bool goesOn = true;
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    views[i].direction = directions[i];
    if (goesOn)
    {
      views[i] = ViewAt(score, orbit, directions[i]);
      goesOn = progress(double(i + 1) / double(views.size()));
    }
  }
  return views;
}
}

std::vector<ScoredView> ScoreViews(const ViewScore& score, const Orbit& orbit,
  const std::vector<Vec3>& directions, const SearchProgress& progress)
{
  if (score.Seen().AreShared())
  {
    return ScoreViewsTogether(score, orbit, directions, JointProgress(score, progress));
  }
  std::vector<ScoredView> views(directions.size());
  std::atomic<bool> stopped{ false };
  std::atomic<std::size_t> done{ 0 };
  const CallingThread caller;
  ParallelFor(static_cast<Index>(directions.size()),
    [&](Index index)
    {
      ScoredView& view = views[std::size_t(index)];
      view.direction = directions[std::size_t(index)];
      if (stopped)
      {
        return;
      }
      view = ViewAt(score, orbit, view.direction);
      const std::size_t count = ++done;
      const bool tells = progress && caller.IsThis();
      if (tells && !progress(double(count) / double(directions.size())))
      {
        stopped = true;
      }
    });
  return views;
}

namespace
{
/// Turns a direction by an angle towards a perpendicular one.
Vec3 Turned(const Vec3& direction, const Vec3& towards, double angle)
{
  return glm::normalize(std::cos(angle) * direction + std::sin(angle) * towards);
}

/// Angle between the slopes from which the curvature at a maximum is computed [rad].
constexpr double bendingAngle = 0.03;

/// Relative error of scores of close directions due to the positions of rays.
constexpr double uncertainty = 3e-4;

/// One ascent on the sphere of directions.
class Climb
{
public:
  Climb(const ViewScore& score, const Orbit& orbit, const SearchSettings& settings,
    const SearchProgress& progress)
    : Scores(score)
    , From(orbit)
    , Options(settings)
    , Report(progress)
  {
  }

  Index Evaluations() const { return this->Count; }

  /// Returns the path of the ascent from a sample, until stopped. Every step increases the score.
  std::vector<ScoredView> Run(const ScoredView& sample)
  {
    std::vector<ScoredView> path{ sample };
    Vec3 ascent{ 0.0 };
    double step = this->Options.firstStep;
    for (int i = 0; i < this->Options.largestNumberOfSteps && step > 0; ++i)
    {
      this->Share = double(i) / this->Options.largestNumberOfSteps;
      if (!this->GoOn())
      {
        return path;
      }
      const ScoredView here = path.back();
      ascent =
        this->Options.allowed.SlopeWithin(here.direction, this->AscentAt(here.direction).slope);
      const double steepness = glm::length(ascent);
      if (!(steepness > 0))
      {
        return path;
      }
      step = this->Step(here, ascent / steepness, steepness, step, path);
    }
    if (step <= 0 && !this->Stopped)
    {
      this->Centre(ascent, path);
    }
    return path;
  }

private:
  bool GoOn()
  {
    this->Stopped = this->Stopped || !this->Report(this->Share);
    return !this->Stopped;
  }

  /// Returns the score and its derivative by the direction [length^2/rad].
  ViewSlope AscentAt(const Vec3& direction)
  {
    ++this->Count;
    ViewSlope slope = this->Scores.SlopeAt(this->From.At(direction));
    slope.slope *= this->From.distance;
    return slope;
  }

  /**
   * Performs one Newton step to the zero of the slope. Near a maximum, scores differ by less than
   * their errors due to the positions of rays, but the slope still locates the maximum.
   */
  void Centre(const Vec3& ascent, std::vector<ScoredView>& path)
  {
    const ScoredView top = path.back();
    const Vec3 right = RotationOf(AnglesOf(top.direction))[0];
    const Vec3 ways[2] = { right, glm::cross(top.direction, right) };
    const glm::dvec2 slope(glm::dot(ascent, ways[0]), glm::dot(ascent, ways[1]));
    glm::dmat2 bend;
    for (int way = 0; way < 2; ++way)
    {
      const Vec3 beside = Turned(top.direction, ways[way], bendingAngle);
      if (!this->GoOn())
      {
        return;
      }
      const Vec3 there = this->AscentAt(beside).slope;
      const Vec3 ahead = Turned(ways[way], -top.direction, bendingAngle);
      const double along = glm::dot(there, ahead);
      const double across = glm::dot(there, ways[1 - way]);
      bend[way] = (glm::dvec2(way ? across : along, way ? along : across) - slope) / bendingAngle;
    }
    const double mixed = 0.5 * (bend[0][1] + bend[1][0]);
    bend[0][1] = mixed;
    bend[1][0] = mixed;
    if (!(bend[0][0] < 0 && glm::determinant(bend) > 0))
    {
      return; // not a maximum
    }
    const glm::dvec2 way = -glm::inverse(bend) * slope;
    const double angle = glm::length(way);
    if (!(angle > 0 && angle < this->Options.firstStep) || !this->GoOn())
    {
      return;
    }
    const Vec3 centre = Turned(top.direction, (way.x * ways[0] + way.y * ways[1]) / angle, angle);
    const ViewSlope there = this->AscentAt(centre);
    const ScoredView middle = this->At(centre);
    if (this->Options.allowed.Contains(centre) && glm::length(there.slope) < glm::length(ascent) &&
      middle.worth >= path.front().worth && middle.worth >= (1 - uncertainty) * top.worth)
    {
      while (path.size() > 1 && path.back().worth >= middle.worth)
      {
        path.pop_back();
      }
      path.push_back(middle);
    }
  }

  ScoredView At(const Vec3& direction)
  {
    ++this->Count;
    return ViewAt(this->Scores, this->From, direction);
  }

  /// Climbs along a great circle: Eq. (31) with a step that is neither too short nor too long
  /// (deviation D14). Returns the length of the next step; 0 at a maximum.
  double Step(const ScoredView& here, const Vec3& along, double steepness, double length,
    std::vector<ScoredView>& path)
  {
    while (length >= this->Options.precision && this->GoOn())
    {
      const AllowedViews& allowed = this->Options.allowed;
      const ScoredView next =
        this->At(allowed.WithElevation(Turned(here.direction, along, length)));
      const double gain = allowed.Contains(next.direction) ? next.worth - here.worth : -here.worth;
      // The parabola through the start's score and slope and the end's score has its maximum
      // there.
      const double excess = steepness * length - gain;
      const double top = excess > 0 ? 0.5 * steepness * length * length / excess : 2 * length;
      if (gain > 0.1 * steepness * length)
      {
        path.push_back(next);
        return std::min(std::max(top, 0.5 * length), 2 * length);
      }
      length = std::min(std::max(top, 0.2 * length), 0.6 * length);
    }
    return 0;
  }

  const ViewScore& Scores;
  const Orbit& From;
  const SearchSettings& Options;
  const SearchProgress& Report;
  Index Count = 0;
  double Share = 0; ///< fraction of the climb done, if it takes the maximum number of steps
  bool Stopped = false;
};
}

std::vector<ScoredView> RankedViews(std::vector<ScoredView> views, const SearchSettings& settings)
{
  std::stable_sort(views.begin(), views.end(), IsBetter);
  std::vector<ScoredView> kept;
  for (const ScoredView& view : views)
  {
    const bool isNew = std::all_of(kept.begin(), kept.end(),
      [&](const ScoredView& other)
      { return AngleBetween(view.direction, other.direction) >= settings.separation; });
    if (view.valid && isNew && settings.allowed.Contains(view.direction) &&
      static_cast<int>(kept.size()) < settings.viewpoints)
    {
      kept.push_back(view);
    }
  }
  return kept;
}

std::vector<ScoredView> WithAllowed(std::vector<ScoredView> samples, const SearchSettings& settings,
  const std::function<ScoredView(const Vec3&)>& at)
{
  if (RankedViews(samples, settings).empty())
  {
    SearchSettings anywhere = settings;
    anywhere.allowed = {};
    anywhere.viewpoints = static_cast<int>(samples.size());
    for (const ScoredView& view : RankedViews(samples, anywhere))
    {
      const Vec3 direction = settings.allowed.WithElevation(view.direction);
      if (settings.allowed.Contains(direction))
      {
        samples.push_back(at(direction));
      }
    }
  }
  return samples;
}

SearchResult FindViewpoints(const ViewScore& score, const Orbit& orbit,
  const std::vector<ScoredView>& samples, const SearchSettings& settings,
  const SearchProgress& progress)
{
  const SearchProgress joint = JointProgress(score, progress);
  SearchResult result;
  std::vector<ScoredView> candidates = WithAllowed(
    samples, settings, [&](const Vec3& direction) { return ViewAt(score, orbit, direction); });
  const std::vector<ScoredView> starts = RankedViews(candidates, settings);
  result.evaluations = std::count_if(
    candidates.begin(), candidates.end(), [](const ScoredView& view) { return view.valid; });
  for (std::size_t i = 0; i < starts.size() && settings.refine; ++i)
  {
    const SearchProgress climbed = [&](double share)
    { return joint((double(i) + share) / double(starts.size())); };
    if (!climbed(0))
    {
      break;
    }
    Climb climb(score, orbit, settings, climbed);
    result.paths.push_back(climb.Run(starts[i]));
    result.evaluations += climb.Evaluations();
    candidates.push_back(result.paths.back().back());
  }
  result.viewpoints = RankedViews(candidates, settings);
  return result;
}
}
