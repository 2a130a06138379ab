// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Ways of a camera over a sphere of directions that show much and turn evenly.

#ifndef limpid_viewpoint_CameraPath_h
#define limpid_viewpoint_CameraPath_h

#include "viewpoint/AllowedViews.h"
#include "viewpoint/DirectionMesh.h"

#include <vector>

namespace limpid
{
struct CameraPathSettings
{
  int keyViews = 4;        ///< of a round trip, at most, >= 1
  double separation = 0.5; ///< least angle between any two of them [radians]
  int frames = 120;        ///< of a round trip, >= 2
  double leastShare = 0.9; ///< of the locally best score, at key views [0, 1]
  AllowedViews allowed;    ///< nowhere else does the path go, if there is a way
};

/// A camera's way.
struct CameraPath
{
  std::vector<Vec3> directions; ///< of unit length, one per frame
  std::vector<double> scores;   ///< from there
  std::vector<int> keyViews;    ///< numbers of frames, in order
  bool closed = false;          ///< whether the first frame follows the last
};

/**
 * A round trip through the best views, at even speed: from the best one on, in the order of the
 * shortest way found, along ridges of the score. The best views are the tops of hills from where at
 * least half as much is seen as from the best one, and if those are too few, others. `scores`: one
 * per direction, not negative. Empty where no direction is allowed.
 */
CameraPath RoundTrip(
  const DirectionMesh& mesh, const std::vector<double>& scores, const CameraPathSettings& settings);

/**
 * One direction per time step, which is a key view: from each at least `leastShare` of what is seen
 * from the locally best direction at that time, with as little turning as that allows. `scores`:
 * per time step, one per direction. Empty where no direction is allowed.
 */
CameraPath PathThroughTime(const DirectionMesh& mesh,
  const std::vector<std::vector<double>>& scores, const CameraPathSettings& settings);
}

#endif
