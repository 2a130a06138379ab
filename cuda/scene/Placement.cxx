// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "scene/Placement.h"

#include "math/Number.h"
#include "scene/Grid.h"
#include "scene/RaySource.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
double RadiansOf(double degrees)
{
  return degrees * (pi / 180);
}

// Returns a unit vector perpendicular to a vector.
Vec3 AcrossOf(const Vec3& vector)
{
  const Vec3 unit = vector / glm::length(vector);
  const Vec3 squares = vector * vector;
  const int largest =
    squares.x > squares.y && squares.x > squares.z ? 0 : (squares.y > squares.z ? 1 : 2);
  Vec3 next(0.0);
  next[(largest + 1) % 3] = 1.0;
  const Vec3 across = glm::cross(next, unit);
  return across / glm::length(across);
}

// Returns a direction perpendicular to both, or to the first if they are parallel.
Vec3 RightOf(const Vec3& back, const Vec3& up)
{
  const Vec3 right = glm::cross(up, back);
  const bool parallel = !(glm::length(right) > 1e-12 * glm::length(up) * glm::length(back));
  return glm::normalize(parallel ? AcrossOf(back) : right);
}
}

bool IsUnplaced(const Camera& camera)
{
  const Camera fresh;
  return camera.position == fresh.position && camera.focalPoint == fresh.focalPoint;
}

bool IsUnplaced(const Light& light)
{
  return light.position == Light().position;
}

void PlaceCamera(const Grid& grid, Camera& camera)
{
  const double halfAngle = 0.5 * RadiansOf(camera.viewAngle);
  const double radius = std::max(grid.Radius(), 1e-300);
  camera.focalPoint = grid.Centre();
  camera.position = camera.focalPoint + Vec3(0, 0, radius / std::sin(halfAngle));
  camera.parallelScale = radius;
}

void PlaceLight(const Camera& camera, Light& light)
{
  const double elevation = RadiansOf(50.0);
  const double azimuth = RadiansOf(10.0);
  const double distance = glm::distance(camera.position, camera.focalPoint);
  if (!(distance > 0))
  {
    return; // the camera has no direction: the solver reports it
  }
  const Vec3 back = (camera.position - camera.focalPoint) / distance;
  const Vec3 right = RightOf(back, camera.viewUp);
  const Vec3 up = glm::cross(back, right);
  light.position = camera.focalPoint +
    distance *
      (std::cos(elevation) * (std::cos(azimuth) * back + std::sin(azimuth) * right) +
        std::sin(elevation) * up);
}
}
