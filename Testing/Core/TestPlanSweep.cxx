// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "PlanOf.h"
#include "PlanSweep.h"
#include "Tolerance.h"

#include "backend/Backend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

using namespace limpid;

namespace
{
/// Whether a place along a lateral axis is in the box at a depth.
bool IsInside(const Lateral& lateral, int ray, double depth)
{
  const double position = lateral.Position(lateral.Coordinate(ray), depth);
  return position >= 0 && position <= lateral.nodes - 1;
}

/// Whether a ray meets anything of a field at a Gauss point of the layer behind a slice.
bool Meets(const Boxes& scene, const std::vector<float>& field, const PlannedFrustum& frustum,
  int s, int half, int column, int row)
{
  const Slice& slice = frustum.SliceAt(s);
  const double thickness = frustum.SliceAt(s + 1).depth - slice.depth;
  const double depth = slice.depth + gaussPoints[half] * thickness;
  if (!IsInside(frustum.lateralU, column, depth) || !IsInside(frustum.lateralV, row, depth))
  {
    return false;
  }
  const LinearMap columns = frustum.PlaneColumns(2 * s + half);
  const LinearMap rows = frustum.PlaneRows(2 * s + half);
  for (int corner = 0; corner < 8; ++corner)
  {
    Int3 node(0);
    node[frustum.axisU] = columns.index[column] + corner % 2;
    node[frustum.axisV] = rows.index[row] + corner / 2 % 2;
    node[frustum.axisW] = slice.nodes[corner / 4];
    const Int3& count = scene.grid.nodes;
    if (field[std::size_t((Index(node.z) * count.y + node.y) * count.x + node.x)] > 0)
    {
      return true;
    }
  }
  return false;
}

/// Per ray of a frustum, whether it meets anything of a field in the layer behind a slice.
std::vector<bool> RaysThatMeet(
  const Boxes& scene, const std::vector<float>& field, const PlannedFrustum& frustum, int s)
{
  std::vector<bool> meets;
  for (int row = 0; row < frustum.rows; ++row)
  {
    for (int column = 0; column < frustum.columns; ++column)
    {
      meets.push_back(Meets(scene, field, frustum, s, 0, column, row) ||
        Meets(scene, field, frustum, s, 1, column, row));
    }
  }
  return meets;
}

/// Whether a ray or one beside it is marked.
bool AnyNear(const PlannedFrustum& frustum, const std::vector<bool>& rays, int column, int row)
{
  for (int j = std::max(row - 1, 0); j <= std::min(row + 1, frustum.rows - 1); ++j)
  {
    for (int i = std::max(column - 1, 0); i <= std::min(column + 1, frustum.columns - 1); ++i)
    {
      if (rays[std::size_t(j) * std::size_t(frustum.columns) + std::size_t(i)])
      {
        return true;
      }
    }
  }
  return false;
}

}

// What a ray meets in a layer matters if there is something important there or behind, on the ray
// itself or on one beside it, which a voxel may read together with it.
TEST_P(PlanOf, LeavesOutNothingThatMatters)
{
  for (const PlannedFrustum& frustum : this->frusta)
  {
    std::vector<bool> importantBehind(
      std::size_t(frustum.columns) * std::size_t(frustum.rows), false);
    for (int s = frustum.lastSlice - 1; s >= 0; --s)
    {
      const std::vector<bool> filled =
        RaysThatMeet(this->scene, this->scene.extinction, frustum, s);
      const std::vector<bool> important =
        RaysThatMeet(this->scene, this->scene.importance, frustum, s);
      std::transform(important.begin(), important.end(), importantBehind.begin(),
        importantBehind.begin(), [](bool one, bool other) { return one || other; });
      for (int row = 0; row < frustum.rows; ++row)
      {
        const Range<int>& active = frustum.ActiveRays(s, row);
        for (int column = 0; column < frustum.columns; ++column)
        {
          const bool visited = active.Contains(column);
          const auto ray = std::size_t(row) * std::size_t(frustum.columns) + std::size_t(column);
          ASSERT_TRUE(visited || !filled[ray] || !AnyNear(frustum, importantBehind, column, row))
            << "ray " << column << ", " << row << " at slice " << s;
        }
      }
    }
  }
}

TEST_P(PlanOf, LeavesOutMuchOfASparseScene)
{
  Index visited = 0;
  Index all = 0;
  for (const PlannedFrustum& frustum : this->frusta)
  {
    all += frustum.RayCount() * frustum.lastSlice;
    for (int s = 0; s <= frustum.lastSlice; ++s)
    {
      for (int row = 0; row < frustum.rows; ++row)
      {
        visited += std::max(frustum.ActiveRays(s, row).Length(), 0);
      }
    }
  }

  EXPECT_LT(visited, all);
}

TEST_P(PlanOf, KnowsTheVoxelsBetweenWhichEveryRayRuns)
{
  for (const PlannedFrustum& frustum : this->frusta)
  {
    for (int s = 0; s < frustum.lastSlice; ++s)
    {
      const Slice& slice = frustum.SliceAt(s);
      const double thickness = frustum.SliceAt(s + 1).depth - slice.depth;
      for (int half = 0; half < 2; ++half)
      {
        const LinearMap map = frustum.PlaneColumns(2 * s + half);
        const double depth = slice.depth + gaussPoints[half] * thickness;
        for (int column = slice.rayColumns.begin; column < slice.rayColumns.end; ++column)
        {
          const int ray = column;
          const double position =
            frustum.lateralU.Position(frustum.lateralU.Coordinate(column), depth);
          const double inside = std::min(std::max(position, 0.0), frustum.nodesU - 1.0);
          ASSERT_GE(map.index[ray], 0);
          ASSERT_LE(map.index[ray], frustum.nodesU - 2);
          ASSERT_WITHIN(double(map.weight[ray]) + map.index[ray], inside, Roundoff<float>(1, 1.0));
        }
      }
    }
  }
}

TEST_P(PlanOf, KnowsTheRaysBetweenWhichEveryVoxelLies)
{
  for (const PlannedFrustum& frustum : this->frusta)
  {
    for (int s = frustum.firstNodeSlice; s <= frustum.lastSlice; ++s)
    {
      const Slice& slice = frustum.SliceAt(s);
      const Lateral& rays = frustum.lateralV;
      for (int v = 0; v < frustum.nodesV; ++v)
      {
        const int ray = frustum.Row(frustum.voxelRows, s).index[v];
        const double weight = frustum.Row(frustum.voxelRows, s).weight[v];
        ASSERT_GE(ray, 0);
        ASSERT_LE(ray, frustum.rows - 2);
        const double before = rays.Position(rays.Coordinate(ray), slice.depth);
        const double behind = rays.Position(rays.Coordinate(ray + 1), slice.depth);
        const double first = rays.Position(rays.Coordinate(0), slice.depth);
        const double last = rays.Position(rays.Coordinate(frustum.rows - 1), slice.depth);
        const double nearest = std::min(std::max(double(v), first), last);
        const double size = std::abs(rays.eye) + std::abs(rays.shear) * slice.depth + last - first;
        ASSERT_WITHIN(before + weight * (behind - before), nearest,
          Roundoff<float>(1, behind - before) + Roundoff<double>(16, size));
      }
    }
  }
}

TEST_P(PlanOf, KnowsWhereTheRaysOfVoxelsEnterTheBox)
{
  constexpr float never = 1e30f;
  for (const PlannedFrustum& frustum : this->frusta)
  {
    for (int s = frustum.firstNodeSlice; s <= frustum.lastSlice; ++s)
    {
      const Slice& slice = frustum.SliceAt(s);
      const Lateral& rays = frustum.lateralU;
      const double base = slice.depth - slice.RelativeDepth();
      for (int u = 0; u < frustum.nodesU; ++u)
      {
        const float entry = frustum.Row(frustum.voxelColumnEntry, s)[u];
        const double fromEye = rays.parallel ? rays.shear : (u - rays.eye) / slice.depth;
        if (fromEye == 0)
        {
          ASSERT_EQ(entry, -never);
          continue;
        }
        // Where the ray comes from, it passes the side that it moves away from.
        const double side = fromEye > 0 ? 0 : frustum.nodesU - 1;
        const double expected = slice.depth + (side - u) / fromEye - base;
        const double size = std::abs(expected) + slice.depth +
          (std::abs(rays.eye) + frustum.nodesU) / std::abs(fromEye);
        ASSERT_WITHIN(entry, std::max(expected, -1e30),
          Roundoff<float>(2, expected) + Roundoff<double>(16, size));
      }
    }
  }
}

TEST_P(PlanOf, IsTheSameOnOneThread)
{
  const ThreadLimit one(1);

  const std::vector<PlannedFrustum> again = PlanSweep(this->scene.grid, this->scene.MakeOccupancy(),
    GetParam().eye, { GetParam().rayDensity, GetParam().placement });

  ASSERT_EQ(again.size(), this->frusta.size());
  for (std::size_t index = 0; index < again.size(); ++index)
  {
    const PlannedFrustum& first = again[index];
    const PlannedFrustum& second = this->frusta[index];
    ASSERT_EQ(first.lastSlice, second.lastSlice);
    ASSERT_EQ(first.bytes, second.bytes);
    for (int s = 0; s <= first.lastSlice; ++s)
    {
      const Slice& here = first.SliceAt(s);
      const Slice& other = second.SliceAt(s);
      for (int row = 0; row < first.rows; ++row)
      {
        EXPECT_EQ(first.ActiveRays(s, row).begin, second.ActiveRays(s, row).begin);
        EXPECT_EQ(first.ActiveRays(s, row).end, second.ActiveRays(s, row).end);
      }
      EXPECT_EQ(here.touchedColumns.begin, other.touchedColumns.begin);
      EXPECT_EQ(here.touchedColumns.end, other.touchedColumns.end);
      EXPECT_EQ(here.touchedRows.begin, other.touchedRows.begin);
      EXPECT_EQ(here.touchedRows.end, other.touchedRows.end);
    }
  }
}

namespace
{
/// Expects two plans to agree bit by bit. Both lay out their tables in the same way.
void ExpectSameTables(const PlannedFrustum& host, const FaceFrustum& device)
{
  const auto same = [&](const char* name, const auto& table, int rows)
  {
    for (int row = 0; row < rows; ++row)
    {
      const auto* here = host.Row(table, row);
      const auto* there = device.Row(table, row);
      EXPECT_EQ(std::memcmp(here, there, std::size_t(table.rowLength) * sizeof(*here)), 0)
        << name << ", row " << row;
    }
  };
  const int slices = host.SliceCount();
  for (const MapTable* map : { &host.planeColumns, &host.planeRows })
  {
    same("index of rays", map->index, 2 * slices);
    same("weight of rays", map->weight, 2 * slices);
  }
  for (const MapTable* map : { &host.voxelColumns, &host.voxelRows })
  {
    same("index of voxels", map->index, slices);
    same("weight of voxels", map->weight, slices);
  }
  for (const Table<float>* table : { &host.columnSides, &host.rowSides, &host.columnHatGain,
         &host.rowHatGain, &host.voxelColumnEntry, &host.voxelRowEntry })
  {
    same("of voxels", *table, slices);
  }
  same("first voxels", host.firstVoxels, slices);
  same("active rays", host.activeRays, slices);
  same("active voxels", host.activeVoxels, slices);
  same("filled voxels", host.filledVoxels, slices);
  same("lengths", host.length, 1);
  same("in view", host.inView, 1);
}

void ExpectSamePlans(
  const Grid& grid, const Occupancy& occupancy, const RaySource& eye, const PlanSettings& settings)
{
  const std::vector<PlannedFrustum> host = PlanSweep(grid, occupancy, eye, settings);
  const std::vector<FrustumRays<SimulatedDevice>> device =
    PlanRays(SimulatedDevice::Shared(), grid, occupancy, eye, settings);
  ASSERT_EQ(host.size(), device.size());
  for (std::size_t index = 0; index < host.size(); ++index)
  {
    ExpectSameTables(host[index], device[index].Plan());
  }
}
}

// The processor fills tables row by row, and a device value by value.
TEST_P(PlanOf, IsTheSameOnADevice)
{
  for (const Readers readers : { Readers::RaysAndVoxels, Readers::Rays })
  {
    for (const bool skip : { true, false })
    {
      ExpectSamePlans(this->scene.grid,
        Occupancy(
          this->scene.grid, this->scene.extinction.data(), this->scene.importance.data(), skip),
        GetParam().eye, { GetParam().rayDensity, GetParam().placement, readers });
    }
  }
}

// A long box has rays far beside most slices, which their plan leaves out.
TEST(PlanOnADevice, IsTheSameForLongBoxes)
{
  for (const Int3& nodes : { Int3(150, 9, 7), Int3(6, 120, 11), Int3(8, 7, 140) })
  {
    const Boxes scene(nodes);
    for (const Viewing& viewing : viewings)
    {
      ExpectSamePlans(
        scene.grid, scene.MakeOccupancy(), viewing.eye, { viewing.rayDensity, viewing.placement });
    }
  }
}

TEST(PlanOnADevice, KnowsWhichRaysAreInView)
{
  const Boxes scene(planNodes);
  for (const bool parallel : { false, true })
  {
    Camera camera;
    camera.position = Vec3(70, -40, -60);
    camera.focalPoint = Vec3(12, 9, 20);
    camera.viewAngle = 9;
    camera.parallel = parallel;
    camera.parallelScale = 6;
    ExpectSamePlans(
      scene.grid, scene.MakeOccupancy(), SourceOfCamera(camera, scene.grid, true), { 1.2 });
  }
}

INSTANTIATE_TEST_SUITE_P(
  Eyes, PlanOf, ::testing::ValuesIn(viewings), ::testing::PrintToStringParamName());
