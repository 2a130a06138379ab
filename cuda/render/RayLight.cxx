// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/RayLight.h"

#include "math/Require.h"

#include <algorithm>

namespace limpid
{
namespace
{
/// Computes the direction of travel of the light at the centre of the volume, and its position.
void PlaceLight(const Light& light, const Grid& grid, RayLight& target, Vec3& travel)
{
  const Vec3 place = (light.position - grid.Centre()) / grid.Radius();
  // At larger distances, light is directional in single precision.
  const bool point = light.type == LightType::Point && glm::length(place) < 1e6;
  travel = light.type == LightType::Point ? -place : light.focalPoint - light.position;
  const double length = glm::length(travel);
  travel = length > 0 ? travel / length : Vec3(0, 0, -1);
  target.isPoint = point ? 1.0f : 0.0f;
  const Vec3 origin = point ? place : -travel;
  for (int axis = 0; axis < 3; ++axis)
  {
    target.origin[axis] = static_cast<float>(origin[axis]);
  }
}

/// Returns the direction to the viewer from the centre of the volume. It depends on where the
/// camera looks only for a parallel projection and for an eye at the centre.
Vec3 ToViewer(const Grid& grid, const View& view)
{
  const glm::dvec4 eye = view.clipToWorld * glm::dvec4(0, 0, 1, 0);
  const Vec3 way = Vec3(eye) / eye.w - grid.Centre();
  const double distance = glm::length(way);
  if (distance > 1e-6 * grid.Radius() && distance < 1e9 * grid.Radius())
  {
    return way / distance;
  }
  const glm::dvec4 front = view.clipToWorld * glm::dvec4(0, 0, -1, 1);
  const glm::dvec4 back = view.clipToWorld * glm::dvec4(0, 0, 1, 1);
  const Vec3 along = Vec3(front) / front.w - Vec3(back) / back.w;
  return along / glm::length(along);
}
}

void RequireLighting(const Lighting& lighting)
{
  LIMPID_REQUIRE(lighting.anisotropy > -1 && lighting.anisotropy < 1,
    "The anisotropy is " << lighting.anisotropy
                         << " (the Henyey-Greenstein function is not defined there). Keep it "
                            "between -1 and 1.");
  LIMPID_REQUIRE(lighting.specularPower >= 0 && std::isfinite(lighting.specularPower),
    "The specular power is " << lighting.specularPower
                             << " (the highlight would not be finite). Keep it at or above zero.");
  LIMPID_REQUIRE(lighting.intensity >= 0 && std::isfinite(lighting.intensity) &&
      lighting.surface >= 0 && std::isfinite(lighting.surface),
    "The light's intensity is "
      << lighting.intensity << " and the surface share " << lighting.surface
      << " (light cannot be negative). Keep both finite and at or above zero.");
  LIMPID_REQUIRE(lighting.ambient >= 0 && lighting.ambient <= 1 && lighting.shadowStrength >= 0 &&
      lighting.shadowStrength <= 1,
    "The ambient light is " << lighting.ambient << " and the strength of shadows "
                            << lighting.shadowStrength
                            << " (both are fractions of the light). Keep them between 0 "
                            << "and 1.");
}

RayLight MakeRayLight(const Lighting& settings, const Grid& grid, const View& view)
{
  RayLight light;
  Vec3 travel;
  PlaceLight(settings.light, grid, light, travel);
  const double middle =
    HenyeyGreenstein(settings.anisotropy, glm::dot(travel, ToViewer(grid, view)));
  light.ambient = static_cast<float>(settings.ambient);
  light.diffuse = static_cast<float>((1 - settings.ambient) * settings.intensity);
  light.anisotropy = static_cast<float>(settings.anisotropy);
  light.phaseUnit = static_cast<float>(1 / middle);
  light.surface = static_cast<float>(settings.surface);
  light.shadow = static_cast<float>(settings.shadows ? settings.shadowStrength : 0.0);
  light.lobe.factor = static_cast<float>(BlinnPhongNormalization(settings.specularPower));
  light.lobe.power = static_cast<float>(settings.specularPower);
  return light;
}
}
