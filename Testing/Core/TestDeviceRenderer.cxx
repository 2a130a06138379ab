// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Pictures that devices draw against the processor's.

#include "RenderScene.h"
#include "TestedDevice.h"
#include "Tolerance.h"

#include "backend/Backend.h"
#include "render/RenderPasses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <ostream>
#include <random>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
/// Anisotropic, off the origin, turned.
Grid TurnedGrid()
{
  Grid grid = MakeGrid({ 23, 18, 15 }, { 5, -3, 20 }, { 0.7, 1.0, 1.4 });
  grid.direction = Mat3(Vec3(0, 0.6, 0.8), Vec3(-1, 0, 0), Vec3(0, -0.8, 0.6));
  return grid;
}

RenderScene Ordinary()
{
  RenderScene scene = RenderScene::Random(3, TurnedGrid(), 8);
  scene.LookAtBox(RenderScene::Direction(0.9, 1.3, -3), 61);
  return scene;
}

Renderer RendererOn(const std::shared_ptr<TestedDevice>& device)
{
  return Renderer(std::make_unique<RenderPasses<TestedDevice>>(device));
}

Renderer ThatOfADevice()
{
  return RendererOn(MakeTestedDevice());
}

Picture Drawn(Renderer& renderer, const RenderScene& scene)
{
  Picture picture;
  renderer.Render(scene.WholeView(), picture);
  return picture;
}

/// Two pictures whose colours differ by rounding: by 1e-3 at most, which may move a byte by one,
/// and so few of them that the mean is 1/50 of a byte.
void ExpectSame(const Picture& found, const Picture& expected)
{
  ASSERT_EQ(found.rgba.size(), expected.rgba.size());
  double worst = 0;
  double sum = 0;
  int seen = 0;
  for (std::size_t byte = 0; byte < found.rgba.size(); ++byte)
  {
    const double difference = std::abs(double(found.rgba[byte]) - double(expected.rgba[byte]));
    worst = std::max(worst, difference);
    sum += difference;
    seen += expected.rgba[byte] > 0 ? 1 : 0;
  }
  EXPECT_LE(worst, 1);
  EXPECT_LE(sum, 0.02 * double(found.rgba.size()));
  EXPECT_GT(seen, 0) << "an empty picture tells nothing";
}

struct Case
{
  const char* name;
  std::function<void(RenderScene&)> change;
};

std::ostream& operator<<(std::ostream& stream, const Case& one)
{
  return stream << one.name;
}

void Illuminate(RenderScene& scene)
{
  scene.lighting.enabled = true;
}

void IlluminateFromFarAway(RenderScene& scene)
{
  Illuminate(scene);
  scene.lighting.light.type = LightType::Directional;
  scene.lighting.anisotropy = -0.4;
  scene.lighting.surface = 0.7;
}

void LookInParallel(RenderScene& scene)
{
  const Vec3 eye = scene.grid.Centre() + 3.0 * scene.grid.Radius() * Vec3(0.3, -0.4, 0.85);
  scene.view.clipToWorld = Parallel(LookAt(eye, scene.grid.Centre(), Vec3(0, 1, 0.1)),
    0.8 * scene.grid.Radius(), 1, 1.5 * scene.grid.Radius(), 5 * scene.grid.Radius());
}

void LookFromInside(RenderScene& scene)
{
  scene.view.clipToWorld = Perspective(
    LookAt(scene.grid.Centre(), scene.grid.Centre() + Vec3(1, 0.3, 0.2), Vec3(0, 1, 0.1)), 60, 1,
    0.01 * scene.grid.Radius(), 3 * scene.grid.Radius());
}

/// Something opaque in front of or in the volume at some pixels.
void StandInTheWay(RenderScene& scene)
{
  std::mt19937 generator(11);
  std::uniform_real_distribution<float> depth(-0.2f, 1.0f);
  for (int pixel = 0; pixel < scene.view.width * scene.view.height; ++pixel)
  {
    scene.depth.push_back(depth(generator));
  }
}

/// Adds opaque geometry, and something translucent in front of it.
void StandBetween(RenderScene& scene)
{
  StandInTheWay(scene);
  std::mt19937 generator(12);
  std::uniform_real_distribution<float> depth(-1.0f, 0.6f);
  for (int pixel = 0; pixel < scene.view.width * scene.view.height; ++pixel)
  {
    scene.nearDepth.push_back(depth(generator));
  }
}

void LeaveHoles(RenderScene& scene)
{
  for (std::size_t node = 0; node < scene.scalars.size(); node += 7)
  {
    scene.scalars[node] = std::numeric_limits<float>::quiet_NaN();
  }
}

/// Some of it is important.
void Miss(RenderScene& scene)
{
  std::mt19937 generator(5);
  scene.importance = RenderScene::Waves(scene.grid, generator);
  for (float& importance : scene.importance)
  {
    importance = importance > 0.6f ? std::min(importance, 1.0f) : 0.0f;
  }
}

/// Gives blobs of structures their colours, but for one.
void Tint(RenderScene& scene)
{
  const Int3& nodes = scene.grid.nodes;
  for (int node = 0; node < nodes.x * nodes.y * nodes.z; ++node)
  {
    const int row = node / nodes.x;
    scene.structures.push_back(
      StructureRow((node % nodes.x / 5 + row % nodes.y / 4 + row / nodes.y / 6) % 4));
  }
  scene.structureColors = 0.8;
  scene.colorsOfRows = { { { 1, 0, 0 } }, { { 0.2f, 1, 0.1f } } };
}

const Case cases[] = {
  { "Unlit", [](RenderScene&) {} },
  { "Changed", [](RenderScene& scene) { scene.Change(scene.grid.nodes, 21); } },
  { "ChangedOnACoarserGrid",
    [](RenderScene& scene) {
      scene.Change({ 7, 8, 5 }, 21);
    } },
  { "ChangedOnAFinerGrid",
    [](RenderScene& scene) {
      scene.Change({ 37, 28, 25 }, 21);
    } },
  { "Lit", Illuminate },
  { "LitWithoutShadows",
    [](RenderScene& scene)
    {
      Illuminate(scene);
      scene.lighting.shadows = false;
    } },
  { "LitAndChanged",
    [](RenderScene& scene)
    {
      Illuminate(scene);
      scene.Change(scene.grid.nodes, 21);
    } },
  { "LitFromFarAway", IlluminateFromFarAway },
  { "LitFromFarAwayAndChangedOnACoarserGrid",
    [](RenderScene& scene)
    {
      IlluminateFromFarAway(scene);
      scene.Change({ 7, 18, 8 }, 4);
    } },
  { "LitFromInside",
    [](RenderScene& scene)
    {
      Illuminate(scene);
      scene.lighting.light.position = scene.grid.Centre() + Vec3(1, 2, -1);
    } },
  { "Parallel",
    [](RenderScene& scene)
    {
      LookInParallel(scene);
      Illuminate(scene);
    } },
  { "FromInside",
    [](RenderScene& scene)
    {
      LookFromInside(scene);
      Illuminate(scene);
    } },
  { "BehindOpaqueThings",
    [](RenderScene& scene)
    {
      StandInTheWay(scene);
      Illuminate(scene);
      scene.Change(scene.grid.nodes, 5);
    } },
  { "BetweenTwoSurfaces",
    [](RenderScene& scene)
    {
      StandBetween(scene);
      scene.view.jitter = true;
      Illuminate(scene);
    } },
  { "WithHoles",
    [](RenderScene& scene)
    {
      LeaveHoles(scene);
      Illuminate(scene);
    } },
  { "Jittered",
    [](RenderScene& scene)
    {
      scene.view.jitter = true;
      Illuminate(scene);
    } },
  { "WithoutSkips",
    [](RenderScene& scene)
    {
      scene.view.skipEmpty = false;
      Illuminate(scene);
    } },
  { "PaintedWithWhatIsMissed", [](RenderScene& scene) { Miss(scene); } },
  { "PaintedWhereItIsChangedAndLit",
    [](RenderScene& scene)
    {
      scene.Change(scene.grid.nodes, 21);
      Illuminate(scene);
      Miss(scene);
    } },
  { "PaintedUpToOpaqueThings",
    [](RenderScene& scene)
    {
      scene.Change({ 9, 8, 7 }, 8);
      StandInTheWay(scene);
      Miss(scene);
    } },
  { "WithManySamples", [](RenderScene& scene) { scene.view.sampleDistance = 0.3; } },
  { "WithFewSamples", [](RenderScene& scene) { scene.view.sampleDistance = 6; } },
  { "OpaqueToTheEnd",
    [](RenderScene& scene)
    {
      scene.view.opaqueBelow = 0;
      for (float& extinction : scene.functions.extinction)
      {
        extinction *= 100;
      }
    } },
  { "WiderThanHigh",
    [](RenderScene& scene)
    {
      scene.view.width = 101;
      scene.view.height = 3;
      Illuminate(scene);
    } },
  { "FromTheMostImportantObjectOn",
    [](RenderScene& scene)
    {
      Illuminate(scene);
      Miss(scene);
      scene.compositing = Compositing::FromObject;
    } },
  { "MeanByImportance",
    [](RenderScene& scene)
    {
      Illuminate(scene);
      Miss(scene);
      scene.compositing = Compositing::ImportanceMean;
    } },
  { "Tinted", Tint },
  { "TintedLitAndChanged",
    [](RenderScene& scene)
    {
      Tint(scene);
      Illuminate(scene);
      scene.Change({ 7, 8, 5 }, 21);
    } },
  { "TintedMeanByImportance",
    [](RenderScene& scene)
    {
      Tint(scene);
      Miss(scene);
      scene.compositing = Compositing::ImportanceMean;
    } },
};
}

class PictureOfDevice : public ::testing::TestWithParam<Case>
{
};

TEST_P(PictureOfDevice, IsThatOfTheProcessor)
{
  RenderScene scene = Ordinary();
  GetParam().change(scene);
  Renderer there = ThatOfADevice();
  scene.SetUp(there);

  ExpectSame(Drawn(there, scene), scene.Render());
}

INSTANTIATE_TEST_SUITE_P(
  Scenes, PictureOfDevice, ::testing::ValuesIn(cases), ::testing::PrintToStringParamName());

namespace
{
/// Makes each call on a device and on the processor.
class Both
{
public:
  Both()
    : There(ThatOfADevice())
  {
  }

  template <class Call>
  void Do(const Call& call)
  {
    call(this->Here);
    call(this->There);
  }

  void ExpectSamePicture(const RenderScene& scene)
  {
    ExpectSame(Drawn(this->There, scene), Drawn(this->Here, scene));
  }

  void ExpectSameShadows(const RenderScene& scene)
  {
    std::mt19937 generator(2);
    std::uniform_real_distribution<double> share(0.01, 0.99);
    for (int i = 0; i < 20; ++i)
    {
      const Vec3 index =
        Vec3(share(generator), share(generator), share(generator)) * (Vec3(scene.grid.nodes) - 1.0);
      const Vec3 world = scene.grid.PointToWorld(index);
      // A unit of the 16 bits, and the roundings of the sweeps.
      EXPECT_NEAR(this->There.ArrivingLightAt(world), this->Here.ArrivingLightAt(world), 5e-5);
    }
  }

private:
  Renderer Here;
  Renderer There;
};
}

TEST(RendererOfDevice, FollowsWhatChanges)
{
  RenderScene scene = Ordinary();
  Both both;
  both.Do([&](Renderer& renderer) { scene.SetUp(renderer); });
  both.ExpectSamePicture(scene);

  Illuminate(scene);
  both.Do([&](Renderer& renderer) { renderer.SetLighting(scene.lighting); });
  both.ExpectSamePicture(scene);

  std::reverse(scene.functions.extinction.begin(), scene.functions.extinction.end());
  both.Do([&](Renderer& renderer) { renderer.SetTransferFunctions(scene.functions); });
  both.ExpectSamePicture(scene);

  std::reverse(scene.scalars.begin(), scene.scalars.end());
  both.Do([&](Renderer& renderer) { renderer.SetScalars(scene.grid, scene.scalars.data()); });
  both.ExpectSamePicture(scene);

  scene.lighting.light.position += Vec3(3, -20, 7);
  both.Do([&](Renderer& renderer) { renderer.SetLighting(scene.lighting); });
  both.ExpectSamePicture(scene);

  scene.lighting.shadows = false;
  both.Do([&](Renderer& renderer) { renderer.SetLighting(scene.lighting); });
  both.ExpectSamePicture(scene);
}

TEST(RendererOfDevice, TakesIntegersAsFloats)
{
  RenderScene scene = Ordinary();
  std::vector<std::uint16_t> integers;
  for (const float scalar : scene.scalars)
  {
    integers.push_back(std::uint16_t(65535 * std::min(std::max(scalar, 0.0f), 1.0f)));
  }
  scene.functions.low *= 65535;
  scene.functions.high *= 65535;
  Both both;
  both.Do(
    [&](Renderer& renderer)
    {
      scene.SetUp(renderer);
      renderer.SetScalars(scene.grid, ScalarNodes(integers.data()));
      renderer.SetTransferFunctions(scene.functions);
    });
  both.ExpectSamePicture(scene);
}

TEST(RendererOfDevice, MovesToANewExtinction)
{
  RenderScene scene = Ordinary();
  Illuminate(scene);
  scene.Change(scene.grid.nodes, 21);
  RenderScene coarse = scene;
  coarse.Change({ 9, 8, 7 }, 8);
  Both both;
  both.Do([&](Renderer& renderer) { scene.SetUp(renderer); });
  const auto show = [&](const RenderScene& which, double share)
  {
    both.Do(
      [&](Renderer& renderer) {
        renderer.SetExtinction(which.changeGrid, which.base.data(), which.extinction.data(), share);
      });
    both.ExpectSamePicture(which);
  };

  show(scene, 0.4);
  show(scene, 0.4);
  show(coarse, 0.5);
  show(coarse, 1);
  show(scene, 0.3);
  both.Do([&](Renderer& renderer) { renderer.SetExtinction(scene.grid, nullptr, nullptr); });
  both.ExpectSamePicture(scene);
}

TEST(RendererOfDevice, CastsTheShadowsOfAnotherExtinction)
{
  RenderScene scene = Ordinary();
  Illuminate(scene);
  scene.Change(scene.grid.nodes, 21);
  RenderScene other = scene;
  other.Change(scene.grid.nodes, 77);
  Both both;
  both.Do(
    [&](Renderer& renderer)
    {
      scene.SetUp(renderer);
      renderer.SetExtinction(
        scene.changeGrid, scene.base.data(), scene.extinction.data(), 1, other.extinction.data());
    });

  both.ExpectSamePicture(scene);
  both.ExpectSameShadows(scene);
}

TEST(RendererOfDevice, CastsCoarseShadows)
{
  for (const bool given : { false, true })
  {
    SCOPED_TRACE(given ? "of what is given" : "of the transfer function");
    RenderScene scene = Ordinary();
    Illuminate(scene);
    if (given)
    {
      scene.Change(scene.grid.nodes, 21);
    }
    Both both;
    both.Do([&](Renderer& renderer) { scene.SetUp(renderer); });
    for (const int coarseness : { 3, 2, 1 })
    {
      both.Do([&](Renderer& renderer) { renderer.SetShadowCoarseness(coarseness); });

      both.ExpectSamePicture(scene);
      both.ExpectSameShadows(scene);
    }
  }
}

TEST(RendererOfDevice, TakesAnExtinctionThatIsThere)
{
  RenderScene scene = Ordinary();
  Illuminate(scene);
  scene.Change(scene.grid.nodes, 21);
  const auto device = MakeTestedDevice();
  Renderer there = RendererOn(device);
  scene.SetUp(there);
  std::reverse(scene.extinction.begin(), scene.extinction.end());
  {
    const DeviceArray<TestedDevice, float> base(device, scene.base, "a test");
    const DeviceArray<TestedDevice, float> extinction(device, scene.extinction, "a test");
    there.ShowThere(scene.changeGrid, base.Data(), extinction.Data());
  }

  ExpectSame(Drawn(there, scene), scene.Render());
}

TEST(RendererOfDevice, LeavesNothingBehind)
{
  const auto device = MakeTestedDevice();
  {
    RenderScene scene = Ordinary();
    Illuminate(scene);
    StandInTheWay(scene);
    Miss(scene);
    Renderer renderer = RendererOn(device);
    scene.SetUp(renderer);
    Drawn(renderer, scene);
  }

  EXPECT_EQ(device->Bytes(), 0u);
}
