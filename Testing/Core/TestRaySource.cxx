// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What a camera shows: opening angle and corners against each other and against a frustum whose
// sides are tested one by one.

#include "RandomScene.h"
#include "Tolerance.h"

#include "math/Require.h"
#include "scene/Grid.h"
#include "scene/RaySource.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
/// Returns the length of a ray to a point of the box over its advance along its depth axis.
double LayerTo(const RaySource& source, const Grid& grid, const Vec3& point)
{
  const Vec3 ray = source.parallel ? source.direction : point - source.origin;
  const Vec3 size = glm::abs(ray);
  return glm::length(ray * grid.spacing) / std::max({ size.x, size.y, size.z });
}

/// A grid with three spacings, turned and far from the origin.
Grid SkewGrid()
{
  Grid grid;
  grid.nodes = Int3(20, 30, 10);
  grid.origin = Vec3(100, -40, 7);
  grid.spacing = Vec3(0.5, 0.2, 1.5);
  const double c = std::cos(0.4);
  const double s = std::sin(0.4);
  grid.direction = Mat3(Vec3(c, s, 0), Vec3(-s, c, 0), Vec3(0, 0, 1));
  return grid;
}

Camera CameraOf(const Grid& grid, bool parallel)
{
  Camera camera;
  camera.focalPoint = grid.Centre();
  camera.position = grid.Centre() + grid.Radius() * Vec3(1.5, -2, 1.1);
  camera.viewUp = Vec3(0.2, 0.1, 1);
  camera.viewAngle = 24;
  camera.parallel = parallel;
  camera.parallelScale = 0.4 * grid.Radius();
  camera.aspect = 1.7;
  return camera;
}

/// Corners of the picture in the plane `distance` in front of the camera, by VTK's conventions.
std::vector<Vec3> CornersOf(const Camera& camera, double distance)
{
  const Vec3 forward = glm::normalize(camera.focalPoint - camera.position);
  const Vec3 right = glm::normalize(glm::cross(forward, camera.viewUp));
  const Vec3 up = glm::cross(right, forward);
  const double height = camera.parallel
    ? camera.parallelScale
    : distance * std::tan(camera.viewAngle * std::acos(-1.0) / 360);
  const auto corner = [&](double x, double y)
  {
    return camera.position + distance * forward + x * height * camera.aspect * right +
      y * height * up;
  };
  return { corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1) };
}

/// Whether a frustum lets the ray through a world position pass.
bool Passes(const RaySource& eye, const Grid& grid, const Vec3& world)
{
  const Vec3 index = grid.PointToIndex(world);
  const Vec3 ray = eye.parallel ? index : index - eye.origin;
  return std::all_of(eye.viewPlanes.begin(), eye.viewPlanes.end(),
    [&](const RaySource::Plane& plane) { return glm::dot(plane.normal, ray) + plane.offset >= 0; });
}

/// Whether the ray through a world position crosses one of the triangles of the picture: solves for
/// the crossing.
bool Crosses(const Camera& camera, const Vec3& world)
{
  const std::vector<Vec3>& corners = camera.corners;
  const Vec3 start = camera.parallel ? world : camera.position;
  const Vec3 along =
    camera.parallel ? camera.focalPoint - camera.position : world - camera.position;
  for (const std::array<int, 3>& triangle :
    { std::array<int, 3>{ { 0, 1, 2 } }, std::array<int, 3>{ { 0, 2, 3 } } })
  {
    const Vec3 a = corners[std::size_t(triangle[0])];
    const Mat3 edges(
      corners[std::size_t(triangle[1])] - a, corners[std::size_t(triangle[2])] - a, -along);
    const Vec3 solution = glm::inverse(edges) * (start - a);
    if (solution.x >= 0 && solution.y >= 0 && solution.x + solution.y <= 1 &&
      (camera.parallel || solution.z > 0))
    {
      return true;
    }
  }
  return false;
}

/// Positions in and about the box.
std::vector<Vec3> Positions(const Grid& grid)
{
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> within(-1.2, 1.2);
  std::vector<Vec3> positions(4000);
  for (Vec3& position : positions)
  {
    position =
      grid.Centre() + grid.Radius() * Vec3(within(generator), within(generator), within(generator));
  }
  return positions;
}

/// How often the two agree, and that both answers occur.
void ExpectToPassWhatCrosses(const Camera& camera, const Grid& grid)
{
  const RaySource eye = SourceOfCamera(camera, grid, true);
  int inside = 0;
  int outside = 0;
  for (const Vec3& position : Positions(grid))
  {
    const bool crosses = Crosses(camera, position);
    ++(crosses ? inside : outside);
    EXPECT_EQ(Passes(eye, grid, position), crosses)
      << position.x << ' ' << position.y << ' ' << position.z;
  }
  EXPECT_GT(inside, 200);
  EXPECT_GT(outside, 200);
}

/// A shear that a prop's matrix may contain.
Vec3 Sheared(const Vec3& x)
{
  return Mat3(Vec3(1, 0.3, 0), Vec3(-0.5, 1.2, 0.1), Vec3(0.2, 0.4, 0.7)) * x + Vec3(3, 1, -2);
}

std::string MessageOf(const Camera& camera)
{
  try
  {
    SourceOfCamera(camera, SkewGrid(), true);
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "";
}
}

class EyeOfCorners : public ::testing::TestWithParam<bool>
{
};

INSTANTIATE_TEST_SUITE_P(Projections, EyeOfCorners, ::testing::Bool(),
  [](const ::testing::TestParamInfo<bool>& projection)
  { return projection.param ? "Parallel" : "Perspective"; });

TEST_P(EyeOfCorners, SeesWhatTheSameOpeningSees)
{
  const Grid grid = SkewGrid();
  const Camera opening = CameraOf(grid, GetParam());
  for (const double distance : { 0.01, 1.0, 1000.0 })
  {
    for (const bool reversed : { false, true })
    {
      Camera camera = opening;
      camera.corners = CornersOf(opening, distance);
      if (reversed)
      {
        std::reverse(camera.corners.begin(), camera.corners.end());
      }

      const RaySource one = SourceOfCamera(opening, grid, true);
      const RaySource other = SourceOfCamera(camera, grid, true);

      ASSERT_EQ(other.viewPlanes.size(), 4u);
      for (const RaySource::Plane& plane : one.viewPlanes)
      {
        // Corners lose digits to the camera's position, here 1e3 times as large as their distance.
        const auto same = [&](const RaySource::Plane& candidate)
        {
          const double a = glm::length(plane.normal);
          const double b = glm::length(candidate.normal);
          return glm::length(plane.normal / a - candidate.normal / b) < 1e-10 &&
            std::abs(plane.offset / a - candidate.offset / b) < 1e-8;
        };
        EXPECT_EQ(std::count_if(other.viewPlanes.begin(), other.viewPlanes.end(), same), 1);
      }
    }
  }
}

TEST_P(EyeOfCorners, SeesThroughAPictureOffTheAxis)
{
  const Grid grid = SkewGrid();
  Camera camera = CameraOf(grid, GetParam());
  camera.corners = CornersOf(camera, 2.5 * grid.Radius());
  const Vec3 shift = 0.4 * (camera.corners[1] - camera.corners[0]);
  for (Vec3& corner : camera.corners)
  {
    corner += shift;
  }

  ExpectToPassWhatCrosses(camera, grid);
}

TEST_P(EyeOfCorners, SeesThroughAShear)
{
  const Grid grid = SkewGrid();
  const Camera straight = CameraOf(grid, GetParam());
  // Shears the camera about the centre of the grid.
  const Vec3 back = grid.Centre() - Sheared(grid.Centre());
  Camera camera = straight;
  camera.position = Sheared(straight.position) + back;
  camera.focalPoint = Sheared(straight.focalPoint) + back;
  for (const Vec3& corner : CornersOf(straight, 2 * grid.Radius()))
  {
    camera.corners.push_back(Sheared(corner) + back);
  }

  ExpectToPassWhatCrosses(camera, grid);
}

TEST_P(EyeOfCorners, DoesNotAskForAnOpening)
{
  const Grid grid = SkewGrid();
  Camera camera = CameraOf(grid, GetParam());
  camera.corners = CornersOf(camera, 1);
  camera.viewAngle = camera.parallelScale = camera.aspect = 0;

  EXPECT_EQ(SourceOfCamera(camera, grid, true).viewPlanes.size(), 4u);
}

TEST_P(EyeOfCorners, RejectsPicturesWithoutArea)
{
  const Grid grid = SkewGrid();
  Camera camera = CameraOf(grid, GetParam());
  const std::vector<Vec3> corners = CornersOf(camera, 1);

  camera.corners = { corners[0], corners[1], corners[1], corners[0] };
  EXPECT_NE(MessageOf(camera).find("span no area"), std::string::npos) << MessageOf(camera);
  camera.corners = { corners[0], corners[0], corners[0], corners[0] };
  EXPECT_NE(MessageOf(camera).find("span no area"), std::string::npos) << MessageOf(camera);
  camera.corners = { corners[0], corners[1], corners[2] };
  EXPECT_NE(MessageOf(camera).find("3 corners"), std::string::npos) << MessageOf(camera);
  camera.corners = corners;
  camera.corners[2].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(MessageOf(camera).find("nan"), std::string::npos) << MessageOf(camera);
}

TEST(RaySource, SeesAllRaysWithoutRestriction)
{
  const Grid grid = SkewGrid();
  Camera camera = CameraOf(grid, false);
  camera.corners = CornersOf(camera, 1);

  EXPECT_TRUE(SourceOfCamera(camera, grid, false).viewPlanes.empty());
}

TEST(RaySource, StaysOnThePlanesOfNodesOfATurnedGrid)
{
  for (unsigned seed = 0; seed < 500; ++seed)
  {
    SCOPED_TRACE("grid " + std::to_string(seed));
    RandomNumbers random(seed);
    Grid grid;
    grid.nodes = Int3(9, 7, 3);
    grid.spacing = Vec3(random.PowerOfTen(-1, 1), random.PowerOfTen(-1, 1), 1);
    grid.origin = 5.0 * random.Direction();
    grid.direction = random.Rotation();
    const Vec3 node(random.IntegerBetween(-20, 20), random.IntegerBetween(0, 8), 2);
    Vec3 alongAxis(0.0);
    alongAxis[random.IntegerBetween(0, 2)] = random.Sign();
    Camera camera;
    camera.position = grid.PointToWorld(node);
    camera.focalPoint = camera.position + grid.direction * (alongAxis * 3.0);

    const RaySource source = SourceOfCamera(camera, grid, false);

    EXPECT_EQ(source.origin, node);
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_EQ(source.direction[axis] == 0, alongAxis[axis] == 0);
    }
  }
}

TEST(RaySource, BoundsTheLengthOfItsLayers)
{
  for (unsigned seed = 0; seed < 300; ++seed)
  {
    SCOPED_TRACE("scene " + std::to_string(seed));
    const BoxScene scene = MakeRandomScene(seed);
    const RaySource source = SourceOfCamera(scene.camera, scene.grid, false);
    const double bound = LongestLayer(source, scene.grid);

    RandomNumbers random(seed);
    double longest = 0;
    for (int sample = 0; sample < 300; ++sample)
    {
      Vec3 point(0.0);
      for (int axis = 0; axis < 3; ++axis)
      {
        point[axis] = random.Between(0, scene.grid.nodes[axis] - 1);
      }
      longest = std::max(longest, LayerTo(source, scene.grid, point));
    }

    EXPECT_LE(longest, bound * (1 + 1e-12));
    EXPECT_LE(bound, glm::length(scene.grid.spacing) * (1 + 1e-12));
    if (source.parallel)
    {
      EXPECT_NEAR(longest, bound, 1e-12 * bound);
    }
  }
}
