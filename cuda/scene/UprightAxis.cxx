// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "scene/UprightAxis.h"

#include "math/Number.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limpid
{
namespace
{
/// Returns the angle between an axis and the upward direction of a picture [radians].
double TiltOf(const Vec3& axis, const Vec3& right, const Vec3& up, const Vec3& back)
{
  constexpr double endOn = 0.1; // an axis this short in the picture has no direction there
  constexpr double above = 0.02;
  constexpr double below = 0.06; // decides between two axes if the camera looks along their plane
  const double along = glm::dot(axis, up);
  const double across = std::abs(glm::dot(axis, right));
  if (std::hypot(along, across) < endOn)
  {
    return pi;
  }
  const double elevation = std::asin(std::clamp(glm::dot(axis, back), -1.0, 1.0));
  return std::atan2(across, along) + std::max(above * elevation, -below * elevation);
}
}

Vec3 UprightAxis(const Camera& camera)
{
  const Vec3 back = camera.position - camera.focalPoint;
  const Vec3 right = glm::cross(camera.viewUp, back);
  const bool hasPicture = glm::length(right) > 0;
  const Vec3 up = hasPicture ? glm::normalize(glm::cross(back, right)) : camera.viewUp;
  Vec3 best(0.0, 1.0, 0.0);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 6; ++i)
  {
    Vec3 axis(0.0);
    axis[i / 2] = i % 2 == 0 ? 1 : -1;
    const double tilt = hasPicture ? TiltOf(axis, glm::normalize(right), up, glm::normalize(back))
                                   : -glm::dot(axis, up);
    best = tilt < least ? axis : best;
    least = std::min(least, tilt);
  }
  return best;
}
}
