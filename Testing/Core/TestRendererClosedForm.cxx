// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A homogeneous box is Beer's law on every ray, whatever the camera: nothing but rounding may be
// wrong in any pixel.

#include "PictureErrors.h"
#include "RenderScene.h"
#include "Tolerance.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
const double extinction = 0.17;
const std::array<float, 3> color{ { 0.9f, 0.6f, 0.2f } };

/// Anisotropic, turned, far from the origin: 9 x 8 x 9.8 in the directions of its axes.
Grid Box()
{
  Grid grid = MakeGrid({ 10, 9, 8 }, { 500, -300, 2000 }, { 0.9, 1.0, 1.4 });
  grid.direction = Mat3(Vec3(0, 0.6, 0.8), Vec3(-1, 0, 0), Vec3(0, -0.8, 0.6));
  return grid;
}

RenderScene HomogeneousScene()
{
  RenderScene scene = RenderScene::Homogeneous(Box(), extinction, color);
  scene.view.opaqueBelow = 0;
  scene.view.width = 37;
  scene.view.height = 23;
  return scene;
}

/// Where a pixel's ray is inside the box, which is `margin` nodes larger on every side [length].
double PathOf(const RenderScene& scene, int column, int row, double margin)
{
  const auto point = [&](double z)
  {
    const glm::dvec4 x = scene.view.clipToWorld *
      glm::dvec4(
        2 * (column + 0.5) / scene.view.width - 1, 2 * (row + 0.5) / scene.view.height - 1, z, 1.0);
    return Vec3(x) / x.w;
  };
  const std::size_t pixel = std::size_t(row) * std::size_t(scene.view.width) + std::size_t(column);
  const double start = scene.nearDepth.empty() ? -1.0 : scene.nearDepth[pixel];
  const double end = scene.depth.empty() ? 1.0 : scene.depth[pixel];
  if (start >= end)
  {
    return 0;
  }
  const Vec3 from = point(start);
  const Vec3 way = point(end) - from;
  const Vec3 index = scene.grid.PointToIndex(from);
  const Vec3 indexWay = scene.grid.DirectionToIndex(way);
  double first = 0;
  double last = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = (-margin - index[axis]) / indexWay[axis];
    const double high = (scene.grid.nodes[axis] - 1 + margin - index[axis]) / indexWay[axis];
    first = std::fmax(first, std::fmin(low, high));
    last = std::fmin(last, std::fmax(low, high));
  }
  for (const glm::dvec4& plane : scene.view.planes)
  {
    const double at = glm::dot(plane, glm::dvec4(from, 1.0));
    const double behind = glm::dot(plane, glm::dvec4(from + way, 1.0));
    const double crossing = at / (at - behind);
    first = at < 0 ? std::fmax(first, behind < 0 ? 1.0 : crossing) : first;
    last = at >= 0 && behind < 0 ? std::fmin(last, crossing) : last;
  }
  return glm::length(way) * std::max(0.0, last - first);
}

/// Every pixel is the colour times `brightness` behind the optical depth of its ray.
void ExpectBeersLaw(const RenderScene& scene, double mu, double brightness = 1)
{
  const Tolerance tolerance = EightBits() + StoredMedium(scene);
  const Picture picture = scene.Render();
  std::size_t pixel = 0;
  double worst = 0;
  std::string where;
  int inside = 0;
  for (int row = 0; row < scene.view.height; ++row)
  {
    for (int column = 0; column < scene.view.width; ++column, ++pixel)
    {
      const double path = PathOf(scene, column, row, 0);
      if (std::abs(PathOf(scene, column, row, 1e-9) - PathOf(scene, column, row, -1e-9)) > 1e-3)
      {
        continue; // along a face: rounding decides whether the ray is inside
      }
      inside += path > 0 ? 1 : 0;
      for (int channel = 0; channel < 4; ++channel)
      {
        const double share = channel < 3 ? brightness * color[std::size_t(channel)] : 1.0;
        const double expected = std::min(1.0, share * -std::expm1(-mu * path));
        const double error = std::abs(Channel(picture, pixel, channel) - expected);
        if (!(error <= worst))
        {
          worst = error;
          where = "pixel (" + std::to_string(column) + ", " + std::to_string(row) + "), channel " +
            std::to_string(channel) + ", expected " + std::to_string(expected);
        }
      }
    }
  }
  EXPECT_GT(inside, 20) << "the view hardly meets the box";
  EXPECT_WITHIN(worst, 0, tolerance) << where;
}

struct Viewpoint
{
  const char* name;
  std::function<glm::dmat4(const Grid&)> clipToWorld;
};

std::ostream& operator<<(std::ostream& stream, const Viewpoint& viewpoint)
{
  return stream << viewpoint.name;
}

Frustum From(const Grid& grid, const Vec3& offset)
{
  return LookAt(grid.Centre() + offset, grid.Centre(), Vec3(0.1, 1, 0.2));
}

const double aspect = 37.0 / 23.0;

std::vector<Viewpoint> Viewpoints()
{
  return {
    { "Perspective",
      [](const Grid& grid) {
        return Perspective(From(grid, { 9, 13, -30 }), 30, aspect, 5, 80);
      } },
    { "WideAndNear",
      [](const Grid& grid) {
        return Perspective(From(grid, { 5, -7, 6 }), 100, aspect, 0.01, 80);
      } },
    { "Parallel",
      [](const Grid& grid) {
        return Parallel(From(grid, { 9, 13, -30 }), 8, aspect, -80, 80);
      } },
    { "ParallelSheared",
      [](const Grid& grid) {
        return Parallel(From(grid, { 9, 13, -30 }), 8, aspect, 5, 80, 0.3);
      } },
    { "ParallelAlongAnAxis",
      [](const Grid& grid)
      {
        const Vec3 eye = grid.PointToWorld(Vec3(4.5, 4, -9));
        return Parallel(LookAt(eye, grid.Centre(), grid.direction[1]), 6, aspect, 1, 80);
      } },
    { "Inside",
      [](const Grid& grid) {
        return Perspective(From(grid, { 1, 0.5, -1.2 }), 60, aspect, 1e-3, 80);
      } },
    { "InTheMiddle",
      [](const Grid& grid)
      {
        const Frustum camera = LookAt(grid.Centre(), grid.Centre() + Vec3(1, 2, 3), Vec3(0, 1, 0));
        return Perspective(camera, 60, aspect, 1e-3, 80);
      } },
    { "OnANodeInside",
      [](const Grid& grid)
      {
        const Vec3 eye = grid.PointToWorld(Vec3(3, 5, 2));
        return Perspective(LookAt(eye, grid.Centre(), Vec3(0, 1, 0)), 60, aspect, 1e-3, 80);
      } },
    { "OnAFace",
      [](const Grid& grid)
      {
        const Vec3 eye = grid.PointToWorld(Vec3(3, 5, 0));
        return Perspective(LookAt(eye, grid.Centre(), Vec3(0, 1, 0)), 60, aspect, 1e-3, 80);
      } },
    { "InTheCorner",
      [](const Grid& grid) {
        return Perspective(LookAt(grid.origin, grid.Centre(), Vec3(0, 1, 0)), 60, aspect, 1e-3, 80);
      } },
    { "AlongAnEdge",
      [](const Grid& grid)
      {
        const Vec3 eye = grid.PointToWorld(Vec3(0, 0, -5));
        return Perspective(LookAt(eye, grid.origin, grid.direction[0]), 60, aspect, 0.1, 80);
      } },
    { "CutByTheNearPlane",
      [](const Grid& grid) {
        return Perspective(From(grid, { 9, 13, -30 }), 30, aspect, 33, 80);
      } },
    { "CutByTheFarPlane",
      [](const Grid& grid) {
        return Perspective(From(grid, { 9, 13, -30 }), 30, aspect, 1, 34);
      } },
    { "MirroredAndUpsideDown",
      [](const Grid& grid)
      {
        Frustum camera = From(grid, { 9, 13, -30 });
        camera.right = -camera.right;
        return Perspective(camera, 30, aspect, 5, 80);
      } },
  };
}
}

class HomogeneousBox : public ::testing::TestWithParam<Viewpoint>
{
};

TEST_P(HomogeneousBox, FollowsBeersLaw)
{
  RenderScene scene = HomogeneousScene();
  scene.view.clipToWorld = GetParam().clipToWorld(scene.grid);

  ExpectBeersLaw(scene, extinction);
}

/// Clip z around that of a node, for every pixel.
std::vector<float> DepthsAround(const RenderScene& scene, const Vec3& node, unsigned seed)
{
  const glm::dvec4 there =
    glm::inverse(scene.view.clipToWorld) * glm::dvec4(scene.grid.PointToWorld(node), 1.0);
  const double z = there.w > 0 ? std::min(1.0, std::max(-1.0, there.z / there.w)) : 0.5;
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> around(-0.05, 0.05);
  std::vector<float> depths;
  for (int pixel = 0; pixel < scene.view.width * scene.view.height; ++pixel)
  {
    depths.push_back(float(std::min(1.0, std::max(-1.0, z + (1 - z) * around(generator)))));
  }
  return depths;
}

TEST_P(HomogeneousBox, FollowsBeersLawBetweenTwoSurfaces)
{
  RenderScene scene = HomogeneousScene();
  scene.view.clipToWorld = GetParam().clipToWorld(scene.grid);
  scene.nearDepth = DepthsAround(scene, { 5, 5, 6 }, 3);
  scene.depth = DepthsAround(scene, { 5, 5, 6 }, 4); // behind it for every other pixel
  std::fill_n(scene.depth.begin() + 200, 150, 1.0f);
  std::fill_n(scene.nearDepth.begin() + 500, 150, -1.0f);
  scene.nearDepth[400] = -1;
  scene.depth[401] = 1;

  ExpectBeersLaw(scene, extinction);
  scene.view.jitter = true;
  scene.view.sampleDistance = 2.7;
  ExpectBeersLaw(scene, extinction);
}

TEST_P(HomogeneousBox, FollowsBeersLawUpToOpaqueGeometry)
{
  RenderScene scene = HomogeneousScene();
  scene.view.clipToWorld = GetParam().clipToWorld(scene.grid);
  scene.depth = DepthsAround(scene, { 5, 5, 6 }, 3);
  scene.depth[400] = -1;
  scene.depth[401] = 1;

  ExpectBeersLaw(scene, extinction);
}

TEST_P(HomogeneousBox, FollowsBeersLawBetweenPlanes)
{
  RenderScene scene = HomogeneousScene();
  scene.view.clipToWorld = GetParam().clipToWorld(scene.grid);
  const auto behind = [&](const Vec3& normal, double distance)
  {
    const Vec3 point = scene.grid.Centre() + distance * normal;
    scene.view.planes.emplace_back(normal, -glm::dot(normal, point));
  };
  behind({ 0.8, 0.6, 0 }, -2.3);
  behind({ 0, -0.6, 0.8 }, -1.7);
  behind({ 0, 0, -1 }, -3);

  ExpectBeersLaw(scene, extinction);
}

TEST_P(HomogeneousBox, IsTheSameWithJitterOrAnyOtherSampleDistance)
{
  RenderScene scene = HomogeneousScene();
  scene.view.clipToWorld = GetParam().clipToWorld(scene.grid);
  scene.view.jitter = true;

  ExpectBeersLaw(scene, extinction);
  scene.view.sampleDistance = 100;
  ExpectBeersLaw(scene, extinction);
  scene.view.sampleDistance = 0.37;
  scene.view.jitter = false;
  ExpectBeersLaw(scene, extinction);
}

TEST_P(HomogeneousBox, AddsTheChangeOfACoarserGridAndClampsIt)
{
  RenderScene scene = HomogeneousScene();
  scene.view.clipToWorld = GetParam().clipToWorld(scene.grid);
  scene.functions.extinction = { 0.08f, 0.08f, float(extinction) }; // the scalars are in the middle
  scene.functions.color = { color, color, color };
  scene.changeGrid = WithNodes(scene.grid, { 4, 2, 5 });
  scene.base.assign(40, 0.05f);
  // The changed extinction keeps all or a share of the base and adds what exceeds it, up to the
  // majorant.
  const double most = extinction;
  for (const auto& [changed, expected] : { std::make_pair(0.09, 0.12), std::make_pair(0.01, 0.016),
         std::make_pair(0.0, 0.0), std::make_pair(most, most) })
  {
    scene.extinction.assign(40, float(changed));

    SCOPED_TRACE(changed);
    ExpectBeersLaw(scene, expected);
  }
}

TEST_P(HomogeneousBox, HasNoSurfaceAndScattersAsInTheMiddleWhateverTheLight)
{
  // Without anisotropy every direction is like the middle's; no gradient, no surface term.
  RenderScene scene = HomogeneousScene();
  scene.view.clipToWorld = GetParam().clipToWorld(scene.grid);
  scene.lighting.enabled = true;
  scene.lighting.shadows = false;
  scene.lighting.anisotropy = 0;
  scene.lighting.ambient = 0.3;
  scene.lighting.intensity = 0.5;
  scene.lighting.surface = 5;

  for (const Vec3& light : { Vec3(600, -200, 2100), scene.grid.Centre(), scene.grid.origin })
  {
    scene.lighting.light.position = light;
    ExpectBeersLaw(scene, extinction, 0.3 + 0.7 * 0.5);
  }
}

INSTANTIATE_TEST_SUITE_P(
  All, HomogeneousBox, ::testing::ValuesIn(Viewpoints()), ::testing::PrintToStringParamName());

TEST(HomogeneousBoxInParallelLight, KeepsItsColorAtIntensityOneAndAnyAnisotropy)
{
  RenderScene scene = HomogeneousScene();
  scene.view.clipToWorld = Parallel(From(scene.grid, { 9, 13, -30 }), 8, aspect, 5, 80);
  scene.lighting.enabled = true;
  scene.lighting.shadows = false;
  scene.lighting.light.type = LightType::Directional;
  scene.lighting.light.position = { 1, 2, 3 };
  scene.lighting.light.focalPoint = { 0, 0, 4 };
  for (const double anisotropy : { -0.9, 0.0, 0.6, 0.9 })
  {
    scene.lighting.anisotropy = anisotropy;
    ExpectBeersLaw(scene, extinction);
  }
}

TEST(HomogeneousBoxInPointLight, ScattersByHenyeyAndGreenstein)
{
  // The reference needs no second order here: only the phase function varies along a ray.
  RenderScene scene = HomogeneousScene();
  scene.view.clipToWorld = Perspective(From(scene.grid, { 9, 13, -30 }), 30, aspect, 5, 80);
  scene.lighting.enabled = true;
  scene.lighting.shadows = false;
  scene.lighting.light.position = scene.grid.Centre() + Vec3(-12, 5, 4);

  ExpectPicture(scene, scene.Render(),
    truth::PictureMarch(scene.Truth(), truth::Shadow::Marched, 16).Picture(scene.Frame()),
    EightBits());
}

TEST(HomogeneousBoxLitAlongTheView, IsDarkerOnlyWhereHardlyAnyLightArrives)
{
  // T_L = T_V = e^-t along the ray: all of the light counts as arriving down to the optical depth t
  // of four cells (along the coarsest axis), 3, then the share y = e^(3 - t), of which the
  // tone is 1 - (1 - y)^(3/2).
  RenderScene scene = RenderScene::Homogeneous(
    MakeGrid({ 9, 9, 65 }, { -1, -1, -1 }, { 0.25, 0.25, 0.03125 }), 3, { { 1, 1, 1 } });
  scene.view.width = scene.view.height = 9;
  scene.view.opaqueBelow = 0;
  scene.view.clipToWorld = Parallel(LookAt({ 0, 0, -5 }, { 0, 0, 0 }, { 0, 1, 0 }), 1, 1, 1, 10);
  scene.lighting.enabled = true;
  scene.lighting.light.type = LightType::Directional;
  scene.lighting.light.position = { 0, 0, -1 };
  scene.lighting.light.focalPoint = { 0, 0, 0 };
  scene.lighting.ambient = 0.1;
  scene.lighting.shadowStrength = 1;

  const Picture picture = scene.Render();

  const double depth = 2 * 3;
  const double own = 3 * 4 * 0.25;
  // The integral of e^-t (1 - (1 - y)^(3/2)) from there on, with u = 1 - y.
  const double end = 1 - std::exp(own - depth);
  const double shadowed = std::exp(-own) * (end - 0.4 * std::pow(end, 2.5));
  const double radiance = 0.1 * -std::expm1(-depth) + 0.9 * (-std::expm1(-own) + shadowed);
  // T_L is linear between slices 1/32 apart, and the light between samples: h^2/8 mu^2 each, of
  // what e^-3 of the light sees.
  const Tolerance tolerance = EightBits() +
    Tolerance{ 0.9 * 1.5 * 2 * std::pow(3 * 0.03125, 2) / 8 * std::exp(-own),
      "T_L linear between slices and samples" };
  for (std::size_t pixel = 0; pixel < 81; ++pixel)
  {
    EXPECT_WITHIN(Channel(picture, pixel, 0), radiance, tolerance);
  }
}
