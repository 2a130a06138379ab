// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Results and pictures equal those of a fresh object, after any calls in any order.

#include "PretendedClock.h"
#include "RandomScene.h"
#include "RenderScene.h"

#include "optimize/Progressive.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace limpid;

namespace
{
/// Another eye, another lamp, other settings: each or none.
void Vary(BoxScene& scene, RandomNumbers& random)
{
  if (random.Chance(0.6))
  {
    LookFrom(MakeRandomEye(random, scene.grid), scene.camera);
    scene.camera.parallelScale = 0.7 * std::max(scene.grid.Radius(), 1e-3);
  }
  if (random.Chance(0.4))
  {
    ShineFrom(MakeRandomEye(random, scene.grid), scene.light);
  }
  if (random.Chance(0.5))
  {
    Settings& settings = scene.settings;
    settings.solver = random.Chance(0.3) ? SolverKind::Adam : SolverKind::Policy;
    settings.mode = random.Chance(0.3) ? Mode::Separate : Mode::Joint;
    settings.maximumIterations = random.IntegerBetween(0, 3);
    settings.iterationsPerLevel = { { random.IntegerBetween(0, 2), 1, 2 } };
    settings.skipUnneeded = random.Chance(0.7);
    settings.restrictToView = random.Chance(0.3);
    settings.weights.view = random.Chance(0.2) ? 0.0 : random.PowerOfTen(-1, 3);
    settings.weights.light = random.Chance(0.4) ? 0.0 : random.PowerOfTen(-1, 2);
    settings.protectImportance = random.Chance(0.6) ? 0.0 : random.Between(0, 1);
    settings.clearingThreshold = random.Chance(0.6) ? 0.0 : random.PowerOfTen(-4, 0);
    settings.emphasis = random.Chance(0.6) ? 1.0 : random.Between(0, 1);
    settings.importanceSmoothing =
      random.Chance(0.6) ? ImportanceSmoothing::Off : ImportanceSmoothing::Median;
    settings.smoothness = random.Chance(0.6) ? 0.0 : random.Between(0, 1);
  }
}

/// Refines a few times, to the end, or makes previews on a machine that is as fast as it likes.
void WorkOn(Progressive& progressive, RandomNumbers& random)
{
  if (random.Chance(0.4))
  {
    const PretendedClock clock(random.PowerOfTen(-4, 0) / 1000);
    progressive.Preview(0.01);
    return;
  }
  int left = random.IntegerBetween(1, 12);
  while (left > 0 && !progressive.Refine())
  {
    --left;
  }
}

std::vector<float> Copy(const Progressive& progressive, const float* field)
{
  return { field, field + progressive.ShownGrid().NodeCount() };
}

std::string DifferenceFrom(const Progressive& expected, const Progressive& found)
{
  const auto differ = [&](const float* (Progressive::*field)() const)
  {
    return found.ShownGrid().nodes != expected.ShownGrid().nodes ||
      Copy(found, (found.*field)()) != Copy(expected, (expected.*field)());
  };
  if (differ(&Progressive::Extinction) || differ(&Progressive::LightExtinction) ||
    differ(&Progressive::BaseExtinction))
  {
    return "another extinction";
  }
  const bool sameScores = found.BaseScore().visibility == expected.BaseScore().visibility &&
    found.BestScore().visibility == expected.BestScore().visibility &&
    found.BestScore().fraction == expected.BestScore().fraction;
  return sameScores ? "" : "another score";
}

/// One of a few volumes, changes of them, lights and views.
RenderScene MakeRandomPicture(RandomNumbers& random)
{
  const Int3 sizes[] = { { 17, 12, 9 }, { 9, 16, 20 }, { 17, 12, 9 } };
  const Grid grid = MakeGrid(
    sizes[random.IntegerBetween(0, 2)], { -1, 2, 3 }, { 0.5, 0.6, random.Chance(0.5) ? 0.8 : 0.4 });
  RenderScene scene =
    RenderScene::Random(unsigned(random.IntegerBetween(1, 3)), grid, random.Chance(0.5) ? 8 : 40);
  if (random.Chance(0.6))
  {
    const bool coarse = random.Chance(0.5);
    scene.Change(coarse ? (grid.nodes + 1) / 2 : grid.nodes, unsigned(random.IntegerBetween(1, 3)));
    if (random.Chance(0.2))
    {
      scene.extinction = scene.base; // nothing is changed
    }
  }
  scene.lighting.enabled = random.Chance(0.7);
  scene.lighting.shadows = random.Chance(0.7);
  if (random.Chance(0.5))
  {
    scene.lighting.light.position = grid.Centre() + 3.0 * grid.Radius() * random.Direction();
  }
  scene.lighting.light.type = random.Chance(0.5) ? LightType::Directional : LightType::Point;
  scene.shadowRayDensity = random.Chance(0.5) ? 3 : 1;
  scene.LookAtBox(random.Direction(), 24);
  return scene;
}

/// Pictures on the way may be coarse and half eased in.
void DrawOnTheWay(Renderer& renderer, const RenderScene& scene, RandomNumbers& random)
{
  if (random.Chance(0.8))
  {
    renderer.SetScalars(scene.grid, scene.scalars.data());
    renderer.SetTransferFunctions(scene.functions);
    if (scene.extinction.empty())
    {
      renderer.SetExtinction(Grid(), nullptr, nullptr);
    }
    else
    {
      renderer.SetExtinction(scene.changeGrid, scene.base.data(), scene.extinction.data(),
        random.Chance(0.5) ? 1 : random.Between(0.1, 0.9));
    }
  }
  renderer.SetShadowCoarseness(random.Chance(0.5) ? 1 : random.IntegerBetween(2, 4));
  renderer.SetLighting(scene.lighting);
  renderer.SetShadowRayDensity(scene.shadowRayDensity);
  if (random.Chance(0.3))
  {
    renderer.UpdateShadows();
  }
  Picture picture;
  renderer.Render(scene.view, picture);
}
}

TEST(Sequences, LeaveNoTraceInARefinedResult)
{
  for (unsigned seed = 1; seed <= 1500; seed += unsigned(OneOf(10)))
  {
    RandomNumbers random(seed);
    BoxScene scene = MakeRandomScene(seed);
    Progressive progressive(scene.Fields(), scene.settings);
    const int steps = random.IntegerBetween(1, 5);
    for (int step = 0; step < steps; ++step)
    {
      Vary(scene, random);
      progressive.SetView(scene.camera, scene.light, scene.settings);
      WorkOn(progressive, random);
    }
    Progressive fresh(scene.Fields(), scene.settings);
    fresh.SetView(scene.camera, scene.light, scene.settings);
    for (Progressive* either : { &progressive, &fresh })
    {
      while (!either->Refine())
      {
      }
    }
    ASSERT_EQ(DifferenceFrom(fresh, progressive), "") << "scene " << seed;
  }
}

TEST(Sequences, LeaveNoTraceInAPicture)
{
  for (unsigned seed = 1; seed <= 300; seed += unsigned(OneOf()))
  {
    RandomNumbers random(seed);
    std::vector<RenderScene> scenes; // they stay: the renderer reads their fields
    Renderer renderer;
    const int steps = random.IntegerBetween(1, 5);
    scenes.reserve(std::size_t(steps));
    for (int step = 0; step < steps; ++step)
    {
      scenes.push_back(MakeRandomPicture(random));
      if (step == 0)
      {
        scenes.back().SetUp(renderer);
      }
      DrawOnTheWay(renderer, scenes.back(), random);
    }
    const RenderScene last = MakeRandomPicture(random);
    last.SetUp(renderer);
    if (last.extinction.empty())
    {
      renderer.SetExtinction(Grid(), nullptr, nullptr);
    }
    renderer.SetShadowCoarseness(1);
    Picture found;
    renderer.Render(last.view, found);
    ASSERT_EQ(found.rgba, last.Render().rgba) << "sequence " << seed;
  }
}
