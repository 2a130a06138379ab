// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Volumes of transmittances as devices fill them, against those of the processor's own sweep, and
// against the march.

#include "Lamp.h"
#include "TestedDevice.h"
#include "Tolerance.h"

#include "energy/TransmittanceKernel.h"
#include "energy/TransmittanceSweep.h"
#include "sweep/SweepLaunches.h"

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

/// Replaces the extinction by some small boxes at random. `most`: optical depth of a voxel.
void FillBoxes(BoxScene& scene, double most, std::mt19937& generator)
{
  const Int3 nodes = scene.grid.nodes;
  scene.extinction.assign(scene.extinction.size(), 0.0f);
  const auto any = [&generator](int begin, int end)
  { return std::uniform_int_distribution<int>(begin, end - 1)(generator); };
  for (int box = 0; box < 4; ++box)
  {
    const Int3 first(any(0, nodes.x), any(0, nodes.y), any(0, nodes.z));
    const Int3 end = glm::min(first + Int3(any(1, 8), any(1, 8), any(1, 8)), nodes);
    const auto value = static_cast<float>(most * any(1, 11) / 10);
    for (int k = first.z; k < end.z; ++k)
    {
      for (int j = first.y; j < end.y; ++j)
      {
        for (int i = first.x; i < end.x; ++i)
        {
          scene.extinction[std::size_t(i + nodes.x * (j + Index(nodes.y) * k))] = value;
        }
      }
    }
  }
}

/// The plan of a filled box, swept with the tiles that an extinction dims and with all tiles.
class SweptTwice
{
public:
  SweptTwice(const BoxScene& scene, double rayDensity)
    : Nodes(scene.grid.nodes)
    , Everywhere(Device, std::vector<float>(scene.extinction.size(), 1.0f), "a test")
    , All(Device, Nodes, Everywhere.Data())
    , Volume(Device, scene.grid, OccupancyBuilder(scene.grid).Take(false),
        SourceOfLight(scene.light, scene.grid), rayDensity)
  {
  }

  void ExpectSameBits(const std::vector<float>& extinction)
  {
    const Field field(this->Device, extinction, "a test");
    const std::vector<float> ones(extinction.size(), 1.0f);
    Field dimmed(this->Device, ones, "a test");
    Field full(this->Device, ones, "a test");
    this->Volume.Sweep(field.Data(), dimmed.Data());
    for (FrustumRays<TestedDevice>& rays : this->Volume.Frusta())
    {
      SweepFrontToBack(this->Device, rays, this->All,
        TransmittanceKernel<const float*, float*>{ field.Data(), full.Data() });
    }
    std::vector<float> found[2] = { ones, ones };
    dimmed.Download(found[0].data());
    full.Download(found[1].data());
    EXPECT_EQ(found[0], found[1]);
  }

private:
  using Field = DeviceArray<TestedDevice, float>;

  std::shared_ptr<TestedDevice> Device = MakeTestedDevice();
  Int3 Nodes;
  Field Everywhere;
  FieldBlocks<TestedDevice> All;
  TransmittanceSweep<TestedDevice> Volume;
};

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

// Most tiles are not visited. Their voxels and images have the values that a visit would give.
TEST_P(TransmittanceOfDevice, HasTheBitsOfASweepOverAllTiles)
{
  BoxScene scene = BoxUnder(GetParam(), { 43, 37, 40 });
  std::mt19937 generator(11);
  for (const double most : { 0.02, 0.5, 40.0 }) // optical depth of a voxel
  {
    SCOPED_TRACE(most);
    FillBoxes(scene, most, generator);
    SweptTwice sweep(scene, GetParam().rayDensity);

    sweep.ExpectSameBits(scene.extinction);
    FillBoxes(scene, most, generator);
    sweep.ExpectSameBits(scene.extinction);
    scene.extinction.assign(scene.extinction.size(), 0.0f);
    sweep.ExpectSameBits(scene.extinction);
  }
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
