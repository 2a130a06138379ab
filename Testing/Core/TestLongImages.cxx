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

/// What a plan costs, per node.
struct Cost
{
  double rays = 0;    ///< rays with values
  double entries = 0; ///< columns and rows of rays that the plan describes, over all slices
  double visits = 0;  ///< rays that sweeps visit, over all slices
};

Cost CostPerNode(const BoxScene& scene, const RaySource& eye, double rayDensity = 1)
{
  const Occupancy filled(scene.grid, scene.extinction.data(), scene.importance.data(), true);
  const auto nodes = double(scene.grid.NodeCount());
  Cost cost;
  for (const PlannedFrustum& frustum :
    PlanSweep(scene.grid, filled, eye, { rayDensity, RayPlacement::ForIntegrals }))
  {
    cost.rays += double(frustum.RayCount()) / nodes;
    for (int s = 0; s < frustum.SliceCount(); ++s)
    {
      const Slice& slice = frustum.SliceAt(s);
      cost.entries += double(slice.rayColumns.Length() + slice.rayRows.Length()) / nodes;
      for (int row = slice.rayRows.begin; row < slice.rayRows.end; ++row)
      {
        cost.visits += double(frustum.ActiveRays(s, row).Length()) / nodes;
      }
    }
  }
  return cost;
}

/// An eye in a place that is given in the order: along the box, across it, and across it.
struct Eye
{
  const char* name;
  bool parallel;
  Vec3 from; ///< from the centre, in half diagonals of the box (parallel: whence the rays come)
};

const std::vector<Eye> eyes{
  { "along", true, { 1, 0, 0 } },
  { "across", true, { 0, 1, 0 } },
  { "diagonal", true, { 1, 1, 1 } },
  { "oblique", true, { 1, 0.3, -0.2 } },
  { "nearly along", true, { 1, 0.01, 0.007 } },
  { "nearly across", true, { 0.01, 1, 0.3 } },
  { "far, along", false, { 2.5, 0, 0 } },
  { "far, across", false, { 0, 2.5, 0 } },
  { "far, diagonal", false, { 2, 2, 1.8 } },
  { "before the end", false, { 1.001, 0, 0.0001 } },
  { "beside the end", false, { 1, 0.01, 0.002 } },
  { "beside the middle", false, { 0, 0.002, 0.0001 } },
  { "inside", false, { 0.1, 0.00003, 0.00005 } },
};

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
    for (const Eye& eye : eyes)
    {
      SCOPED_TRACE(::testing::Message() << axis << ", " << eye.name);
      const Vec3 from = scene.grid.Radius() * Turned(eye.from, axis);

      const Cost cost =
        CostPerNode(scene, eye.parallel ? Parallel(-from) : PointAt(scene.grid.Centre() + from));

      EXPECT_LE(cost.rays, 32);
      EXPECT_LE(cost.entries, 32);
      EXPECT_LE(cost.visits, 40); // of which most are beside the box, up to three voxels
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
          { Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0.1, 0.2, 1), Vec3(1, 0.9, -0.8) })
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
  BoxScene scene = LongBox(2, 5000, 2);

  try
  {
    CostPerNode(scene, Parallel(Vec3(1, 0.1, 0.2)), 1e5);
    FAIL() << "Nothing was thrown.";
  }
  catch (const Error& error)
  {
    EXPECT_NE(std::string(error.what()).find("GiB of memory"), std::string::npos) << error.what();
  }
}
