// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Extinction and viewpoint together.

#include "BoxScene.h"
#include "LoadedScene.h"
#include "Tolerance.h"

#include "viewpoint/Concurrent.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>

using namespace limpid;

namespace
{
/// A ball of importance in the middle of a box that is thick everywhere but on the side of +x.
BoxScene OpenOnOneSide()
{
  BoxScene scene({ 33, 33, 33 }, { -1, -1, -1 }, Vec3(2.0 / 32));
  const auto ball = [](const Vec3& x) { return glm::length(x) < 0.3 ? 1.0 : 0.0; };
  scene.Fill(
    [=](const Vec3& x) {
      return ball(x) > 0 ? 4.0 : (x.x > 0.5 * glm::length(x) || glm::length(x) > 0.95 ? 0.0 : 3.0);
    },
    ball);
  scene.settings.weights.view = 0; // extinction stays as it is: the viewpoint alone decides
  scene.settings.weights.light = 0;
  return scene;
}

std::string NameOf(Guide guide)
{
  const char* const names[] = { "Proxy", "Extinction", "Attainable" };
  return names[static_cast<int>(guide)];
}

ConcurrentResult Optimize(const BoxScene& scene, Guide guide, const Progress& progress = {})
{
  SceneFields fields;
  fields.grid = scene.grid;
  fields.baseExtinction = scene.extinction.data();
  fields.importance = scene.importance.data();
  return OptimizeConcurrently(fields, scene.camera, scene.light, scene.settings, guide, progress);
}
}

class ConcurrentGuide : public ::testing::TestWithParam<Guide>
{
};

TEST_P(ConcurrentGuide, NeverEndsBelowItsFirstCamera)
{
  BoxScene scene({ 29, 35, 31 }, { 3, -5, 10 }, { 1.0, 0.8, 1.1 });
  scene.FillOnion(20);
  for (const bool parallel : { false, true })
  {
    scene.camera.parallel = parallel;
    scene.camera.parallelScale = scene.grid.Radius();
    Solver alone = scene.MakeSolver();
    alone.Run();

    const ConcurrentResult result = Optimize(scene, GetParam());

    ASSERT_TRUE(result.solver);
    const bool byShare = GetParam() == Guide::Attainable;
    const auto worth = [byShare](const Score& score)
    { return byShare ? score.fraction : score.visibility; };
    ASSERT_TRUE(byShare || result.startScore);
    if (result.startScore)
    {
      EXPECT_EQ(result.startScore->visibility, alone.BestScore().visibility);
    }
    EXPECT_GE(worth(result.solver->BestScore()), worth(alone.BestScore()));
    EXPECT_EQ(result.path.front(), scene.camera.position);
    EXPECT_EQ(result.path.back(), result.camera.position);
    EXPECT_EQ(result.camera.focalPoint, scene.camera.focalPoint);
    const double distance = glm::length(scene.camera.position - scene.camera.focalPoint);
    for (const Vec3& position : result.path)
    {
      EXPECT_WITHIN(glm::length(position - scene.camera.focalPoint), distance,
        Relative(1e-12, distance, "a sphere round the focal point"));
    }
  }
}

TEST_P(ConcurrentGuide, IsStoppedWithTheBestSoFar)
{
  BoxScene scene({ 21, 21, 21 }, { -1, -1, -1 }, Vec3(0.1));
  scene.FillOnion(20);
  int calls = 0;

  const ConcurrentResult result =
    Optimize(scene, GetParam(), [&](double, const std::string&) { return ++calls < 3; });

  ASSERT_TRUE(result.solver);
  EXPECT_LE(calls, 4);
  EXPECT_EQ(result.camera.position, result.path.back());
}

INSTANTIATE_TEST_SUITE_P(Guides, ConcurrentGuide,
  ::testing::Values(Guide::Proxy, Guide::Extinction, Guide::Attainable),
  [](const auto& guide) { return NameOf(guide.param); });

TEST(Concurrent, FindsTheOpenSideByTheCeilingWhatCannotBeRemoved)
{
  BoxScene scene = OpenOnOneSide();
  scene.camera.position = Vec3(-3, 0.5, -1.2); // behind what is thick
  scene.camera.focalPoint = Vec3(0);
  for (std::size_t node = 0; node < scene.importance.size(); ++node)
  {
    scene.importance[node] =
      std::max(scene.importance[node], scene.extinction[node] > 0 ? 0.3f : 0.0f);
  }
  scene.settings.protectImportance = 1;

  const ConcurrentResult result = Optimize(scene, Guide::Attainable);

  const auto towards = [](const Vec3& position) { return position.x / glm::length(position); };
  EXPECT_GT(towards(result.camera.position), 0.5);
  EXPECT_FALSE(result.Proof().empty());
}

TEST(Concurrent, FollowsTheExtinctionToTheOpenSide)
{
  BoxScene scene = OpenOnOneSide();
  scene.camera.position = Vec3(1.2, 0.5, -3.2);
  scene.camera.focalPoint = Vec3(0);

  const ConcurrentResult result = Optimize(scene, Guide::Extinction);

  const auto towards = [](const Vec3& position) { return position.x / glm::length(position); };
  EXPECT_GT(towards(result.camera.position), towards(scene.camera.position) + 0.2);
  EXPECT_GT(result.solver->BestScore().visibility, 1.2 * result.startScore->visibility);
}

TEST(Concurrent, KeepsTheCameraWhereNothingIsImportant)
{
  BoxScene scene({ 9, 9, 9 }, { 0, 0, 0 }, Vec3(1));
  scene.Fill([](const Vec3&) { return 1.0; }, [](const Vec3&) { return 0.0; });
  for (const Guide guide : { Guide::Proxy, Guide::Extinction, Guide::Attainable })
  {
    const ConcurrentResult result = Optimize(scene, guide);

    EXPECT_EQ(result.camera.position, scene.camera.position);
  }
}

class ConcurrentScene : public RealScene
{
};

TEST_P(ConcurrentScene, EndsAtOrAboveTheExtinctionAlone)
{
  const LoadedScene scene(GetParam().name);
  SceneFields fields;
  fields.grid = scene.grid;
  fields.baseExtinction = scene.file.extinction.data();
  fields.importance = scene.file.importance.data();
  for (const Guide guide : { Guide::Proxy, Guide::Extinction })
  {
    const ConcurrentResult result =
      OptimizeConcurrently(fields, scene.camera, scene.light, scene.settings, guide, {});

    std::cout << GetParam().name << ", " << NameOf(guide) << ": " << result.startScore->visibility
              << " -> " << result.solver->BestScore().visibility << ", " << result.path.size()
              << " cameras\n";
    EXPECT_GE(result.solver->BestScore().visibility, result.startScore->visibility);
  }
}

TEST_P(ConcurrentScene, GoesToTheHighestCeiling)
{
  const LoadedScene scene(GetParam().name);
  SceneFields fields;
  fields.grid = scene.grid;
  fields.baseExtinction = scene.file.extinction.data();
  fields.importance = scene.file.importance.data();

  const ConcurrentResult result =
    OptimizeConcurrently(fields, scene.camera, scene.light, scene.settings, Guide::Attainable, {});

  Solver alone(fields, scene.camera, scene.light, scene.settings);
  alone.Run();
  const double found = result.solver->BestScore().fraction;
  std::cout << GetParam().name << ": visible " << alone.BestScore().fraction << " -> " << found
            << ". " << result.Proof() << "\n";
  EXPECT_GE(found, alone.BestScore().fraction);
  EXPECT_LE(found, result.highestCeiling);
}

INSTANTIATE_TEST_SUITE_P(Quick, ConcurrentScene, ::testing::Values(Bars{ "carotid_mra", 0, 0 }),
  ::testing::PrintToStringParamName());

INSTANTIATE_TEST_SUITE_P(Long, ConcurrentScene,
  ::testing::Values(Bars{ "isabel_wind", 0, 0 }, Bars{ "visible_male", 0, 0 },
    Bars{ "engine", 0, 0 }, Bars{ "thorax_ct", 0, 0 }, Bars{ "vortex_rings", 0, 0 },
    Bars{ "skull_phantom", 0, 0 }),
  ::testing::PrintToStringParamName());
