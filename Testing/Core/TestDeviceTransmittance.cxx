// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Volumes of transmittances as devices fill them, against those of the processor's own sweep, and
// against the march.

#include "Lamp.h"
#include "TestedDevice.h"
#include "Tolerance.h"

#include "energy/TransmittanceSweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
const Lamp lamps[] = {
  { "PointOutside", LightType::Point, { -1, 3, -0.7 }, 3 },
  { "PointAlongX", LightType::Point, { 2.5, 0.1, -0.2 }, 3 },
  { "PointNearASide", LightType::Point, { 0.2, 0.8, -0.1 }, 2 },
  { "PointInside", LightType::Point, { 0.13, -0.07, 0.21 }, 2 },
  { "PointOnANode", LightType::Point, { 0, 0, 0 }, 2 },
  { "PointFarAway", LightType::Point, { 3e5, 8e5, -2e5 }, 1 },
  { "DirectionalAlongX", LightType::Directional, { -2, 0, 0 }, 3 },
  { "DirectionalAlongY", LightType::Directional, { 0, 2, 0 }, 1 },
  { "DirectionalAlongZ", LightType::Directional, { 0, 0, 2 }, 3 },
  { "DirectionalOblique", LightType::Directional, { -1, 3, -0.7 }, 3 },
  { "DirectionalDiagonal", LightType::Directional, { 1, 1, 1 }, 1.5 },
};

BoxScene Scene(const Lamp& lamp)
{
  return BoxUnder(lamp, { 27, 31, 23 });
}

/// As a device fills it, with the plan for another extinction that is filled in the same places or
/// more.
std::vector<float> FillThere(
  const BoxScene& scene, double rayDensity, const std::vector<float>& planned)
{
  const auto device = MakeTestedDevice();
  const DeviceArray<TestedDevice, float> extinction(device, scene.extinction, "a test");
  DeviceArray<TestedDevice, float> transmittance(device, scene.extinction.size(), "a test");
  TransmittanceSweep<TestedDevice> volume(device, scene.grid,
    Occupancy(scene.grid, planned.data(), planned.data(), true),
    SourceOfLight(scene.light, scene.grid), rayDensity);
  volume.Fill(extinction.Data(), transmittance.Data());
  std::vector<float> values(scene.extinction.size());
  transmittance.Download(values.data());
  return values;
}

std::vector<float> FillHere(const BoxScene& scene, double rayDensity)
{
  std::vector<float> transmittance(scene.extinction.size());
  FillTransmittance(scene.grid, scene.extinction.data(), SourceOfLight(scene.light, scene.grid),
    rayDensity, transmittance.data());
  return transmittance;
}

double LargestDifference(const std::vector<float>& one, const std::vector<float>& other)
{
  double largest = 0;
  for (std::size_t node = 0; node < one.size(); ++node)
  {
    largest = std::max(largest, std::abs(double(one[node]) - double(other[node])));
  }
  return largest;
}

/// The tolerance for these operations in another order: roundings of optical depths up to the limit
/// between rays, over a layer each, and of the cubics.
Tolerance OtherOrder()
{
  return Tolerance{ 1e-5, "the same sums in another order, in single precision" };
}
}

class TransmittanceOfDevice : public ::testing::TestWithParam<Lamp>
{
};

TEST_P(TransmittanceOfDevice, IsThatOfTheProcessor)
{
  BoxScene scene = Scene(GetParam());
  scene.FillOnion();

  const std::vector<float> there = FillThere(scene, GetParam().rayDensity, scene.extinction);

  EXPECT_WITHIN(LargestDifference(there, FillHere(scene, GetParam().rayDensity)), 0, OtherOrder());
}

TEST_P(TransmittanceOfDevice, IsThatOfTheProcessorWhereEverythingIsFilled)
{
  BoxScene scene = Scene(GetParam());
  const double unit = 1 / scene.grid.Radius();
  scene.Fill([&](const Vec3& x)
    { return unit * (1.5 + std::sin(0.4 * x.x + 1) * std::cos(0.37 * x.y + 0.3 * x.z)); },
    Everywhere(0));

  const std::vector<float> there = FillThere(scene, GetParam().rayDensity, scene.extinction);

  EXPECT_WITHIN(LargestDifference(there, FillHere(scene, GetParam().rayDensity)), 0, OtherOrder());
}

TEST_P(TransmittanceOfDevice, NeedsNoPlanOfItsOwnForLessExtinction)
{
  BoxScene scene = Scene(GetParam());
  scene.FillOnion();
  const std::vector<float> planned = scene.extinction;
  for (std::size_t node = 0; node < planned.size(); ++node)
  {
    scene.extinction[node] *= node % 1000 < 300 ? 0.0f : 0.7f;
  }

  const std::vector<float> there = FillThere(scene, GetParam().rayDensity, planned);

  EXPECT_WITHIN(LargestDifference(there, FillHere(scene, GetParam().rayDensity)), 0, OtherOrder());
}

INSTANTIATE_TEST_SUITE_P(
  Lamps, TransmittanceOfDevice, ::testing::ValuesIn(lamps), ::testing::PrintToStringParamName());

TEST(TransmittanceOfDevice, FollowsTheMarch)
{
  BoxScene scene = Scene(lamps[0]);
  scene.Fill(
    [&](const Vec3& x)
    {
      const Vec3 index = scene.grid.PointToIndex(x);
      const double waves =
        std::sin(0.4 * index.x + 1) * std::sin(0.37 * index.y) * std::cos(0.43 * index.z - 0.2);
      return 3 / scene.grid.Radius() * std::max(0.0, 0.5 + 0.5 * waves);
    },
    Everywhere(0));
  const std::vector<float> there = FillThere(scene, transmittanceRayDensity, scene.extinction);
  std::mt19937 generator(7);
  std::uniform_int_distribution<std::size_t> any(0, there.size() - 1);

  double squares = 0;
  const int count = 300;
  for (int i = 0; i < count; ++i)
  {
    const std::size_t node = any(generator);
    const auto columns = std::size_t(scene.grid.nodes.x);
    const auto rows = std::size_t(scene.grid.nodes.y);
    const std::size_t row = node / columns;
    const std::size_t slice = row / rows;
    const Vec3 index(double(node % columns), double(row % rows), double(slice));
    const double expected = truth::Transmittance(
      scene.TruthWith(scene.extinction), scene.Lamp(), ToTruth(scene.grid.PointToWorld(index)));
    squares += std::pow(there[node] - expected, 2);
  }

  EXPECT_WITHIN(std::sqrt(squares / count), 0,
    (Tolerance{ 2e-3, "what the ray density of shadows is chosen for" }));
}
