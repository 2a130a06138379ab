// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Images that are many times as long as they are wide: what is seen of them, and at what price.

#include "BoxScene.h"
#include "RaySources.h"
#include "Tolerance.h"

#include "math/Require.h"
#include "sweep/PlanSweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
/// A box of one-voxel cells, some layers long along an axis.
BoxScene LongBox(int across, int along, int axis)
{
  Int3 nodes(across);
  nodes[axis] = along;
  return BoxScene(nodes, Vec3(0.0), Vec3(1.0));
}

/// Rays times layers of all frusta, per node.
double WorkPerNode(const BoxScene& scene, const RaySource& eye)
{
  const Occupancy filled(scene.grid, scene.extinction.data(), scene.importance.data(), true);
  double work = 0;
  for (const PlannedFrustum& frustum :
    PlanSweep(scene.grid, filled, eye, { 1, RayPlacement::ForIntegrals }))
  {
    work += double(frustum.columns) * frustum.rows * (frustum.lastSlice + 1);
  }
  return work / double(scene.grid.NodeCount());
}
/// Puts components along and across a box onto the axes of the grid.
Vec3 Turned(const Vec3& from, int axis)
{
  Vec3 turned(0.0);
  for (int c = 0; c < 3; ++c)
  {
    turned[(axis + c) % 3] = from[c];
  }
  return turned;
}
}

// A cube of as many nodes takes one to three rays per node.
TEST(LongImages, TakeFewRaysPerNode)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    BoxScene scene = LongBox(2, 5000, axis);
    scene.Fill(Everywhere(0.01), Everywhere(1));
    const double radius = scene.grid.Radius();
    for (int towards = 0; towards < 3; ++towards)
    {
      SCOPED_TRACE(::testing::Message() << axis << " from " << towards);
      Vec3 eye = scene.grid.Centre();
      eye[towards] -= 2.5 * radius;
      Vec3 direction(0.0);
      direction[towards] = 1;

      EXPECT_LE(WorkPerNode(scene, PointAt(eye)), 32);
      EXPECT_LE(WorkPerNode(scene, Parallel(direction)), 32);
    }
  }
}

TEST(LongImages, HaveTheScoreOfAMarch)
{
  for (const int across : { 2, 5 })
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      for (const bool parallel : { false, true })
      {
        for (const Vec3& towards :
          { Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0.1, 0.2, 1) })
        {
          SCOPED_TRACE(::testing::Message() << across << ' ' << axis << ' ' << parallel << ' '
                                            << towards.x << towards.y << towards.z);
          BoxScene scene = LongBox(across, 150, axis);
          scene.Fill([&](const Vec3& x)
            { return 0.02 * std::max(0.0, std::sin(0.3 * x[axis] + x[(axis + 1) % 3])); },
            [&](const Vec3& x) { return std::max(0.0, std::sin(0.17 * x[axis])); });
          scene.camera.parallel = parallel;
          scene.camera.focalPoint = scene.grid.Centre();
          scene.camera.position = scene.grid.Centre() - 200.0 * glm::normalize(towards);
          scene.camera.viewUp = Vec3(0.3, 1, 0.2);
          scene.settings.maximumIterations = 0;

          const double march = scene.TrueScore(scene.extinction, 8);

          EXPECT_WITHIN(scene.MakeSolver().BaseScore().visibility, march,
            Relative(5e-3, march, "four rays across a voxel"));
        }
      }
    }
  }
}

// Most rays of an eye near a long box leave it after a few slices.
TEST(LongImages, TakeFewRaysFromNearby)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    BoxScene scene = LongBox(2, 5000, axis);
    scene.Fill(Everywhere(0.01), Everywhere(1));
    const Occupancy filled(scene.grid, scene.extinction.data(), scene.importance.data(), true);
    // Inside, in front of an end, and beside the middle.
    for (const Vec3& from : { Vec3(0.3, 0.1, 0.2), Vec3(2502, 0.1, 0), Vec3(0, 3, 0.1) })
    {
      SCOPED_TRACE(::testing::Message() << axis << ' ' << from.x << ' ' << from.y);
      double rays = 0;
      for (const PlannedFrustum& frustum : PlanSweep(scene.grid, filled,
             PointAt(scene.grid.Centre() + Turned(from, axis)), { 1, RayPlacement::ForIntegrals }))
      {
        rays += double(frustum.RayCount());
      }

      EXPECT_LE(rays, 8 * double(scene.grid.NodeCount()));
    }
  }
}

// Rays of a point eye that leave through a side are placed less densely (SideDensity).
TEST(LongImages, HaveTheScoreOfAMarchFromNearby)
{
  constexpr int across = 5;
  for (const Vec3& from : { Vec3(0.1, 0.2, 0.3), Vec3(83, 0.3, 0.1), Vec3(70, 9, 4),
         Vec3(20, 7, 0.3), Vec3(0.2, 11, 13) })
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      SCOPED_TRACE(::testing::Message() << axis << ' ' << from.x << ' ' << from.y);
      BoxScene scene = LongBox(across, 150, axis);
      scene.Fill([&](const Vec3& x)
        { return 0.02 * std::max(0.0, std::sin(0.3 * x[axis] + x[(axis + 1) % 3])); },
        [&](const Vec3& x) { return std::max(0.0, std::sin(0.17 * x[axis])); });
      scene.camera.position = scene.grid.Centre() + Turned(from, axis);
      scene.camera.focalPoint = scene.grid.Centre() + Vec3(0.01, 0.02, 0.03);
      scene.settings.maximumIterations = 0;

      const double march = scene.TrueScore(scene.extinction, 4);

      EXPECT_WITHIN(
        scene.MakeSolver().BaseScore().visibility, march, Relative(5e-3, march, "as from afar"));
    }
  }
}

TEST(LongImages, AreRefusedWhereNoMachineHasMemoryForTheRays)
{
  BoxScene scene = LongBox(2, 500000, 2);
  const Vec3 eye = scene.grid.Centre() + 3.0 * scene.grid.Radius() * Vec3(0.3, 0.3, 0.9);

  try
  {
    WorkPerNode(scene, PointAt(eye));
    FAIL() << "Nothing was thrown.";
  }
  catch (const Error& error)
  {
    EXPECT_NE(std::string(error.what()).find("GiB of memory"), std::string::npos) << error.what();
  }
}
