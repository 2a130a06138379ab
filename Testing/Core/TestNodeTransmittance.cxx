// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The transmittance that a solver gives at the nodes of opaque matter, against the march.

#include "BoxScene.h"
#include "Tolerance.h"

#include "backend/HostDevice.h"
#include "energy/NodeTransmittance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
constexpr int nodes = 25;
constexpr double middle = 12;

/// Extinction of 0 ... 1 [1/length] at a place in index space.
struct Shape
{
  const char* name;
  double (*at)(const Vec3& x);
};

std::ostream& operator<<(std::ostream& stream, const Shape& shape)
{
  return stream << shape.name;
}

const Shape shapes[] = {
  { "Block", [](const Vec3& x) { return x.x > 9 && x.y > 9 && x.z > 9 ? 1.0 : 0.0; } },
  { "Shell",
    [](const Vec3& x)
    { return std::exp(-std::pow((glm::length(x - Vec3(middle)) - 7.5) / 1.2, 2)); } },
  { "Sheet",
    [](const Vec3& x)
    {
      const double beside = glm::dot(x - Vec3(middle), glm::normalize(Vec3(0.2, 0.5, 1)));
      return std::max(0.0, 1 - std::abs(beside) / 1.5);
    } },
  { "Waves",
    [](const Vec3& x)
    {
      return std::max(
        0.0, std::sin(0.5 * x.x) * std::sin(0.45 * x.y + 1) * std::sin(0.4 * x.z + 0.5));
    } },
};

/// A shape whose extinction is `most` where it is densest, one unit of length between nodes.
BoxScene SceneOf(const Shape& shape, double most)
{
  BoxScene scene(Int3(nodes), Vec3(0.0), Vec3(1.0));
  scene.Fill([&](const Vec3& x) { return most * shape.at(x); }, Everywhere(0.5));
  scene.settings.maximumIterations = 0;
  return scene;
}

Solver Solved(const BoxScene& scene)
{
  Solver solver = scene.MakeSolver();
  solver.Run();
  return solver;
}

/// The root mean square of how far the transmittance is off a march, at every third node.
template <class Eye>
double RmsError(const BoxScene& scene, const std::vector<float>& transmittance, const Eye& eye)
{
  double squares = 0;
  scene.ForEachNode(
    [&](std::size_t node, int i, int j, int k)
    {
      if (node % 3 != 0)
      {
        return;
      }
      const double exact = truth::Transmittance(
        scene.TruthWith(scene.extinction), eye, ToTruth(scene.grid.PointToWorld(Vec3(i, j, k))));
      squares += std::pow(transmittance[node] - exact, 2);
    });
  return std::sqrt(3 * squares / double(transmittance.size()));
}

/// What rays of a sweep leave where it is not steep.
Tolerance BetweenRays()
{
  return { 1e-3, "interpolated between rays a third of a voxel apart" };
}
}

class TransmittanceAtNodes : public ::testing::TestWithParam<Shape>
{
};

TEST_P(TransmittanceAtNodes, IsThatOfAMarchFromAnyCamera)
{
  for (const double most : { 1.0, 10.0, 100.0 })
  {
    for (const Vec3& towards : { Vec3(0, 0, 1), Vec3(0.3, 0.2, 1), Vec3(-1, -1, 1) })
    {
      for (const bool parallel : { false, true })
      {
        BoxScene scene = SceneOf(GetParam(), most);
        scene.camera.parallel = parallel;
        scene.camera.focalPoint = scene.grid.Centre();
        scene.camera.position = scene.grid.Centre() - 40.0 * glm::normalize(towards);
        scene.camera.viewUp = Vec3(0.1, 1, 0.1);
        std::vector<float> transmittance(scene.extinction.size());

        Solved(scene).Transmittance(transmittance.data());

        EXPECT_WITHIN(RmsError(scene, transmittance, scene.Eye()), 0, BetweenRays())
          << most << ' ' << towards.x << ' ' << parallel;
      }
    }
  }
}

TEST_P(TransmittanceAtNodes, IsThatOfAMarchFromLightsInsideAndOutside)
{
  for (const Vec3& position :
    { Vec3(middle), Vec3(3.2, 13.1, 7.4), Vec3(-9, 40, 5), Vec3(24, 12, 12) })
  {
    for (const LightType type : { LightType::Point, LightType::Directional })
    {
      BoxScene scene = SceneOf(GetParam(), 30);
      scene.light.type = type;
      scene.light.position = position;
      scene.light.focalPoint = Vec3(11, 11.5, 9);
      std::vector<float> transmittance(scene.extinction.size());

      Solved(scene).LightTransmittance(transmittance.data());

      EXPECT_WITHIN(RmsError(scene, transmittance, scene.Lamp()), 0, BetweenRays())
        << position.x << ' ' << int(type);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
  Shapes, TransmittanceAtNodes, ::testing::ValuesIn(shapes), ::testing::PrintToStringParamName());

// Ranks add up what each has of a ray's way in whatever order and number of parts.
TEST(NodeRays, FindInPartsWhatTheyFindInOne)
{
  const BoxScene scene = SceneOf(shapes[3], 0.3);
  const FieldWithin extinction{ scene.extinction.data(), NodesWithin::Whole(scene.grid) };
  const auto all = [](const Int3&) { return true; };
  for (const Vec3& from : { Vec3(-9, 30, 5), Vec3(3.2, 9.1, 4.4), Vec3(8.0), Vec3(8, 8, -40) })
  {
    RaySource source;
    source.origin = from;
    const NodeRays rays(scene.grid, source);
    scene.ForEachNode(
      [&](std::size_t, int i, int j, int k)
      {
        const Int3 node(i, j, k);
        const WholeDepth whole =
          rays.DepthTo(node, extinction, NodesWithin::CellsOf(scene.grid), all);
        WholeDepth sum = 0;
        for (int part = 0; part < 8; ++part)
        {
          const Int3 upper(part & 1, part >> 1 & 1, part >> 2);
          const Int3 cut(5, 9, 8);
          sum += rays.DepthTo(
            node, extinction, { upper * cut, cut + upper * (scene.grid.nodes - 1 - cut) }, all);
        }
        ASSERT_EQ(sum, whole) << i << ' ' << j << ' ' << k;
      });
  }
}

// On the processor sixteen nodes of a row are refined side by side; ranks refine one at a time.
TEST(NodeRays, FindSideBySideWhatTheyFindAlone)
{
  for (const int shape : { 0, 3 })
  {
    const BoxScene scene = SceneOf(shapes[shape], 3);
    const FieldWithin extinction{ scene.extinction.data(), NodesWithin::Whole(scene.grid) };
    const auto all = [](const Int3&) { return true; };
    std::vector<float> steep(scene.extinction.size());
    scene.ForEachNode(
      [&](std::size_t node, int i, int, int) { steep[node] = i % 2 == 0 ? 1.0f : 0.0f; });
    for (const Vec3& from :
      { Vec3(-9, 30, 5), Vec3(-9, 30, 24), Vec3(3.2, 9.1, 4.4), Vec3(8.0), Vec3(1e6, 2e5, -3e5) })
    {
      RaySource source;
      source.origin = from;
      std::vector<float> refined(steep.size());

      RefineTransmittance(*HostDevice::Shared(), scene.grid, source, scene.extinction.data(),
        steep.data(), refined.data());

      const NodeRays rays(scene.grid, source);
      scene.ForEachNode(
        [&](std::size_t node, int i, int j, int k)
        {
          const WholeDepth depth =
            rays.DepthTo({ i, j, k }, extinction, NodesWithin::CellsOf(scene.grid), all);
          ASSERT_EQ(refined[node], TransmittanceOf(depth)) << i << ' ' << j << ' ' << k;
        });
    }
  }
}

TEST(NodeRays, AreExactInLongImagesAndFromFarAway)
{
  BoxScene scene(Int3(2000, 3, 4), Vec3(0.0), Vec3(1.0));
  scene.Fill(Everywhere(0.002), Everywhere(0.5));
  const FieldWithin extinction{ scene.extinction.data(), NodesWithin::Whole(scene.grid) };
  for (const double distance : { 3e3, 1e6, 1e9, 1e45 })
  {
    RaySource source;
    source.origin = distance * Vec3(1, 0.0004, 0.0003);
    const NodeRays rays(scene.grid, source);
    scene.ForEachNode(
      [&](std::size_t, int i, int j, int k)
      {
        const Vec3 node(i, j, k);
        const Vec3 way = source.origin - node;
        double leaves = 1;
        for (int axis = 0; axis < 3; ++axis)
        {
          const double last = way[axis] > 0 ? scene.grid.nodes[axis] - 1 : 0;
          leaves = std::min(leaves, (last - node[axis]) / way[axis]);
        }
        const WholeDepth depth = rays.DepthTo({ i, j, k }, extinction,
          NodesWithin::CellsOf(scene.grid), [](const Int3&) { return true; });
        // Half a unit in each of 2000 cells is 3e-5 in the worst case, where T is 0.02.
        ASSERT_NEAR(TransmittanceOf(depth), std::exp(-0.002 * leaves * glm::length(way)), 1e-5)
          << distance << ' ' << i << ' ' << j << ' ' << k;
      });
  }
}

TEST(NodeRays, SeeWhatIsInView)
{
  BoxScene scene = SceneOf(shapes[0], 1);
  scene.camera.position = Vec3(middle, middle, -20);
  scene.camera.focalPoint = Vec3(middle);
  scene.camera.viewAngle = 30;

  const NodeRays rays(scene.grid, SourceOfCamera(scene.camera, scene.grid, true));

  // Half the picture is 20 tan 15 degrees = 5.36 high at the first nodes, 11.8 at the last ones.
  EXPECT_TRUE(rays.See({ 12, 12, 0 }));
  EXPECT_TRUE(rays.See({ 17, 12, 0 }));
  EXPECT_FALSE(rays.See({ 18, 12, 0 }));
  EXPECT_TRUE(rays.See({ 23, 12, 24 }));
  EXPECT_FALSE(rays.See({ 24, 12, 24 }));
}
