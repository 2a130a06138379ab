// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Transmittance at the nodes against closed forms and the march, for lights; cameras are no others.

#include "Lamp.h"
#include "Tolerance.h"

#include "backend/Backend.h"
#include "energy/TransmittanceSweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
const Lamp lamps[] = {
  { "PointOutside", LightType::Point, { -1, 3, -0.7 } },
  { "PointNearASide", LightType::Point, { 0.2, 0.8, -0.1 } },
  { "PointInside", LightType::Point, { 0.13, -0.07, 0.21 } },
  { "PointOnANode", LightType::Point, { 0, 0, 0 } },
  { "PointFarAway", LightType::Point, { 3e5, 8e5, -2e5 } },
  { "DirectionalAlongAnAxis", LightType::Directional, { 0, 0, 2 } },
  { "DirectionalOblique", LightType::Directional, { -1, 3, -0.7 } },
  { "DirectionalDiagonal", LightType::Directional, { 1, 1, 1 } },
};

BoxScene Scene(const Lamp& lamp)
{
  return BoxUnder(lamp, { 17, 21, 13 });
}

/// Clouds as wide as eight nodes, thick in the middle; `depth`: of the thickest over the half
/// diagonal.
void FillClouds(BoxScene& scene, double depth)
{
  const double thickest = depth / scene.grid.Radius();
  scene.Fill(
    [&](const Vec3& x)
    {
      const Vec3 index = scene.grid.PointToIndex(x);
      const double waves =
        std::sin(0.4 * index.x + 1) * std::sin(0.37 * index.y) * std::cos(0.43 * index.z - 0.2);
      return thickest * std::max(0.0, 0.5 + 0.5 * waves);
    },
    Everywhere(0));
}

std::vector<float> Fill(const BoxScene& scene, double rayDensity)
{
  std::vector<float> transmittance(scene.extinction.size());
  FillTransmittance(scene.grid, scene.extinction.data(), SourceOfLight(scene.light, scene.grid),
    rayDensity, transmittance.data());
  return transmittance;
}

double March(const BoxScene& scene, int i, int j, int k)
{
  return truth::Transmittance(scene.TruthWith(scene.extinction), scene.Lamp(),
    ToTruth(scene.grid.PointToWorld(Vec3(i, j, k))));
}

double RmsError(const BoxScene& scene, double rayDensity)
{
  const std::vector<float> transmittance = Fill(scene, rayDensity);
  double squares = 0;
  scene.ForEachNode([&](std::size_t node, int i, int j, int k)
    { squares += std::pow(transmittance[node] - March(scene, i, j, k), 2); });
  return std::sqrt(squares / double(transmittance.size()));
}
}

class TransmittanceOfNodes : public ::testing::TestWithParam<Lamp>
{
};

TEST_P(TransmittanceOfNodes, IsOneWhereNothingAbsorbs)
{
  const BoxScene scene = Scene(GetParam());

  for (const float value : Fill(scene, 2))
  {
    ASSERT_EQ(value, 1);
  }
}

TEST_P(TransmittanceOfNodes, FollowsBeersLawInAHomogeneousBox)
{
  BoxScene scene = Scene(GetParam());
  const double depth = 4; // over the half diagonal
  scene.Fill(Everywhere(depth / scene.grid.Radius()), Everywhere(0));

  const std::vector<float> transmittance = Fill(scene, 2);

  // What is interpolated between rays is the optical depth per depth since the entry: of second
  // order in the distance of the rays, 1/2 node, over the distance to the light, a node or more.
  const Tolerance tolerance = Roundoff<float>(200, 1) +
    Tolerance{ depth * std::pow(0.5 / 14, 2), "linear between rays half a node apart" };
  double worst = 0;
  scene.ForEachNode([&](std::size_t node, int i, int j, int k)
    { worst = std::max(worst, std::abs(transmittance[node] - March(scene, i, j, k))); });
  EXPECT_WITHIN(worst, 0, tolerance);
}

TEST_P(TransmittanceOfNodes, FollowsTheMarchToSecondOrder)
{
  BoxScene scene = Scene(GetParam());
  FillClouds(scene, 3);

  const double coarse = RmsError(scene, 1);
  const double usual = RmsError(scene, 2);
  const double fine = RmsError(scene, 4);

  // A quarter and a sixteenth in the limit, a half and a quarter for a rule of first order; along
  // the rays there are two Gauss points per layer of 0.23 in optical depth whatever their density.
  EXPECT_LE(usual, coarse / 2.5 + 1e-4) << coarse << " " << usual << " " << fine;
  EXPECT_LE(fine, coarse / 8 + 1e-4) << coarse << " " << usual << " " << fine;
}

TEST_P(TransmittanceOfNodes, StaysBetweenZeroAndOneAndDoesNotDependOnThreads)
{
  BoxScene scene = Scene(GetParam());
  scene.FillOnion(1000);
  std::vector<float> one;
  {
    const ThreadLimit limit(1);
    one = Fill(scene, 2);
  }
  const ThreadLimit limit(3);

  EXPECT_EQ(one, Fill(scene, 2));
  for (const float value : one)
  {
    ASSERT_TRUE(value >= 0 && value <= 1) << value;
  }
}

INSTANTIATE_TEST_SUITE_P(
  Lamps, TransmittanceOfNodes, ::testing::ValuesIn(lamps), ::testing::PrintToStringParamName());
