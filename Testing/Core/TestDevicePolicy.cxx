// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What is written for devices against the processor's own sweeps. Here it runs on the processor,
// launch by launch; Testing/Gpu runs the same on a GPU.

#include "BoxScene.h"
#include "TestedDevice.h"
#include "Tolerance.h"

#include "optimize/Policy.h"
#include "optimize/PreparedScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
struct View
{
  const char* name;
  std::function<void(BoxScene&)> change;
};

std::ostream& operator<<(std::ostream& stream, const View& view)
{
  return stream << view.name;
}
}

class PolicyOfDevice : public ::testing::TestWithParam<View>
{
};

TEST_P(PolicyOfDevice, IsThatOfTheProcessor)
{
  BoxScene scene({ 45, 42, 47 }, { 3, -2, 5 }, { 1.0, 1.3, 0.8 });
  scene.FillOnion();
  GetParam().change(scene);
  PreparedScene prepared(scene.Fields());
  const Problem problem = prepared.ProblemFor(scene.camera, scene.light, scene.settings);
  const auto device = MakeTestedDevice();
  const std::unique_ptr<Minimizer> there = MakePolicy(device, problem, scene.extinction, false);
  const std::unique_ptr<Minimizer> here =
    MakePolicy(HostDevice::Shared(), problem, scene.extinction, false);

  IterationRecord expected = here->Start();
  IterationRecord found = there->Start();
  for (int iteration = 0; iteration < 4; ++iteration)
  {
    const double scale = std::abs(expected.energy.view) + std::abs(expected.energy.light);
    // Both do these operations in single precision, in different orders.
    const double tolerance = 1e-5;
    EXPECT_NEAR(found.energy.view, expected.energy.view, tolerance * scale) << iteration;
    EXPECT_NEAR(found.energy.light, expected.energy.light, tolerance * scale) << iteration;
    EXPECT_NEAR(found.energy.regularization, expected.energy.regularization, tolerance * scale);
    EXPECT_NEAR(found.score.fraction, expected.score.fraction, tolerance);
    EXPECT_NEAR(found.meanChange, expected.meanChange, tolerance);
    if (iteration < 3)
    {
      expected = here->Iterate();
      found = there->Iterate();
    }
  }
  const std::vector<float> best = here->TakeBest();
  const std::vector<float> bestThere = there->TakeBest();
  ASSERT_EQ(best.size(), bestThere.size());
  double largest = 0;
  for (std::size_t voxel = 0; voxel < best.size(); ++voxel)
  {
    largest = std::max(largest, std::abs(double(best[voxel]) - double(bestThere[voxel])));
  }
  // A voxel that is neither cleared nor filled multiplies the rounding of the derivative, T (V - g)
  // of both terms, by their gains.
  const Weights& weights = scene.settings.weights;
  const double gain = (weights.view + weights.light) / problem.RegularizationWeight();
  EXPECT_WITHIN(largest, 0, Roundoff<float>(8, gain));
}

INSTANTIATE_TEST_SUITE_P(Views, PolicyOfDevice,
  ::testing::Values(View{ "Outside", [](BoxScene&) {} },
    View{ "Inside",
      [](BoxScene& scene) { scene.camera.position = scene.grid.Centre() + Vec3(2, 1, -3); } },
    View{ "AlongX",
      [](BoxScene& scene)
      { scene.camera.position = scene.grid.Centre() + scene.grid.Radius() * Vec3(-3, 0.2, 0.1); } },
    View{ "Parallel", [](BoxScene& scene) { scene.camera.parallel = true; } },
    View{ "DirectionalLight", [](BoxScene& scene) { scene.light.type = LightType::Directional; } },
    View{ "WithoutLight", [](BoxScene& scene) { scene.settings.weights.light = 0; } },
    View{ "WithoutCamera", [](BoxScene& scene) { scene.settings.weights.view = 0; } },
    View{ "SmallWeights",
      [](BoxScene& scene) {
        scene.settings.weights = { 1e-3, 0.1, 0.03 };
      } },
    View{ "SmallWeightOfTheLight", [](BoxScene& scene) { scene.settings.weights.light = 0.1; } },
    View{ "SmallWeightOfRays",
      [](BoxScene& scene)
      {
        scene.settings.weights = { 1e-3, 0.2, 0 };
        scene.settings.derivative = Derivative::Ray;
      } },
    View{ "InView",
      [](BoxScene& scene)
      {
        scene.settings.restrictToView = true;
        scene.camera.viewAngle = 12;
      } },
    View{
      "DerivativeOfRays", [](BoxScene& scene) { scene.settings.derivative = Derivative::Ray; } },
    View{ "WithoutSkips", [](BoxScene& scene) { scene.settings.skipUnneeded = false; } },
    View{ "DenseRays", [](BoxScene& scene) { scene.settings.rayDensity = 2.5; } },
    View{ "Rotated",
      [](BoxScene& scene)
      {
        const double c = std::cos(0.3);
        const double s = std::sin(0.3);
        scene.grid.direction = Mat3(c, s, 0, -s, c, 0, 0, 0, 1);
      } }),
  ::testing::PrintToStringParamName());
