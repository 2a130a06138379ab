// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Which axis of the world is upwards in a picture.

#include "math/Number.h"
#include "scene/UprightAxis.h"
#include "viewpoint/Search.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace limpid;

namespace
{
/// An upright camera, from so many degrees above the plane at right angles to `up`.
Camera Upright(const Vec3& up, double elevation, double azimuth)
{
  const Vec3 level(up.y, up.z, up.x);
  const Vec3 aside = glm::cross(up, level);
  const double angle = elevation * pi / 180;
  const double turn = azimuth * pi / 180;
  Orbit orbit;
  orbit.centre = Vec3(3, -4, 5);
  orbit.distance = 7;
  orbit.up = up;
  return orbit.At(
    std::sin(angle) * up + std::cos(angle) * (std::cos(turn) * level + std::sin(turn) * aside));
}

void ExpectUp(const Vec3& expected, const Camera& camera)
{
  const Vec3 found = UprightAxis(camera);
  EXPECT_EQ(found, expected) << found.x << " " << found.y << " " << found.z;
}

const Vec3 axes[] = { Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(-1, 0, 0), Vec3(0, -1, 0),
  Vec3(0, 0, -1) };
}

// The camera's own view-up is nearer to an axis that points away from 45 degrees on.
TEST(UprightAxis, IsTheOneOfAnUprightPictureFromAboveAndBelow)
{
  for (const Vec3& up : axes)
  {
    for (int elevation = -75; elevation <= 75; elevation += 15)
    {
      for (int azimuth = 5; azimuth < 360; azimuth += 23)
      {
        SCOPED_TRACE(testing::Message() << elevation << " " << azimuth);
        ExpectUp(up, Upright(up, elevation, azimuth));
      }
    }
  }
}

// Along an axis, two of them are upright; a person looks down at things.
TEST(UprightAxis, IsTheOneThatACameraInThePlaneOfTwoIsAbove)
{
  for (const Vec3& up : axes)
  {
    for (const int azimuth : { 0, 90, 180, 270 })
    {
      for (const int elevation : { 0, 30, 60 })
      {
        SCOPED_TRACE(testing::Message() << elevation << " " << azimuth);
        ExpectUp(up, Upright(up, elevation, azimuth));
      }
    }
  }
}

TEST(UprightAxis, IsTheNearestOfARolledPicture)
{
  Camera camera = Upright(Vec3(0, 0, 1), 10, 40);
  const Vec3 back = glm::normalize(camera.position - camera.focalPoint);
  camera.viewUp += std::tan(20 * pi / 180) * glm::cross(camera.viewUp, back);
  ExpectUp(Vec3(0, 0, 1), camera);
}

TEST(UprightAxis, IsSomeAxisWhereTheCameraHasNoPicture)
{
  Camera camera;
  camera.viewUp = camera.position - camera.focalPoint;
  EXPECT_EQ(glm::length(UprightAxis(camera)), 1);
}
