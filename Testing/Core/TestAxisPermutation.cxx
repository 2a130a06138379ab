// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Other orders of the axes in memory: the same nodes, the same rays, the same results.

#include "BoxScene.h"

#include "backend/ComputeBackend.h"
#include "optimize/Permuted.h"
#include "optimize/Policy.h"
#include "optimize/PreparedScene.h"
#include "optimize/SolverBackend.h"
#include "scene/AxisPermutation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
class AxisOrders : public ::testing::TestWithParam<Int3>
{
};

struct View
{
  const char* name;
  std::function<void(BoxScene&)> change;
  Int3 axes; ///< the order to be expected
};

std::ostream& operator<<(std::ostream& stream, const View& view)
{
  return stream << view.name;
}
}

TEST_P(AxisOrders, LeaveNodesWhereTheyAre)
{
  // More than a tile along each axis, and no multiple of one.
  BoxScene scene({ 37, 18, 41 }, { 3, -2, 5 }, { 1.0, 1.3, 0.8 });
  const Grid& grid = scene.grid;
  const AxisPermutation order{ GetParam() };
  const Grid ordered = order.Of(grid);
  std::vector<float> field(std::size_t(grid.NodeCount()));
  for (std::size_t node = 0; node < field.size(); ++node)
  {
    field[node] = static_cast<float>(node);
  }
  std::vector<float> reordered(field.size(), -1.0f);
  Permute(grid, order, field.data(), reordered.data());
  for (int z = 0; z < ordered.nodes.z; ++z)
  {
    for (int y = 0; y < ordered.nodes.y; ++y)
    {
      for (int x = 0; x < ordered.nodes.x; ++x)
      {
        const Index there = (Index(z) * ordered.nodes.y + y) * ordered.nodes.x + x;
        const auto node = static_cast<Index>(reordered[std::size_t(there)]);
        const Index row = node / grid.nodes.x;
        const Index slice = row / grid.nodes.y;
        const Vec3 index(double(node % grid.nodes.x), double(row % grid.nodes.y), double(slice));
        const Vec3 distance = ordered.PointToWorld({ x, y, z }) - grid.PointToWorld(index);
        ASSERT_LE(glm::length(distance), 1e-12 * grid.Radius());
      }
    }
  }
  std::vector<float> restored(field.size(), -1.0f);
  PermuteBack(grid, order, reordered.data(), restored.data());
  EXPECT_EQ(restored, field);
}

TEST_P(AxisOrders, LeaveRaysWhereTheyAre)
{
  BoxScene scene({ 12, 9, 14 }, { 3, -2, 5 }, { 1.0, 1.3, 0.8 });
  const AxisPermutation order{ GetParam() };
  const Grid ordered = order.Of(scene.grid);
  for (const bool parallel : { false, true })
  {
    scene.camera.parallel = parallel;
    const RaySource found = order.Of(SourceOfCamera(scene.camera, scene.grid, true));
    const RaySource expected = SourceOfCamera(scene.camera, ordered, true);
    const double exact = 1e-12 * glm::length(Vec3(ordered.nodes));
    EXPECT_LE(glm::length(found.origin - expected.origin), exact);
    EXPECT_LE(glm::length(found.direction - expected.direction), exact);
    ASSERT_EQ(found.viewPlanes.size(), expected.viewPlanes.size());
    for (std::size_t plane = 0; plane < found.viewPlanes.size(); ++plane)
    {
      const RaySource::Plane& one = found.viewPlanes[plane];
      const RaySource::Plane& other = expected.viewPlanes[plane];
      const double size = glm::length(other.normal);
      EXPECT_LE(glm::length(one.normal - other.normal), 1e-9 * size);
      EXPECT_NEAR(one.offset, other.offset, 1e-9 * (size + std::abs(other.offset)));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, AxisOrders,
  ::testing::Values(
    Int3(0, 1, 2), Int3(0, 2, 1), Int3(1, 0, 2), Int3(1, 2, 0), Int3(2, 0, 1), Int3(2, 1, 0)),
  [](const ::testing::TestParamInfo<Int3>& test)
  {
    return std::to_string(test.param.x) + std::to_string(test.param.y) +
      std::to_string(test.param.z);
  });

class ReorderedProblem : public ::testing::TestWithParam<View>
{
};

TEST_P(ReorderedProblem, HasTheResultsOfTheProblem)
{
  BoxScene scene({ 37, 30, 41 }, { 3, -2, 5 }, { 1.0, 1.3, 0.8 });
  scene.FillOnion();
  GetParam().change(scene);
  PreparedScene prepared(scene.Fields());
  const Problem problem = prepared.ProblemFor(scene.camera, scene.light, scene.settings);
  EXPECT_EQ(OrderFor(problem).axes, GetParam().axes);
  const std::unique_ptr<Minimizer> direct = MakePolicy(HostDevice::Shared(), problem, {}, false);
  const std::unique_ptr<Minimizer> reordered =
    ProcessorBackend().MakeSolverBackend()->MakeMinimizer(problem, {}, false);

  IterationRecord expected = direct->Start();
  IterationRecord found = reordered->Start();
  for (int iteration = 0; iteration < 4; ++iteration)
  {
    // Sums are in another order, and for voxels that two frusta share, the other one may decide.
    const double scale = std::abs(expected.energy.view) + std::abs(expected.energy.light);
    EXPECT_NEAR(found.energy.Total(), expected.energy.Total(), 1e-4 * scale) << iteration;
    EXPECT_NEAR(found.meanChange, expected.meanChange, 1e-4) << iteration;
    expected = direct->Iterate();
    found = reordered->Iterate();
  }
  const std::vector<float> best = direct->TakeBest();
  const std::vector<float> shown = reordered->Best();
  ASSERT_EQ(shown.size(), best.size());
  double sum = 0;
  for (std::size_t voxel = 0; voxel < best.size(); ++voxel)
  {
    sum += std::abs(double(best[voxel]) - double(shown[voxel]));
  }
  EXPECT_LE(sum / double(best.size()), 1e-3 * prepared.Majorant());
  EXPECT_EQ(reordered->TakeBest(), shown);
}

TEST_P(ReorderedProblem, GoesOnFromAnIterateInTheOrderOfTheProblem)
{
  BoxScene scene({ 37, 30, 41 }, { 3, -2, 5 }, { 1.0, 1.3, 0.8 });
  scene.FillOnion();
  GetParam().change(scene);
  PreparedScene prepared(scene.Fields());
  const Problem problem = prepared.ProblemFor(scene.camera, scene.light, scene.settings);
  std::vector<float> start = scene.extinction;
  for (std::size_t voxel = 0; voxel < start.size(); ++voxel)
  {
    start[voxel] *= voxel % 3 == 0 ? 0.5f : 1.0f;
  }
  const std::unique_ptr<Minimizer> minimizer =
    ProcessorBackend().MakeSolverBackend()->MakeMinimizer(problem, std::vector<float>(start), true);
  minimizer->Start();
  EXPECT_EQ(minimizer->Best(), start) << "the best before the first iteration";
}

INSTANTIATE_TEST_SUITE_P(Views, ReorderedProblem,
  ::testing::Values(View{ "AlongX",
                      [](BoxScene& scene)
                      {
                        const Vec3 centre = scene.grid.Centre();
                        scene.camera.position = centre + scene.grid.Radius() * Vec3(-3, 0.2, 0.1);
                        scene.light.position = centre + scene.grid.Radius() * Vec3(0.1, 3, 0.2);
                      },
                      { 2, 1, 0 } },
    View{ "AlongXWithTheLight",
      [](BoxScene& scene)
      {
        const Vec3 centre = scene.grid.Centre();
        scene.camera.position = centre + scene.grid.Radius() * Vec3(-3, 0.2, 0.1);
        scene.light.position = centre + scene.grid.Radius() * Vec3(3, 0.1, 0.2);
      },
      { 1, 2, 0 } },
    View{ "AlongY",
      [](BoxScene& scene)
      {
        const Vec3 centre = scene.grid.Centre();
        scene.camera.position = centre + scene.grid.Radius() * Vec3(0.3, 3, -0.1);
        scene.light.position = centre + scene.grid.Radius() * Vec3(0.1, 0.3, 3);
      },
      { 0, 2, 1 } },
    View{ "AlongYWithoutSkips",
      [](BoxScene& scene)
      {
        const Vec3 centre = scene.grid.Centre();
        scene.camera.position = centre + scene.grid.Radius() * Vec3(0.3, 3, -0.1);
        scene.light.position = centre + scene.grid.Radius() * Vec3(0.1, 0.3, 3);
        scene.settings.skipUnneeded = false;
      },
      { 0, 2, 1 } },
    View{ "LightAloneAlongX",
      [](BoxScene& scene)
      {
        const Vec3 centre = scene.grid.Centre();
        scene.light.position = centre + scene.grid.Radius() * Vec3(3, 0.1, 0.2);
        scene.settings.weights.view = 0;
      },
      { 1, 2, 0 } }),
  [](const ::testing::TestParamInfo<View>& test) { return test.param.name; });
