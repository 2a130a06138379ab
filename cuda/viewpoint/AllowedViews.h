// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_viewpoint_AllowedViews_h
#define limpid_viewpoint_AllowedViews_h

#include "math/Number.h"
#include "math/Vec.h"

#include <vector>

namespace limpid
{
/// The directions, unit vectors from what is looked at to the camera, from which a person would
/// look.
struct AllowedViews
{
  Vec3 up{ 0.0, 1.0, 0.0 };  ///< unit vector
  double lowest = -0.5 * pi; ///< elevation above the plane at right angles to `up` [radians]
  double highest = 0.5 * pi; ///< likewise, not below `lowest`
  std::vector<Vec3> avoided; ///< unit vectors
  double avoidanceAngle = 0; ///< so far from each of them nothing is allowed [radians]

  /// Whether a direction is allowed, to 1e-9 radians.
  bool Contains(const Vec3& direction) const;

  /// The nearest direction whose elevation is allowed: itself, bit by bit, if its own is.
  Vec3 WithElevation(const Vec3& direction) const;

  /// A slope on the sphere at an allowed direction, without what leads out of the allowed
  /// elevations.
  Vec3 SlopeWithin(const Vec3& direction, const Vec3& slope) const;
};

/// Elevation of a unit vector above the plane at right angles to another one [radians].
double ElevationOf(const Vec3& direction, const Vec3& up);
}

#endif
