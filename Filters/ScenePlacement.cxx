// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ScenePlacement.h"

#include "vtkMath.h"

#include "optimize/Solver.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
const Vec3 InitialPosition(0, 0, 1);
const Vec3 InitialFocalPoint(0, 0, 0);

// Some direction at right angles to both, or to the first if they are parallel.
Vec3 RightOf(const Vec3& back, const Vec3& up)
{
  Vec3 right = glm::cross(up, back);
  if (!(glm::length(right) > 1e-12 * glm::length(up) * glm::length(back)))
  {
    double any[3];
    vtkMath::Perpendiculars(&back.x, any, nullptr, 0.0);
    right = Vec3(any[0], any[1], any[2]);
  }
  return glm::normalize(right);
}
}

bool IsUnplaced(const Camera& camera)
{
  return camera.position == InitialPosition && camera.focalPoint == InitialFocalPoint;
}

bool IsUnplaced(const Light& light)
{
  return light.position == InitialPosition;
}

void PlaceCamera(const Grid& grid, Camera& camera)
{
  const double halfAngle = 0.5 * vtkMath::RadiansFromDegrees(camera.viewAngle);
  const double radius = std::max(grid.Radius(), 1e-300);
  camera.focalPoint = grid.Centre();
  camera.position = camera.focalPoint + Vec3(0, 0, radius / std::sin(halfAngle));
  camera.parallelScale = radius;
}

void PlaceLight(const Camera& camera, Light& light)
{
  const double elevation = vtkMath::RadiansFromDegrees(50.0);
  const double azimuth = vtkMath::RadiansFromDegrees(10.0);
  const double distance = glm::distance(camera.position, camera.focalPoint);
  if (!(distance > 0))
  {
    return; // the camera has no direction: the solver says so
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
