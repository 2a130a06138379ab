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
/// A rotation about the second axis and one about the first, Eq. (10) [radians].
struct ViewAngles
{
  double azimuth = 0; ///< alpha 1
  double polar = 0;   ///< alpha 2, above zero where the camera is below the first and third axis
};

/// Angles whose rotation turns (0, 0, 1) to a direction of unit length. At the poles the azimuth
/// is 0.
ViewAngles AnglesOf(const Vec3& direction);

/// What is upwards in the picture of a camera in a direction of unit length, if `up`, a unit
/// vector, is upwards in the world. At the poles it is any way.
Vec3 ViewUpOf(const Vec3& direction, const Vec3& up);

/// R of Eq. (10).
Mat3 RotationOf(const ViewAngles& angles);

/// The cameras that look at a point from a sphere round it, upright.
struct Orbit
{
  Vec3 centre{ 0.0 };
  double distance = 1;   ///< from the centre [length]
  double viewAngle = 30; ///< perspective only [degrees]
  bool parallel = false;
  double parallelScale = 1; ///< parallel only [length]
  double aspect = 1;
  Vec3 up{ 0.0, 1.0, 0.0 }; ///< unit vector that is upwards in pictures

  /// The camera on the side of the centre to which a unit vector points.
  Camera At(const Vec3& direction) const;
};

/// A direction from which an orbit looks, and what it sees from there.
struct ScoredView
{
  Vec3 direction{ 0.0, 0.0, 1.0 };
  Score score;

  /// What views are ranked by: S where all look at one extinction; the fraction where each has its
  /// own, whose scores do not compare.
  double worth = 0;
  bool valid = false; ///< false: it was not evaluated
};

inline bool IsBetter(const ScoredView& a, const ScoredView& b)
{
  return a.worth > b.worth;
}

struct SearchSettings
{
  int viewpoints = 4;            ///< that are wanted
  double separation = 0.5;       ///< least angle between any two of them [radians]
  bool refine = true;            ///< climb from the best samples
  double firstStep = 0.1;        ///< of a climb: half the distance of samples [radians]
  double precision = 0.002;      ///< smallest step of a climb [radians]
  int largestNumberOfSteps = 30; ///< of one climb
  AllowedViews allowed;          ///< for viewpoints, and on the way there
};

/// The best views, best first, and how they were reached.
struct SearchResult
{
  std::vector<ScoredView> viewpoints;
  std::vector<std::vector<ScoredView>> paths; ///< one per climb, from the sample up
  Index evaluations = 0;                      ///< scores and derivatives, samples included
};

/// Called now and then with the share of the work that is done; false: stop and keep what there is.
using SearchProgress = std::function<bool(double share)>;

/// The view of one extinction from one direction.
ScoredView ViewAt(const ViewScore& score, const Orbit& orbit, const Vec3& direction);

/// Scores of an orbit from several directions, in parallel. What is not done when `progress` says
/// stop stays invalid; it is asked on the thread of the caller alone.
std::vector<ScoredView> ScoreViews(const ViewScore& score, const Orbit& orbit,
  const std::vector<Vec3>& directions, const SearchProgress& progress);

/// The best of the views that were evaluated and are allowed, best first: as many as the settings
/// want, no two closer to each other than the separation.
std::vector<ScoredView> RankedViews(std::vector<ScoredView> views, const SearchSettings& settings);

/// Samples; where none of them is allowed, also allowed directions next to distinct good ones, as
/// `at` finds them.
std::vector<ScoredView> WithAllowed(std::vector<ScoredView> samples, const SearchSettings& settings,
  const std::function<ScoredView(const Vec3&)>& at);

/// Climbs from the best samples and ranks what is reached.
SearchResult FindViewpoints(const ViewScore& score, const Orbit& orbit,
  const std::vector<ScoredView>& samples, const SearchSettings& settings,
  const SearchProgress& progress);
}

#endif
