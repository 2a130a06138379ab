// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The box in the pictures of fitted cameras, by projection of its corners.

#include "math/Angle.h"
#include "math/Number.h"
#include "math/Require.h"
#include "scene/GridCorners.h"
#include "viewpoint/FittedCamera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using namespace limpid;

namespace
{
/// A box whose sides are to each other as these numbers, somewhere and askew.
Grid BoxOf(const Vec3& sides)
{
  Grid grid;
  grid.nodes = Int3(5, 9, 3);
  grid.spacing = sides / (Vec3(grid.nodes) - 1.0);
  grid.origin = Vec3(100, -20, 3);
  grid.direction = RotationOf({ 0.4, -0.9 });
  return grid;
}

const std::vector<Vec3> boxes = { Vec3(1, 1, 1), Vec3(1, 1, 2), Vec3(5, 1, 1), Vec3(1, 30, 40),
  Vec3(1e-3, 2e-3, 1e-3) };

struct Picture
{
  double aspect;
  double viewAngle;
};
const std::vector<Picture> pictures = { { 1, 30 }, { 1.5, 30 }, { 0.6, 30 }, { 2.4, 30 }, { 1, 10 },
  { 1.78, 20 }, { 1.33, 45 }, { 0.75, 60 }, { 1.78, 60 }, { 3, 75 } };

std::vector<Vec3> Directions()
{
  std::vector<Vec3> directions = { Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, -1),
    glm::normalize(Vec3(1, 1, 1)), glm::normalize(Vec3(0.01, 0.02, 1)) };
  std::mt19937 random(7); // NOLINT(cert-msc51-cpp): the same each time
  std::normal_distribution<double> normal;
  while (directions.size() < 60)
  {
    directions.push_back(glm::normalize(Vec3(normal(random), normal(random), normal(random))));
  }
  return directions;
}

Orbit OrbitOf(const Grid& grid, const Picture& picture, bool parallel)
{
  Orbit orbit;
  orbit.centre = grid.Centre();
  orbit.distance = 3 * grid.Radius();
  orbit.viewAngle = picture.viewAngle;
  orbit.aspect = picture.aspect;
  orbit.parallel = parallel;
  orbit.up = Vec3(0, 0, 1);
  return orbit;
}

/// Where corners are in a picture whose edges are at -1 and 1, by VTK's conventions.
struct Shown
{
  Vec3 least{ 1e9 };
  Vec3 most{ -1e9 };

  Shown(const Camera& camera, const std::vector<Vec3>& corners)
  {
    const Vec3 forward = glm::normalize(camera.focalPoint - camera.position);
    const Vec3 right = glm::normalize(glm::cross(forward, camera.viewUp));
    const double half =
      camera.parallel ? camera.parallelScale : std::tan(camera.viewAngle * pi / 360);
    for (const Vec3& corner : corners)
    {
      const Vec3 offset = corner - camera.position;
      const double depth = glm::dot(offset, forward);
      const double height = half * (camera.parallel ? 1 : depth);
      const Vec3 at(glm::dot(offset, right) / (height * camera.aspect),
        glm::dot(offset, glm::cross(right, forward)) / height, depth);
      this->least = glm::min(this->least, at);
      this->most = glm::max(this->most, at);
    }
  }

  bool IsInside() const
  {
    return this->least.x >= -1 && this->least.y >= -1 && this->most.x <= 1 && this->most.y <= 1 &&
      this->least.z > 0;
  }

  /// The filled share of the picture's width or height, whichever is larger.
  double Filled() const
  {
    return 0.5 * std::max(this->most.x - this->least.x, this->most.y - this->least.y);
  }
};

template <class Function>
void ForAllPictures(const Function& function)
{
  for (const Vec3& sides : boxes)
  {
    for (const Picture& picture : pictures)
    {
      for (const bool parallel : { false, true })
      {
        SCOPED_TRACE(testing::Message()
          << "sides " << sides.x << " " << sides.y << " " << sides.z << ", aspect "
          << picture.aspect << ", angle " << picture.viewAngle << ", parallel " << parallel);
        const Grid grid = BoxOf(sides);
        function(OrbitOf(grid, picture, parallel), CornersOf(grid));
      }
    }
  }
}
}

TEST(FittedCamera, ShowsAllOfTheBoxAndLittleElse)
{
  ForAllPictures(
    [](const Orbit& orbit, const std::vector<Vec3>& corners)
    {
      for (const Vec3& direction : Directions())
      {
        SCOPED_TRACE(testing::Message() << direction.x << " " << direction.y << " " << direction.z);
        const Camera camera = FittedCamera(orbit, corners, direction, Aim::Box);
        const Shown shown(camera, corners);
        EXPECT_TRUE(shown.IsInside());
        EXPECT_GE(shown.Filled(), 0.85);
        EXPECT_LE(shown.Filled(), 0.951);
      }
    });
}

TEST(FittedCamera, StandsInTheDirectionAndIsUpright)
{
  ForAllPictures(
    [](const Orbit& orbit, const std::vector<Vec3>& corners)
    {
      for (const Vec3& direction : Directions())
      {
        const Camera camera = FittedCamera(orbit, corners, direction, Aim::Box);
        EXPECT_LT(AngleBetween(camera.position - orbit.centre, direction), 1e-9);
        const Vec3 right = glm::cross(camera.focalPoint - camera.position, camera.viewUp);
        // Straight above or below, nothing is upright.
        const bool steep = std::abs(glm::dot(direction, orbit.up)) > std::sin(60 * pi / 180);
        EXPECT_TRUE(steep || std::abs(glm::dot(glm::normalize(right), orbit.up)) < 1e-9);
        EXPECT_TRUE(steep || glm::dot(camera.viewUp, orbit.up) > 0);
        EXPECT_EQ(camera.viewAngle, orbit.viewAngle);
        EXPECT_EQ(camera.aspect, orbit.aspect);
      }
    });
}

TEST(FittedCamera, CanLookAtTheCentreAllTheSame)
{
  ForAllPictures(
    [](Orbit orbit, const std::vector<Vec3>& corners)
    {
      orbit.centre = 0.7 * orbit.centre + 0.3 * corners[0]; // that of a person, not of the box
      for (const Vec3& direction : Directions())
      {
        const Camera camera = FittedCamera(orbit, corners, direction, Aim::Centre);
        const Shown shown(camera, corners);
        EXPECT_TRUE(shown.IsInside());
        const double most =
          std::max({ -shown.least.x, -shown.least.y, shown.most.x, shown.most.y });
        EXPECT_NEAR(most, 0.95, 1e-6); // one corner is next to an edge
        EXPECT_EQ(camera.focalPoint, orbit.centre);
      }
    });
}

TEST(FittedCamera, ShowsAllOfTheBoxAtEveryViewAngle)
{
  const Grid grid = BoxOf(Vec3(2, 1, 3));
  const std::vector<Vec3> corners = CornersOf(grid);
  for (const double angle : { 0.1, 1.0, 90.0, 120.0, 150.0, 179.0 })
  {
    for (const Vec3& direction : Directions())
    {
      SCOPED_TRACE(testing::Message() << angle);
      const Orbit orbit = OrbitOf(grid, { 1.6, angle }, false);
      EXPECT_TRUE(Shown(FittedCamera(orbit, corners, direction, Aim::Box), corners).IsInside());
    }
  }
}

TEST(FittedOrbit, ShowsAllOfTheBoxFromEverywhereAtOneDistance)
{
  ForAllPictures(
    [](const Orbit& orbit, const std::vector<Vec3>& corners)
    {
      const std::vector<Vec3> directions = Directions();
      const Orbit fitted = FittedOrbit(orbit, corners, directions);
      double most = 0;
      for (const Vec3& direction : directions)
      {
        const Camera camera = fitted.At(direction);
        const Shown shown(camera, corners);
        EXPECT_TRUE(shown.IsInside());
        most = std::max({ most, -shown.least.x, -shown.least.y, shown.most.x, shown.most.y });
      }
      EXPECT_NEAR(most, 0.95, 1e-6); // not farther away than it must be
    });
}

TEST(FittedCamera, RefusesPicturesWithoutAnArea)
{
  const Grid grid = BoxOf(Vec3(1));
  const Orbit orbit = OrbitOf(grid, { 0, 30 }, false);
  EXPECT_THROW(FittedCamera(orbit, CornersOf(grid), Vec3(1, 0, 0), Aim::Box), Error);
  EXPECT_THROW(FittedCamera(Orbit(), {}, Vec3(1, 0, 0), Aim::Box), Error);
}
