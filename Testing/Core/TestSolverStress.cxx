// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Where numbers break: every line keeps mu in [0, majorant], T in [0, 1], S below the integral of
// g mu, and no NaN, with and without skips.

#include "BoxScene.h"
#include "Tolerance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
struct Stress
{
  std::string name;
  std::function<BoxScene()> make;
};

std::ostream& operator<<(std::ostream& stream, const Stress& stress)
{
  return stream << stress.name;
}

BoxScene Onion(double opticalDepth = 20)
{
  BoxScene scene(Int3(13, 12, 11), Vec3(-1, -1, -1), Vec3(2.0 / 12, 2.0 / 11, 0.2));
  scene.FillOnion(opticalDepth);
  return scene;
}

/// `change` applied to the onion.
Stress OnionWith(const std::string& name, const std::function<void(BoxScene&)>& change)
{
  return { name,
    [=]
    {
      BoxScene scene = Onion();
      change(scene);
      return scene;
    } };
}

Stress Image(
  const std::string& name, const Int3& nodes, const Vec3& spacing, const Vec3& origin = Vec3(0))
{
  return { name,
    [=]
    {
      BoxScene scene(nodes, origin, spacing);
      const double radius = std::max(scene.grid.Radius(), 1e-30);
      scene.Fill(Everywhere(3 / radius), Everywhere(0.5));
      scene.importance[scene.importance.size() / 2] = 1;
      return scene;
    } };
}

Stress EyeAt(const std::string& name, const Vec3& position)
{
  return OnionWith(name,
    [=](BoxScene& scene)
    {
      scene.camera.position = position;
      scene.camera.focalPoint = position + Vec3(0.1, 0.3, 1);
    });
}

Stress LampAt(const std::string& name, const Vec3& position)
{
  return OnionWith(name, [=](BoxScene& scene) { scene.light.position = position; });
}

std::vector<Stress> Cases()
{
  std::vector<Stress> cases;
  for (const double depth : { 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e12, 1e30 })
  {
    const std::string name = "optical depth 1e" + std::to_string(int(std::log10(depth)));
    cases.push_back({ name, [=] { return Onion(depth); } });
  }
  cases.push_back(OnionWith(
    "an extinction from alpha 1", [](BoxScene& scene) { scene.extinction[600] = 1e37f; }));
  cases.push_back(OnionWith(
    "denormal extinction", [](BoxScene& scene) { scene.Fill(Everywhere(1e-40), Everywhere(1)); }));
  cases.push_back(OnionWith(
    "constant fields", [](BoxScene& scene) { scene.Fill(Everywhere(2), Everywhere(0.25)); }));
  cases.push_back(OnionWith("no importance",
    [](BoxScene& scene) { std::fill(scene.importance.begin(), scene.importance.end(), 0.0f); }));
  cases.push_back(OnionWith("all important",
    [](BoxScene& scene) { std::fill(scene.importance.begin(), scene.importance.end(), 1.0f); }));
  cases.push_back(OnionWith("no extinction",
    [](BoxScene& scene) { std::fill(scene.extinction.begin(), scene.extinction.end(), 0.0f); }));
  cases.push_back(OnionWith("one important voxel",
    [](BoxScene& scene)
    {
      std::fill(scene.importance.begin(), scene.importance.end(), 0.0f);
      scene.importance[6 + 13 * (5 + 12 * 5)] = 1;
    }));
  cases.push_back(OnionWith("one important voxel in a corner",
    [](BoxScene& scene)
    {
      std::fill(scene.importance.begin(), scene.importance.end(), 0.0f);
      scene.importance.back() = 1;
      scene.extinction.back() = 1;
    }));
  cases.push_back(OnionWith("importance in empty space",
    [](BoxScene& scene)
    {
      for (std::size_t n = 0; n < scene.extinction.size(); ++n)
      {
        scene.importance[n] = scene.extinction[n] > 0 ? 0.0f : 1.0f;
      }
    }));

  cases.push_back(Image("one slice", Int3(9, 8, 1), Vec3(1)));
  cases.push_back(Image("one row", Int3(9, 1, 1), Vec3(1)));
  cases.push_back(Image("one column", Int3(1, 9, 1), Vec3(1)));
  cases.push_back(Image("one slice across x", Int3(1, 8, 7), Vec3(1)));
  cases.push_back(Image("one voxel", Int3(1, 1, 1), Vec3(1)));
  cases.push_back(Image("two by two by two", Int3(2, 2, 2), Vec3(1)));
  cases.push_back(Image("two by two by many", Int3(2, 2, 40), Vec3(1)));
  cases.push_back(Image("many by two by two", Int3(40, 2, 2), Vec3(1)));
  cases.push_back(Image("spacing ratio 1000 along z", Int3(9, 9, 9), Vec3(1, 1, 1000)));
  cases.push_back(Image("spacing ratio 1000 along x", Int3(9, 9, 9), Vec3(1000, 1, 1)));
  cases.push_back(Image("spacing ratio a million", Int3(9, 9, 9), Vec3(1e-3, 1, 1e3)));
  cases.push_back(
    Image("ten million from the origin", Int3(9, 9, 9), Vec3(1), Vec3(1e7, -1e7, 1e7)));
  cases.push_back(Image("spacing 1e-9", Int3(9, 9, 9), Vec3(1e-9)));
  cases.push_back(Image("spacing 1e+9", Int3(9, 9, 9), Vec3(1e9)));

  cases.push_back(EyeAt("eye on a voxel", Vec3(-1 + 4 * 2.0 / 12, -1 + 3 * 2.0 / 11, -0.4)));
  cases.push_back(EyeAt("eye on a face", Vec3(-1, 0.13, 0.21)));
  cases.push_back(EyeAt("eye on an edge", Vec3(-1, 1, 0.21)));
  cases.push_back(EyeAt("eye on a corner", Vec3(1, 1, 1)));
  cases.push_back(EyeAt("eye inside", Vec3(0.03, 0.13, 0.21)));
  cases.push_back(EyeAt("eye in the centre", Vec3(0, 0, 0)));
  cases.push_back(EyeAt("eye in the plane of a face", Vec3(-4, 0.1, 1)));
  cases.push_back(EyeAt("eye along an axis", Vec3(0, 0, -5)));
  cases.push_back(EyeAt("eye along an edge", Vec3(-1, -1, -5)));
  cases.push_back(EyeAt("eye along a diagonal", Vec3(5, 5, 5)));
  cases.push_back(EyeAt("eye a hair from a face", Vec3(0.1, 0.2, -1 - 1e-12)));
  cases.push_back(EyeAt("eye a million radii away", Vec3(1e6, 2e6, -1.5e6)));
  cases.push_back(OnionWith("view-up along the view",
    [](BoxScene& scene)
    {
      scene.camera.viewUp = scene.camera.focalPoint - scene.camera.position;
      scene.settings.restrictToView = true;
    }));
  cases.push_back(OnionWith("only what the picture shows",
    [](BoxScene& scene)
    {
      scene.camera.viewAngle = 5;
      scene.settings.restrictToView = true;
    }));
  cases.push_back(OnionWith("a picture that shows nothing of the box",
    [](BoxScene& scene)
    {
      scene.camera.focalPoint = 2.0 * scene.camera.position;
      scene.settings.restrictToView = true;
    }));
  cases.push_back(OnionWith("a parallel picture that shows nothing of the box",
    [](BoxScene& scene)
    {
      scene.camera.parallel = true;
      scene.camera.parallelScale = 0.1;
      scene.camera.position += Vec3(0, 50, 0);
      scene.camera.focalPoint += Vec3(0, 50, 0);
      scene.settings.restrictToView = true;
    }));
  cases.push_back(OnionWith("parallel along an axis",
    [](BoxScene& scene)
    {
      scene.camera.parallel = true;
      scene.camera.position = Vec3(0, -3, 0);
      scene.camera.focalPoint = Vec3(0, 0, 0);
    }));
  cases.push_back(OnionWith("parallel along the diagonal",
    [](BoxScene& scene)
    {
      scene.camera.parallel = true;
      scene.camera.position = Vec3(-3, -3, -3);
      scene.camera.focalPoint = Vec3(0, 0, 0);
    }));

  cases.push_back(OnionWith(
    "light at the camera", [](BoxScene& scene) { scene.light.position = scene.camera.position; }));
  cases.push_back(LampAt("light inside", Vec3(0.03, 0.13, 0.21)));
  cases.push_back(LampAt("light on a voxel", Vec3(-1 + 4 * 2.0 / 12, -1 + 3 * 2.0 / 11, -0.4)));
  cases.push_back(LampAt("light a million radii away", Vec3(1e6, 2e6, -1.5e6)));
  cases.push_back(OnionWith("directional light",
    [](BoxScene& scene)
    {
      scene.light.type = LightType::Directional;
      scene.light.position = Vec3(-3, 3, -3);
    }));

  cases.push_back(OnionWith("huge weights",
    [](BoxScene& scene) {
      scene.settings.weights = { 1e12, 1e15, 1e9 };
    }));
  cases.push_back(OnionWith(
    "no regularization", [](BoxScene& scene) { scene.settings.weights.regularization = 0; }));
  cases.push_back(
    OnionWith("no camera term", [](BoxScene& scene) { scene.settings.weights.view = 0; }));
  cases.push_back(
    OnionWith("no light term", [](BoxScene& scene) { scene.settings.weights.light = 0; }));
  cases.push_back(
    OnionWith("separate fields", [](BoxScene& scene) { scene.settings.mode = Mode::Separate; }));
  cases.push_back(OnionWith(
    "nothing thicker than the data", [](BoxScene& scene) { scene.settings.emphasis = 0; }));
  cases.push_back(OnionWith("all that is important protected",
    [](BoxScene& scene) { scene.settings.protectImportance = 1; }));
  cases.push_back(OnionWith("few rays", [](BoxScene& scene) { scene.settings.rayDensity = 0.1; }));
  cases.push_back(OnionWith("the paper's derivative",
    [](BoxScene& scene) { scene.settings.derivative = Derivative::Ray; }));
  return cases;
}

class SolverStress : public ::testing::TestWithParam<Stress>
{
};

std::string NameOf(const ::testing::TestParamInfo<Stress>& stress)
{
  std::string name;
  for (const char c : stress.param.name)
  {
    name += c == '+' ? 'p' : c == '-' ? 'm' : std::isalnum(c) ? c : '_';
  }
  return name;
}

void ExpectWithin01(const std::vector<float>& field, const char* name)
{
  std::size_t bad = 0;
  for (const float value : field)
  {
    bad += value >= 0 && value <= 1 ? 0 : 1;
  }
  EXPECT_EQ(bad, 0u) << name << " leaves [0, 1]";
}

void ExpectValidExtinction(const std::vector<float>& field, double majorant, const char* name)
{
  std::size_t bad = 0;
  for (const float value : field)
  {
    bad += value >= 0 && value <= majorant ? 0 : 1;
  }
  EXPECT_EQ(bad, 0u) << name << " leaves [0, " << majorant << "]";
}

void ExpectBounds(const BoxScene& scene)
{
  Solver solver = scene.MakeSolver();
  solver.Run();

  ASSERT_EQ(solver.Extinction().size(), scene.extinction.size());
  ExpectValidExtinction(solver.Extinction(), solver.Majorant(), "the extinction");
  ExpectValidExtinction(solver.LightExtinction(), solver.Majorant(), "the light's extinction");
  std::vector<float> transmittance(scene.extinction.size(), -1.0f);
  solver.Transmittance(transmittance.data());
  ExpectWithin01(transmittance, "the transmittance");
  std::fill(transmittance.begin(), transmittance.end(), -1.0f);
  solver.LightTransmittance(transmittance.data());
  ExpectWithin01(transmittance, "the light's transmittance");

  for (const Score& score : { solver.BaseScore(), solver.BestScore() })
  {
    EXPECT_TRUE(std::isfinite(score.visibility));
    EXPECT_GE(score.visibility, 0);
    EXPECT_GE(score.fraction, 0);
    EXPECT_LE(score.fraction, 1);
  }
  ASSERT_FALSE(solver.History().empty()) << "the first record is the base's";
  for (const IterationRecord& record : solver.History())
  {
    EXPECT_TRUE(std::isfinite(record.energy.Total()));
    EXPECT_TRUE(std::isfinite(record.meanChange));
    EXPECT_GE(record.energy.regularization, 0);
    EXPECT_LE(record.energy.view, 0);
    EXPECT_LE(record.energy.light, 0);
    EXPECT_GE(record.score.fraction, 0);
    EXPECT_LE(record.score.fraction, 1);
  }
  EXPECT_LE(solver.BestEnergy().Total(), solver.History().front().energy.Total());

  if (scene.grid.HasVolume() && !scene.settings.restrictToView)
  {
    const double most = truth::ImportantExtinction(scene.TruthWith(solver.Extinction()));
    EXPECT_LE(solver.BestScore().visibility, most * 1.05 + 1e-300)
      << "more is seen than there is (5 % for coarse images)";
  }
}
}

TEST_P(SolverStress, KeepsItsBoundsWithSkips)
{
  ExpectBounds(GetParam().make());
}

TEST_P(SolverStress, KeepsItsBoundsWithoutSkips)
{
  BoxScene scene = GetParam().make();
  scene.settings.skipUnneeded = false;

  ExpectBounds(scene);
}

TEST_P(SolverStress, KeepsItsBoundsWithAdam)
{
  BoxScene scene = GetParam().make();
  scene.settings.solver = SolverKind::Adam;
  scene.settings.iterationsPerLevel = { { 3, 3, 3 } };

  ExpectBounds(scene);
}

INSTANTIATE_TEST_SUITE_P(Numbers, SolverStress, ::testing::ValuesIn(Cases()), NameOf);

TEST(SolverStress, CountsMoreVoxelsThanAnIntHolds)
{
  Grid grid;
  grid.nodes = Int3(2048, 2048, 1025);

  EXPECT_EQ(grid.NodeCount(), Index(2048) * 2048 * 1025);
  EXPECT_GT(grid.NodeCount(), Index(std::numeric_limits<std::int32_t>::max()));
}
