// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Smooth camera paths over a sphere of directions that show much.

#ifndef limpid_viewpoint_CameraPath_h
#define limpid_viewpoint_CameraPath_h

#include "viewpoint/AllowedViews.h"
#include "viewpoint/DirectionMesh.h"

#include <vector>

namespace limpid
{
struct CameraPathSettings
{
  int keyViews = 4;        ///< maximum number in a round trip, >= 1
  double separation = 0.5; ///< minimum angle between any two key views [radians]
  int frames = 120;        ///< number of frames of a round trip, >= 2
  double leastShare = 0.9; ///< minimum share of the locally best score at key views [0, 1]
  AllowedViews allowed;    ///< the path stays inside if possible
};

/// A camera path.
struct CameraPath
{
  std::vector<Vec3> directions; ///< unit vectors, one per frame
  std::vector<double> scores;   ///< score of each frame
  std::vector<int> keyViews;    ///< frame numbers in ascending order
  bool closed = false;          ///< whether the first frame follows the last one
};

/**
 * Returns a round trip through the best views at constant speed. It starts at the best view,
 * visits the others in the order of the shortest path found, and follows ridges of the score. The
 * best views are local maxima whose scores are at least half of the best score; if there are too
 * few, other directions are added. `scores`: one non-negative value per direction. Empty if no
 * direction is allowed.
 */
CameraPath RoundTrip(
  const DirectionMesh& mesh, const std::vector<double>& scores, const CameraPathSettings& settings);

/**
 * Returns one direction per time step, each a key view, with as little turning as possible. Each
 * direction has at least `leastShare` of the locally best score at its time. `scores`: [time
 * step][direction]. Empty if no direction is allowed.
 */
CameraPath PathThroughTime(const DirectionMesh& mesh,
  const std::vector<std::vector<double>>& scores, const CameraPathSettings& settings);
}

#endif
