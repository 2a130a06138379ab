// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_viewpoint_AllowedViews_h
#define limpid_viewpoint_AllowedViews_h

#include "math/Number.h"
#include "math/Vec.h"

#include <vector>

namespace limpid
{
/// The allowed viewing directions. A direction is a unit vector from the focal point to the
/// camera.
struct AllowedViews
{
  Vec3 up{ 0.0, 1.0, 0.0 };  ///< unit vector
  double lowest = -0.5 * pi; ///< lowest elevation above the plane perpendicular to `up` [radians]
  double highest = 0.5 * pi; ///< highest elevation, at least `lowest` [radians]
  std::vector<Vec3> avoided; ///< unit vectors
  double avoidanceAngle = 0; ///< minimum angle to all avoided directions [radians]

  /// Whether a direction is allowed, to 1e-9 radians.
  bool Contains(const Vec3& direction) const;

  /// Returns the nearest direction of allowed elevation; bit-identical if `direction` has one.
  Vec3 WithElevation(const Vec3& direction) const;

  /// Projects a slope on the sphere at an allowed direction so that it does not lead out of the
  /// allowed elevations.
  Vec3 SlopeWithin(const Vec3& direction, const Vec3& slope) const;
};

/// Returns the elevation of a unit vector above the plane perpendicular to `up` [radians].
double ElevationOf(const Vec3& direction, const Vec3& up);
}

#endif
