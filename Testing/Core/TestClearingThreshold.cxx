// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The clearing threshold: what must be at stake, whatever the density and the size of the data.

#include "BoxScene.h"

#include "math/Require.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace limpid;

namespace
{
/// A thin important slab, and a wall of the densest matter in front of it, both as wide as the box,
/// seen along parallel rays.
BoxScene Wall(double density, double size)
{
  BoxScene scene({ 9, 9, 33 }, Vec3(-size), Vec3(size / 4, size / 4, size / 16));
  scene.Fill(
    [=](const Vec3& x)
    {
      const double z = x.z / size;
      return std::abs(z - 0.5) < 0.1 ? density / size
        : std::abs(z + 0.5) < 0.1    ? density / size
                                     : 0;
    },
    [=](const Vec3& x) { return std::abs(x.z / size - 0.5) < 0.1 ? 1.0 : 0.0; });
  scene.camera.parallel = true;
  scene.camera.position = scene.grid.Centre() - Vec3(0, 0, 10 * size);
  scene.camera.focalPoint = scene.grid.Centre();
  scene.settings.weights.light = 0;
  scene.settings.emphasis = 0;
  scene.settings.protectImportance = 1;
  return scene;
}

/// Share of the wall's middle that is left.
double LeftOfWall(const BoxScene& scene)
{
  Solver solver = scene.MakeSolver();
  solver.Run();
  double left = 0;
  double all = 0;
  scene.ForEachNode(
    [&](std::size_t node, int i, int j, int k)
    {
      if (k < 16 && i > 1 && i < 7 && j > 1 && j < 7)
      {
        left += solver.Extinction()[node];
        all += scene.extinction[node];
      }
    });
  return left / all;
}
}

// The wall can win V, what the slab shows of itself, 1 - exp(-optical depth): it goes where the
// threshold is well below that, and stays where it is well above.
TEST(ClearingThreshold, IsTheShareThatMustBeAtStakeAtAnyDensityAndSize)
{
  for (const double size : { 1e-3, 1.0, 1e3 })
  {
    for (const double density : { 1.0, 10.0 })
    {
      BoxScene scene = Wall(density, size);
      const double atStake = 1 - std::exp(-0.2 * density);
      scene.settings.clearingThreshold = 0.2 * atStake;
      EXPECT_LT(LeftOfWall(scene), 0.05) << density << ", " << size;
      scene.settings.clearingThreshold = 5 * atStake;
      EXPECT_GT(LeftOfWall(scene), 0.7) << density << ", " << size;
    }
  }
}

TEST(ClearingThreshold, OfZeroLeavesTheRegularizationWeight)
{
  BoxScene scene = BoxScene::Onion(17);
  scene.settings.weights.regularization = 0.01;
  Solver weighted = scene.MakeSolver();
  weighted.Run();

  // p = delta q / (R majorant)
  scene.settings.clearingThreshold =
    0.01 * scene.grid.Radius() * weighted.Majorant() / scene.settings.weights.view;
  scene.settings.weights.regularization = 123;
  Solver threshold = scene.MakeSolver();
  threshold.Run();

  // p is rounded on its way, and what it decides between is nearly as good.
  EXPECT_NEAR(threshold.BestEnergy().Total() / weighted.BestEnergy().Total(), 1, 1e-5);
}

TEST(ClearingThreshold, IsOfTheLightWithoutAViewTerm)
{
  BoxScene scene = BoxScene::Onion(17);
  scene.settings.weights.view = 0;
  scene.settings.weights.light = 10;
  double visible = std::numeric_limits<double>::infinity();
  for (const double share : { 1e-3, 0.1, 1.0 })
  {
    scene.settings.clearingThreshold = share;
    Solver solver = scene.MakeSolver();
    solver.Run();
    EXPECT_LT(-solver.BestEnergy().light, visible) << share;
    visible = -solver.BestEnergy().light;
  }
}

TEST(ClearingThreshold, BelowZeroIsRefused)
{
  for (const double share :
    { -0.1, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    BoxScene scene = BoxScene::Onion(9);
    scene.settings.clearingThreshold = share;
    EXPECT_THROW(scene.MakeSolver(), Error) << share;
  }
}
