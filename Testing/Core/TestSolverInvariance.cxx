// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What must not change the result: skips, threads, units, place, orientation, unused weights.

#include "BoxScene.h"
#include "Outcome.h"
#include "Tolerance.h"

#include "backend/Backend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace limpid;

namespace
{
double LargestDifference(const std::vector<float>& a, const std::vector<float>& b, double scale = 1)
{
  EXPECT_EQ(a.size(), b.size());
  double largest = 0;
  for (std::size_t n = 0; n < a.size(); ++n)
  {
    largest = std::max(largest, std::abs(double(a[n]) * scale - double(b[n])));
  }
  return largest;
}

double RmsDifference(const std::vector<float>& a, const std::vector<float>& b, double scale = 1)
{
  double squares = 0;
  for (std::size_t n = 0; n < a.size(); ++n)
  {
    squares += std::pow(double(a[n]) * scale - double(b[n]), 2);
  }
  return std::sqrt(squares / double(a.size()));
}

/// The onion in a box with three different spacings.
BoxScene FlatOnion()
{
  BoxScene scene(Int3(31, 23, 12), Vec3(-1, -0.8, -0.6), Vec3(2.0 / 30, 1.6 / 22, 1.2 / 11));
  scene.FillOnion();
  return scene;
}

/// Returns a scene in another unit of length, at another place and rotated.
BoxScene Moved(const BoxScene& scene, double unit, const Mat3& rotation, const Vec3& shift)
{
  BoxScene moved = scene;
  const auto place = [&](const Vec3& x) { return rotation * x * unit + shift; };
  moved.grid.origin = place(scene.grid.origin);
  moved.grid.spacing = scene.grid.spacing * unit;
  moved.grid.direction = rotation * scene.grid.direction;
  moved.camera.position = place(scene.camera.position);
  moved.camera.focalPoint = place(scene.camera.focalPoint);
  moved.camera.viewUp = rotation * scene.camera.viewUp;
  moved.light.position = place(scene.light.position);
  moved.light.focalPoint = place(scene.light.focalPoint);
  for (float& value : moved.extinction)
  {
    value = static_cast<float>(value / unit);
  }
  return moved;
}

/// Compares a scene and the same scene moved.
void ExpectTheSameMoved(double unit, const Mat3& rotation, const Vec3& shift)
{
  const BoxScene scene = FlatOnion();

  const Outcome here = Optimize(scene);
  const Outcome there = Optimize(Moved(scene, unit, rotation, shift));

  // Lengths differ in their last digits (float extinction, double positions of a shifted box), and
  // the switch between 0 and majorant is sharp only within the regularisation.
  const double area = unit * unit;
  const std::string reason = "the same problem but for rounding";
  EXPECT_WITHIN(there.base.visibility, here.base.visibility * area,
    Relative(1e-5, here.base.visibility * area, reason));
  EXPECT_WITHIN(there.best.visibility, here.best.visibility * area,
    Relative(1e-4, here.best.visibility * area, reason));
  EXPECT_WITHIN(there.energy.Total(), here.energy.Total() * area,
    Relative(1e-4, here.energy.Total() * area, reason));
  EXPECT_WITHIN(RmsDifference(there.extinction, here.extinction, unit), 0,
    Relative(1e-4, here.majorant, reason));
  EXPECT_WITHIN(
    RmsDifference(there.transmittance, here.transmittance), 0, (Tolerance{ 1e-4, reason }));
}

/// Moves by `angle` about the axis.
Mat3 RotationAbout(Vec3 axis, double angle)
{
  axis = glm::normalize(axis);
  const double s = std::sin(angle);
  const double c = std::cos(angle);
  Mat3 rotation(0.0);
  for (int column = 0; column < 3; ++column)
  {
    Vec3 x(0.0);
    x[column] = 1;
    rotation[column] = c * x + s * glm::cross(axis, x) + (1 - c) * glm::dot(axis, x) * axis;
  }
  return rotation;
}
}

TEST(SolverInvariance, LeavesTheBaseExtinctionBitForBitWithoutWeights)
{
  BoxScene scene = BoxScene::Onion();
  scene.settings.weights.view = 0;
  scene.settings.weights.light = 0;

  for (const SolverKind kind : { SolverKind::Policy, SolverKind::Adam })
  {
    for (const Mode mode : { Mode::Joint, Mode::Separate })
    {
      scene.settings.solver = kind;
      scene.settings.mode = mode;
      const Outcome result = Optimize(scene);

      EXPECT_EQ(result.extinction, scene.extinction);
      if (mode == Mode::Separate)
      {
        EXPECT_EQ(result.lightExtinction, scene.extinction);
      }
      EXPECT_GT(result.base.visibility, 0);
      EXPECT_EQ(result.base.visibility, result.best.visibility);
    }
  }
}

TEST(SolverInvariance, LeavesTheBaseExtinctionBitForBitWithoutIterations)
{
  BoxScene scene = BoxScene::Onion();
  scene.settings.maximumIterations = 0;

  const Outcome result = Optimize(scene);

  EXPECT_EQ(result.extinction, scene.extinction);
}

TEST(SolverInvariance, SkipsOnlyWhatDoesNotMatter)
{
  for (const SolverKind kind : { SolverKind::Policy, SolverKind::Adam })
  {
    SCOPED_TRACE(kind == SolverKind::Adam ? "Adam" : "policy");
    BoxScene scene = BoxScene::Onion();
    scene.settings.solver = kind;
    scene.settings.iterationsPerLevel = { { 4, 4, 8 } };

    const Outcome skipping = Optimize(scene);
    scene.settings.skipUnneeded = false;
    const Outcome full = Optimize(scene);

    const std::string reason = "the same sums in another order";
    EXPECT_WITHIN(
      skipping.best.visibility, full.best.visibility, Relative(1e-5, full.best.visibility, reason));
    EXPECT_WITHIN(
      skipping.base.visibility, full.base.visibility, Relative(1e-6, full.base.visibility, reason));
    EXPECT_WITHIN(
      skipping.energy.Total(), full.energy.Total(), Relative(1e-5, full.energy.Total(), reason));
    EXPECT_WITHIN(LargestDifference(skipping.extinction, full.extinction), 0,
      Relative(1e-4, full.majorant, reason));
  }
}

TEST(SolverInvariance, KeepsUntouchedVoxelsBitForBit)
{
  // Important is only a small ball on the left: nothing can hide it on the right of the box, seen
  // and lit along z.
  BoxScene scene = BoxScene::Cube(25);
  scene.Fill([](const Vec3& x) { return 3 + std::sin(9 * x.x) * std::cos(7 * x.y + x.z); },
    [](const Vec3& x) { return glm::length(x - Vec3(-0.6, 0, 0)) < 0.25 ? 1 : 0; });
  scene.camera.parallel = true;
  scene.camera.position = Vec3(0, 0, -3);
  scene.light.type = LightType::Directional;
  scene.light.position = Vec3(0, 0, 3);

  const Outcome result = Optimize(scene);

  std::size_t changed = 0;
  scene.ForEachNode(
    [&](std::size_t node, int i, int j, int k)
    {
      const Vec3 x = scene.grid.PointToWorld(Vec3(i, j, k));
      changed += result.extinction[node] != scene.extinction[node] ? 1 : 0;
      if (std::hypot(x.x + 0.6, x.y) > 0.25 + 4 * scene.grid.spacing.x)
      {
        EXPECT_EQ(result.extinction[node], scene.extinction[node]) << i << ' ' << j << ' ' << k;
      }
    });
  EXPECT_GT(changed, 100u);
}

TEST(SolverInvariance, KeepsVoxelsOffTheLineOfSightOfABorderVoxelBitForBit)
{
  // One important voxel on a face along which rays graze.
  const Vec3 along(-0.425, 1.0, -0.162); // the line of sight, per slice across y [index]
  const Int3 important(0, 18, 0);
  BoxScene scene(Int3(24), Vec3(0), Vec3(2.64, 0.647, 2.631));
  scene.Fill(Everywhere(0.0118), Everywhere(0));
  scene.importance[std::size_t(important.x + 24 * (important.y + 24 * important.z))] = 1;
  scene.camera.parallel = true;
  scene.camera.focalPoint = scene.grid.Centre();
  scene.camera.position = scene.grid.Centre() - 40.0 * along * scene.grid.spacing;
  scene.settings.weights.light = 0;

  Solver solver = scene.MakeSolver();
  solver.Run();

  // The voxel is seen within one node; a node reads the rays about its neighbours, which are a node
  // apart.
  constexpr double reach = 3;
  scene.ForEachNode(
    [&](std::size_t node, int i, int j, int k)
    {
      const Vec3 line = Vec3(important) + along * double(j - important.y);
      if (std::abs(i - line.x) > reach || std::abs(k - line.z) > reach)
      {
        EXPECT_EQ(solver.Extinction()[node], scene.extinction[node]) << i << ' ' << j << ' ' << k;
      }
    });
}

TEST(SolverInvariance, NeverTouchesEmptyVoxels)
{
  const BoxScene scene = BoxScene::Onion();

  const Outcome result = Optimize(scene);

  scene.ForEachNode(
    [&](std::size_t node, int i, int j, int k)
    {
      if (scene.extinction[node] == 0 && scene.importance[node] == 0)
      {
        EXPECT_EQ(result.extinction[node], 0.0f) << i << ' ' << j << ' ' << k;
      }
    });
}

TEST(SolverInvariance, DoesNotDependOnTheNumberOfThreads)
{
  for (const SolverKind kind : { SolverKind::Policy, SolverKind::Adam })
  {
    for (const Mode mode : { Mode::Joint, Mode::Separate })
    {
      BoxScene scene = FlatOnion();
      scene.settings.solver = kind;
      scene.settings.mode = mode;
      scene.settings.iterationsPerLevel = { { 2, 2, 3 } };
      std::vector<Outcome> results;
      for (const int threads : { 1, 2, 3, 4 })
      {
        const ThreadLimit limit(threads);
        results.push_back(Optimize(scene));
      }
      for (const Outcome& result : results)
      {
        EXPECT_EQ(result.extinction, results[0].extinction);
        EXPECT_EQ(result.lightExtinction, results[0].lightExtinction);
        EXPECT_EQ(result.transmittance, results[0].transmittance);
        EXPECT_EQ(result.lightTransmittance, results[0].lightTransmittance);
        EXPECT_EQ(result.best.visibility, results[0].best.visibility);
        EXPECT_EQ(result.energy.Total(), results[0].energy.Total());
      }
    }
  }
}

TEST(SolverInvariance, RepeatsItselfBitForBit)
{
  const BoxScene scene = FlatOnion();

  const Outcome once = Optimize(scene);
  const Outcome again = Optimize(scene);

  EXPECT_EQ(once.extinction, again.extinction);
  EXPECT_EQ(once.energy.Total(), again.energy.Total());
}

TEST(SolverInvariance, GivesTheSameInSingleStepsAsInOneRun)
{
  const BoxScene scene = FlatOnion();
  Solver stepped = scene.MakeSolver();
  while (!stepped.Step(1))
  {
  }

  const Outcome run = Optimize(scene);

  EXPECT_EQ(stepped.Extinction(), run.extinction);
  EXPECT_EQ(stepped.BestEnergy().Total(), run.energy.Total());
}

TEST(SolverInvariance, CountsInMillimetresAsInMetres)
{
  ExpectTheSameMoved(1000, Mat3(1.0), Vec3(0));
}

TEST(SolverInvariance, CountsInTinyAndHugeUnits)
{
  ExpectTheSameMoved(1e-9, Mat3(1.0), Vec3(0));
  ExpectTheSameMoved(1e9, Mat3(1.0), Vec3(0));
}

TEST(SolverInvariance, DoesNotMindAMillionUnitsFromTheOrigin)
{
  ExpectTheSameMoved(1, Mat3(1.0), Vec3(1e6, -1e6, 1e6));
}

TEST(SolverInvariance, DoesNotMindADirectionMatrix)
{
  ExpectTheSameMoved(1, RotationAbout(Vec3(0, 0, 1), pi / 2), Vec3(0));
  ExpectTheSameMoved(2, RotationAbout(Vec3(1, 2, -1), 0.7), Vec3(3, 4, 5));
}

TEST(SolverInvariance, DoesNotMindALeftHandedDirectionMatrix)
{
  Mat3 mirror(1.0);
  mirror[2][2] = -1;
  ExpectTheSameMoved(1, mirror, Vec3(0));
}

TEST(SolverInvariance, SeesTheSameAlongAllThreeAxes)
{
  // Axes are exchanged, so that sweeps run along x, y and z.
  const BoxScene scene = BoxScene::Onion();
  const Outcome here = Optimize(scene);
  for (const int turn : { 1, 2 })
  {
    BoxScene turned = scene;
    const auto exchanged = [&](const Vec3& x)
    { return Vec3(x[(0 + turn) % 3], x[(1 + turn) % 3], x[(2 + turn) % 3]); };
    const int n = scene.grid.nodes.x;
    scene.ForEachNode(
      [&](std::size_t node, int i, int j, int k)
      {
        const int from[3] = { i, j, k };
        const std::size_t to = from[(0 + turn) % 3] +
          std::size_t(n) * (from[(1 + turn) % 3] + std::size_t(n) * from[(2 + turn) % 3]);
        turned.extinction[to] = scene.extinction[node];
        turned.importance[to] = scene.importance[node];
      });
    turned.camera.position = exchanged(scene.camera.position);
    turned.light.position = exchanged(scene.light.position);

    const Outcome there = Optimize(turned);

    const std::string reason = "the same sums in another order";
    EXPECT_WITHIN(
      there.base.visibility, here.base.visibility, Relative(1e-5, here.base.visibility, reason));
    EXPECT_WITHIN(
      there.best.visibility, here.best.visibility, Relative(1e-4, here.best.visibility, reason));
  }
}
