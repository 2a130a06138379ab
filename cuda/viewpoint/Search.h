// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_viewpoint_Search_h
#define limpid_viewpoint_Search_h

#include "viewpoint/AllowedViews.h"
#include "viewpoint/ViewScore.h"

#include <functional>
#include <vector>

namespace limpid
{
/// Rotations about the second and the first axis, Eq. (10) [radians].
struct ViewAngles
{
  double azimuth = 0; ///< alpha 1
  double polar = 0;   ///< alpha 2, positive if the camera is below axes 1 and 3
};

/// Returns the angles of the rotation that turns (0, 0, 1) to a unit vector. At the poles the
/// azimuth is 0.
ViewAngles AnglesOf(const Vec3& direction);

/// Returns the up vector of a camera in a direction, given the world's up vector; both are unit
/// vectors. At the poles it is arbitrary.
Vec3 ViewUpOf(const Vec3& direction, const Vec3& up);

/// R of Eq. (10).
Mat3 RotationOf(const ViewAngles& angles);

/// Upright cameras on a sphere that look at its centre.
struct Orbit
{
  Vec3 centre{ 0.0 };
  double distance = 1;   ///< radius of the sphere [length]
  double viewAngle = 30; ///< perspective only [degrees]
  bool parallel = false;
  double parallelScale = 1; ///< parallel only [length]
  double aspect = 1;
  Vec3 up{ 0.0, 1.0, 0.0 }; ///< unit vector that points up in pictures

  /// Returns the camera whose direction from the centre is the given unit vector.
  Camera At(const Vec3& direction) const;
};

/// A direction of an orbit and its score.
struct ScoredView
{
  Vec3 direction{ 0.0, 0.0, 1.0 };
  Score score;

  /// The value by which views are ranked: S if all views share one extinction. If each view has
  /// its own, it is the fraction, as their S are not comparable.
  double worth = 0;
  bool valid = false; ///< false if not evaluated
};

inline bool IsBetter(const ScoredView& a, const ScoredView& b)
{
  return a.worth > b.worth;
}

struct SearchSettings
{
  int viewpoints = 4;       ///< number of viewpoints to find
  double separation = 0.5;  ///< minimum angle between any two viewpoints [radians]
  bool refine = true;       ///< whether to climb from the best samples
  double firstStep = 0.1;   ///< first step of a climb: half the distance between samples [radians]
  double precision = 0.002; ///< smallest step of a climb [radians]
  int largestNumberOfSteps = 30; ///< maximum number of steps of one climb
  AllowedViews allowed;          ///< for viewpoints and all steps of climbs
};

/// The best views in descending order, and the paths that led to them.
struct SearchResult
{
  std::vector<ScoredView> viewpoints;
  std::vector<std::vector<ScoredView>> paths; ///< one per climb, starting at the sample
  Index evaluations = 0; ///< number of scores and derivatives, including samples
};

/// Called regularly with the fraction of work done; if it returns false, the search stops and
/// keeps its result.
using SearchProgress = std::function<bool(double share)>;

/// Returns the view of one extinction from one direction.
ScoredView ViewAt(const ViewScore& score, const Orbit& orbit, const Vec3& direction);

/// Scores several directions of an orbit in parallel. Views not evaluated when `progress` stops
/// the work stay invalid. Only the calling thread calls `progress`.
std::vector<ScoredView> ScoreViews(const ViewScore& score, const Orbit& orbit,
  const std::vector<Vec3>& directions, const SearchProgress& progress);

/// Returns the best evaluated and allowed views in descending order: at most settings.viewpoints,
/// at least settings.separation apart.
std::vector<ScoredView> RankedViews(std::vector<ScoredView> views, const SearchSettings& settings);

/// Returns the samples. If none of them is allowed, adds allowed directions next to distinct good
/// samples, evaluated by `at`.
std::vector<ScoredView> WithAllowed(std::vector<ScoredView> samples, const SearchSettings& settings,
  const std::function<ScoredView(const Vec3&)>& at);

/// Climbs from the best samples and sorts the results.
SearchResult FindViewpoints(const ViewScore& score, const Orbit& orbit,
  const std::vector<ScoredView>& samples, const SearchSettings& settings,
  const SearchProgress& progress);
}

#endif
