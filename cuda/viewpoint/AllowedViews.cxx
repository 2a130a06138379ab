// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/AllowedViews.h"

#include "math/Angle.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
constexpr double rounding = 1e-9;

/// Returns the normalised component of a direction perpendicular to `up`; arbitrary at a pole.
Vec3 FootOf(const Vec3& direction, const Vec3& up)
{
  const Vec3 flat = direction - glm::dot(direction, up) * up;
  if (glm::length(flat) > 1e-12)
  {
    return glm::normalize(flat);
  }
  const Vec3 other = std::abs(up.x) < 0.9 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  return glm::normalize(glm::cross(up, other));
}
}

double ElevationOf(const Vec3& direction, const Vec3& up)
{
  return std::atan2(glm::dot(direction, up), glm::length(glm::cross(direction, up)));
}

bool AllowedViews::Contains(const Vec3& direction) const
{
  const double elevation = ElevationOf(direction, this->up);
  const bool within = elevation >= this->lowest - rounding && elevation <= this->highest + rounding;
  return within &&
    std::all_of(this->avoided.begin(), this->avoided.end(),
      [&](const Vec3& other)
      { return AngleBetween(direction, other) >= this->avoidanceAngle - rounding; });
}

Vec3 AllowedViews::WithElevation(const Vec3& direction) const
{
  const double elevation = ElevationOf(direction, this->up);
  const double allowed = std::clamp(elevation, this->lowest, this->highest);
  return allowed == elevation
    ? direction
    : std::cos(allowed) * FootOf(direction, this->up) + std::sin(allowed) * this->up;
}

Vec3 AllowedViews::SlopeWithin(const Vec3& direction, const Vec3& slope) const
{
  const double elevation = ElevationOf(direction, this->up);
  const Vec3 upwards = std::cos(elevation) * this->up -
    std::sin(elevation) * FootOf(direction, this->up); // along the meridian
  const double climb = glm::dot(slope, upwards);
  const bool leadsOut = (climb > 0 && elevation >= this->highest - rounding) ||
    (climb < 0 && elevation <= this->lowest + rounding);
  const bool limited = this->highest - this->lowest < pi - rounding;
  return limited && leadsOut ? slope - climb * upwards : slope;
}
}
