// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Where camera and light stand when nobody has placed them, against what the words say.

#include "Tolerance.h"

#include "scene/Grid.h"
#include "scene/Placement.h"
#include "scene/RaySource.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace limpid;

namespace
{
constexpr double degree = 3.14159265358979323846 / 180;
const Tolerance rounding = Roundoff<double>(64, 4.0); // of vectors no longer than that

double Elevation(const Vec3& direction, const Vec3& up)
{
  return std::asin(glm::dot(glm::normalize(direction), glm::normalize(up)));
}
}

TEST(Placement, TellsWhatNobodyHasPlaced)
{
  Camera camera;
  Light light;
  EXPECT_TRUE(IsUnplaced(camera));
  EXPECT_TRUE(IsUnplaced(light));

  camera.focalPoint.x = 1e-9;
  light.position.z = 2;
  EXPECT_FALSE(IsUnplaced(camera));
  EXPECT_FALSE(IsUnplaced(light));
}

TEST(Placement, LetsTheSphereOfTheDataFillTheViewAngle)
{
  Grid grid;
  grid.nodes = Int3(3, 4, 5);
  grid.origin = Vec3(1, 1, 1);
  grid.spacing = Vec3(0.5, 0.2, 0.1);
  Camera camera;

  PlaceCamera(grid, camera);

  const Vec3 back = camera.position - camera.focalPoint;
  EXPECT_EQ(camera.focalPoint, grid.Centre());
  EXPECT_EQ(Vec3(back.x, back.y, 0), Vec3(0.0));
  EXPECT_WITHIN(std::asin(grid.Radius() / back.z), 15 * degree, rounding);
  EXPECT_EQ(camera.parallelScale, grid.Radius());
}

TEST(Placement, PutsTheLightAboveAndToTheRightOfTheCamera)
{
  Camera camera;
  camera.position = Vec3(0, -3, 0);
  camera.viewUp = Vec3(0, 0, 2);
  Light light;

  PlaceLight(camera, light);

  EXPECT_WITHIN(glm::length(light.position), 3.0, rounding);
  EXPECT_WITHIN(Elevation(light.position, camera.viewUp), 50 * degree, rounding);
  EXPECT_WITHIN(std::atan2(light.position.x, -light.position.y), 10 * degree, rounding);
}

TEST(Placement, PutsTheLightSomewhereWhereUpIsTheWayOfTheView)
{
  Light light;
  for (const Vec3& way : { Vec3(2, 0, 0), Vec3(0, -2, 0), Vec3(0, 0, 2) })
  {
    Camera camera;
    camera.position = way;
    camera.viewUp = way;

    PlaceLight(camera, light);

    // 50 degrees above a level that has the camera 10 degrees off: cos 50 cos 10 in its direction.
    EXPECT_WITHIN(glm::length(light.position), 2.0, rounding);
    EXPECT_WITHIN(
      glm::dot(light.position, way) / 4, std::cos(50 * degree) * std::cos(10 * degree), rounding);
  }
}
