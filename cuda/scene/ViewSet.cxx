// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "scene/ViewSet.h"

#include "math/Number.h"
#include "math/Require.h"
#include "scene/UprightAxis.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
constexpr int mostViews = 360; // one per degree

/// Rotates a vector about an axis of unit length by an angle [radians].
Vec3 Turned(const Vec3& vector, const Vec3& axis, double angle)
{
  return std::cos(angle) * vector + std::sin(angle) * glm::cross(axis, vector) +
    (1 - std::cos(angle)) * glm::dot(axis, vector) * axis;
}

/// Rotates a camera and its picture about an axis of unit length through its focal point [radians].
Camera TurnedRound(const Camera& camera, const Vec3& axis, double angle)
{
  const auto turned = [&](const Vec3& point)
  { return camera.focalPoint + Turned(point - camera.focalPoint, axis, angle); };
  Camera result = camera;
  result.position = turned(camera.position);
  result.viewUp = Turned(camera.viewUp, axis, angle);
  std::transform(camera.corners.begin(), camera.corners.end(), result.corners.begin(), turned);
  return result;
}

std::vector<Camera> EyesOf(const Camera& camera, double angle)
{
  const Vec3 offset = camera.position - camera.focalPoint;
  const Vec3 up = glm::cross(offset, glm::cross(camera.viewUp, offset));
  if (!(glm::length(up) > 0))
  {
    return { camera };
  }
  const Vec3 axis = glm::normalize(up);
  return { TurnedRound(camera, axis, -0.5 * angle), TurnedRound(camera, axis, 0.5 * angle) };
}

std::vector<Camera> OrbitOf(const Camera& camera, int count, OrbitStart start)
{
  const Vec3 axis = UprightAxis(camera);
  double first = 0;
  if (start == OrbitStart::Fixed)
  {
    const Vec3 offset = camera.position - camera.focalPoint;
    const Vec3 across = offset - glm::dot(offset, axis) * axis;
    const Vec3 fixed(axis.z, axis.x, axis.y); // perpendicular to the axis
    first = std::atan2(glm::dot(glm::cross(across, fixed), axis), glm::dot(across, fixed));
  }
  std::vector<Camera> cameras;
  cameras.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
  {
    cameras.push_back(TurnedRound(camera, axis, first + 2 * pi * i / count));
  }
  return cameras;
}
}

void ViewSet::Require() const
{
  LIMPID_REQUIRE(this->count >= 1 && this->count <= mostViews,
    "The number of views is " << this->count << " (an orbit has 1 to " << mostViews
                              << " views). Set a number in this range.");
  LIMPID_REQUIRE(this->eyeAngle >= 0 && this->eyeAngle < 180,
    "The eye angle is "
      << this->eyeAngle
      << " degrees (it must be in [0, 180) degrees). Set it from 0 to below 180 degrees.");
}

std::vector<Camera> CamerasOf(const ViewSet& views, const Camera& camera, OrbitStart start)
{
  views.Require();
  switch (views.kind)
  {
    case ViewKind::StereoPair:
      return EyesOf(camera, views.eyeAngle * pi / 180);
    case ViewKind::Orbit:
      return OrbitOf(camera, views.count, start);
    case ViewKind::Single:
      break;
  }
  return { camera };
}
}
