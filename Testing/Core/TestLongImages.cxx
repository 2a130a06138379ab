// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Images that are many times as long as they are wide: what is seen of them, and at what price.

#include "BoxScene.h"
#include "NodeImportanceOfAll.h"
#include "PlanSweep.h"
#include "RaySources.h"
#include "Tolerance.h"

#include "energy/VisibilityTerm.h"
#include "math/Require.h"

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
  double rows = 0;    ///< rows of rays that sweeps visit, over all slices
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
        const Range<int> active = frustum.ActiveRays(s, row);
        cost.visits += double(active.Length()) / nodes;
        cost.rows += active.Empty() ? 0 : 1 / nodes;
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

/// Counts the rays of a plan that are not visited where they are inside the box, or where voxels
/// interpolate them.
int MissingRays(const PlannedFrustum& frustum)
{
  int missing = 0;
  for (int s = 0; s < frustum.lastSlice; ++s)
  {
    const Slice& slice = frustum.SliceAt(s);
    const float back = slice.layer.front + slice.layer.thickness;
    Range<int> rowsRead;
    Range<int> columnsRead;
    if (frustum.HasVoxels() && !slice.ownedRows.Empty() && !slice.ownedColumns.Empty())
    {
      const int* rows = frustum.Row(frustum.voxelRows, s).index;
      const int* columns = frustum.Row(frustum.voxelColumns, s).index;
      rowsRead = { rows[slice.ownedRows.begin], rows[slice.ownedRows.end - 1] + 2 };
      columnsRead = { columns[slice.ownedColumns.begin], columns[slice.ownedColumns.end - 1] + 2 };
    }
    for (int row = 1; row + 1 < frustum.rows; ++row)
    {
      for (int column = 1; column + 1 < frustum.columns; ++column)
      {
        const Range<float> inside =
          Intersection(frustum.StayOfRow(row), frustum.StayOfColumn(column));
        const bool meets = !inside.Empty() && inside.begin < back && inside.end > slice.layer.front;
        const bool isRead = rowsRead.Contains(row) && columnsRead.Contains(column);
        missing += (meets || isRead) && !frustum.ActiveRays(s, row).Contains(column) ? 1 : 0;
      }
    }
  }
  return missing;
}

/// The slope of a score as all extinction grows by a common factor.
struct Slope
{
  double difference;
  double derivative; ///< from the derivative by the extinction of each node
  double size;       ///< sum of the magnitudes of all contributions
};

Slope SlopeOf(const BoxScene& scene, const RaySource& eye)
{
  const Occupancy filled(scene.grid, scene.extinction.data(), scene.importance.data(), true);
  const std::vector<float> nodeImportance =
    NodeImportanceOfAll(scene.grid, scene.importance.data());
  VisibilityTerm<HostDevice> term(HostDevice::Shared(), scene.grid, filled, eye, 1);
  Seen seen;
  const auto scoreWith = [&](double factor)
  {
    std::vector<float> extinction = scene.extinction;
    for (float& value : extinction)
    {
      value *= static_cast<float>(factor);
    }
    term.Forward({ extinction.data(), scene.importance.data(), nodeImportance.data() }, &seen);
    return seen.all.visible;
  };
  constexpr double step = 0.01;
  Slope slope{ (scoreWith(1 + step) - scoreWith(1 - step)) / (2 * step), 0, 0 };
  std::vector<float> gradient(scene.extinction.size(), 0.0f);
  term.Differentiate({ scene.extinction.data(), scene.importance.data(), nodeImportance.data() },
    Derivative::Volume, { 1.0f, 1.0f }, gradient.data(), &seen);
  scene.ForEachNode(
    [&](std::size_t node, int i, int j, int k)
    {
      double part = -scene.grid.CellVolume() * gradient[node] * scene.extinction[node];
      const Int3 at(i, j, k);
      for (int axis = 0; axis < 3; ++axis)
      {
        part *= at[axis] == 0 || at[axis] == scene.grid.nodes[axis] - 1 ? 0.5 : 1.0;
      }
      slope.derivative += part;
      slope.size += std::abs(part);
    });
  return slope;
}
}

// A cube of as many nodes takes one to four rays per node.
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

      EXPECT_LE(cost.rays, 8);
      EXPECT_LE(cost.entries, 16);
      EXPECT_LE(cost.visits, 12); // of which most are next to the box, where voxels read them
      EXPECT_LE(cost.rows, 1.5);
    }
  }
}

// Seen from the side, rows along the box have enough rays. Across it a few rows are enough.
TEST(LongImages, TakeFewRaysFromTheSide)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    SCOPED_TRACE(axis);
    BoxScene scene = LongBox(2, 5000, axis);
    scene.Fill(Everywhere(0.01), Everywhere(1));

    EXPECT_LE(CostPerNode(scene, Parallel(Turned(Vec3(0, 1, 0), axis))).visits, 4);
  }
}

// Steps skip the rays that no plan visits, so that none that matters may be missing.
TEST(LongImages, VisitAllRaysThatMeetTheBoxOrThatVoxelsRead)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    BoxScene scene = LongBox(3, 500, axis);
    scene.Fill(Everywhere(0.01), Everywhere(1));
    const Occupancy filled(scene.grid, scene.extinction.data(), scene.importance.data(), true);
    for (const Eye& eye : eyes)
    {
      SCOPED_TRACE(::testing::Message() << axis << ", " << eye.name);
      const Vec3 from = scene.grid.Radius() * Turned(eye.from, axis);
      const RaySource source = eye.parallel ? Parallel(-from) : PointAt(scene.grid.Centre() + from);
      int missing = 0;
      for (const Readers readers : { Readers::Rays, Readers::RaysAndVoxels })
      {
        for (const PlannedFrustum& frustum :
          PlanSweep(scene.grid, filled, source, { 1.3, RayPlacement::ForIntegrals, readers }))
        {
          missing += MissingRays(frustum);
        }
      }

      EXPECT_EQ(missing, 0);
    }
  }
}

// The derivative is that of the score, ray by ray, so that it tells whether voxels read what rays
// have left there. Near an eye it is divided by the part of a voxel that rays cover.
TEST(LongImages, HaveTheDerivativeOfTheirScore)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    BoxScene scene = LongBox(3, 90, axis);
    scene.Fill([&](const Vec3& x)
      { return 0.05 + 0.04 * std::sin(0.3 * x[axis] + x[(axis + 1) % 3]); },
      [&](const Vec3& x) { return std::max(0.0, std::sin(0.17 * x[axis] + x[(axis + 2) % 3])); });
    for (const Eye& eye : eyes)
    {
      if (!eye.parallel && !(glm::length(eye.from) > 2))
      {
        continue;
      }
      SCOPED_TRACE(::testing::Message() << axis << ", " << eye.name);
      const Vec3 from = scene.grid.Radius() * Turned(eye.from, axis);
      const Slope slope =
        SlopeOf(scene, eye.parallel ? Parallel(-from) : PointAt(scene.grid.Centre() + from));

      EXPECT_WITHIN(slope.derivative, slope.difference,
        Relative(5e-3, slope.size, "a step of 1 %, and voxels between two frusta"));
    }
  }
}

// Three rays at Gauss points are closer to it than four in the middle of equal parts.
TEST(LongImages, HaveTheScoreOfAMarchAlongThem)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    SCOPED_TRACE(axis);
    BoxScene scene = LongBox(2, 1500, axis);
    scene.Fill([&](const Vec3& x) { return 0.002 * x[(axis + 1) % 3] * x[(axis + 2) % 3]; },
      [&](const Vec3& x) { return x[(axis + 1) % 3] * x[(axis + 2) % 3]; });
    scene.camera.parallel = true;
    scene.camera.position = scene.camera.focalPoint + Turned(Vec3(-2000, 0, 0), axis);
    scene.camera.viewUp = Turned(Vec3(0, 1, 0), axis);
    scene.settings.maximumIterations = 0;

    const double march = scene.TrueScore(scene.extinction, 32);

    EXPECT_WITHIN(scene.MakeSolver().BaseScore().visibility, march,
      Relative(1e-3, march, "the march's own error and that of attenuation across the cell"));
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
