// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Adam, scores of directions and the choice of a backend on devices.

#include "BoxScene.h"
#include "TestedDevice.h"
#include "ViewScene.h"

#include "math/Require.h"
#include "optimize/Adam.h"
#include "optimize/PreparedScene.h"
#include "optimize/SolverBackend.h"
#include "scene/ViewSet.h"
#include "viewpoint/ScoreSweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
BoxScene Onion()
{
  BoxScene scene({ 37, 30, 41 }, { 3, -2, 5 }, { 1.0, 1.3, 0.8 });
  scene.FillOnion();
  return scene;
}
}

// In the most opaque matter steps also begin at what a coarser grid finds.
TEST(PolicyOfDevice, IsThatOfTheProcessorInOpaqueMatter)
{
  BoxScene scene(Int3(49, 44, 42), Vec3(0.0), Vec3(1.0));
  scene.FillOnion(1000); // an optical depth of 26 from node to node
  PreparedScene prepared(scene.Fields());
  const Problem problem = prepared.ProblemFor(scene.camera, scene.light, scene.settings);
  const std::shared_ptr<SolverBackend> backend = MakeSolverBackend(MakeTestedDevice());
  const auto there = backend->MakeMinimizer(problem, {}, false);
  const auto here = MakeSolverBackend(HostDevice::Shared())->MakeMinimizer(problem, {}, false);
  there->Start();
  here->Start();

  const double found = there->Iterate().energy.Total();

  const double expected = here->Iterate().energy.Total();
  // Where a derivative is rounding noise, resilient steps follow its sign.
  EXPECT_NEAR(found / expected, 1, 1e-2);
}

TEST(AdamOfDevice, IsThatOfTheProcessor)
{
  BoxScene scene = Onion();
  scene.settings.solver = SolverKind::Adam;
  scene.settings.iterationsPerLevel = { { 2, 3, 4 } };
  scene.FillOnion(4);            // no layer is thick,
  scene.settings.rayDensity = 4; // so that iterations see what scores do
  PreparedScene prepared(scene.Fields());
  const Problem problem = prepared.ProblemFor(scene.camera, scene.light, scene.settings);
  const std::shared_ptr<SolverBackend> backend = MakeSolverBackend(MakeTestedDevice());
  const auto there = backend->MakeMinimizer(problem, std::vector<float>(scene.extinction), false);
  const auto here = MakeSolverBackend(HostDevice::Shared())
                      ->MakeMinimizer(problem, std::vector<float>(scene.extinction), false);

  EXPECT_NEAR(there->Start().score.visibility / here->Start().score.visibility, 1, 1e-5);
  for (int iteration = 0; iteration < 9; ++iteration)
  {
    const IterationRecord expected = here->Iterate();
    const IterationRecord found = there->Iterate();
    EXPECT_EQ(found.level, expected.level);
    EXPECT_NEAR(found.energy.Total() / expected.energy.Total(), 1, 1e-5);
    EXPECT_NEAR(found.meanChange, expected.meanChange, 1e-4 * expected.meanChange);
  }
  const std::vector<float> best = here->Best();
  const std::vector<float> bestThere = there->TakeBest();
  double squares = 0;
  for (std::size_t voxel = 0; voxel < best.size(); ++voxel)
  {
    squares += std::pow(double(best[voxel]) - double(bestThere[voxel]), 2);
  }
  // Root mean square: where a derivative is rounding noise, Adam follows its sign.
  EXPECT_LE(std::sqrt(squares / double(best.size())), 1e-4 * prepared.Majorant());
}

TEST(PolicyOfDevice, IsThatOfTheProcessorForSeveralViews)
{
  const BoxScene scene = Onion();
  const std::vector<Camera> cameras =
    CamerasOf({ ViewKind::Orbit, 3 }, scene.camera, OrbitStart::AtCamera);
  PreparedScene prepared(scene.Fields());
  const Problem problem =
    prepared.ProblemFor(scene.camera, scene.light, ForCameras(scene.settings, cameras));
  const std::shared_ptr<SolverBackend> backends[2] = { MakeSolverBackend(HostDevice::Shared()),
    MakeSolverBackend(MakeTestedDevice()) };
  std::vector<IterationRecord> records[2];
  Score scores[2];
  for (int i = 0; i < 2; ++i)
  {
    const auto policy = backends[i]->MakeMinimizer(problem, {}, false);
    records[i].push_back(policy->Start());
    for (int iteration = 0; iteration < 8; ++iteration)
    {
      records[i].push_back(policy->Iterate());
    }
    scores[i] = backends[i]->SweepsFromCameras(problem)->ScoreOf(policy->Best().data());
  }

  for (std::size_t i = 0; i < records[0].size(); ++i)
  {
    // A sweep decides by signs of differences, so that rounding moves whole voxels.
    EXPECT_NEAR(records[1][i].energy.Total() / records[0][i].energy.Total(), 1, 1e-3) << i;
    EXPECT_NEAR(records[1][i].score.fraction, records[0][i].score.fraction, 1e-3) << i;
  }
  EXPECT_NEAR(scores[1].visibility / scores[0].visibility, 1, 1e-3);
}

TEST(BackendOfDevice, ScoresLikeTheProcessor)
{
  const BoxScene scene = Onion();
  PreparedScene prepared(scene.Fields());
  const Problem problem = prepared.ProblemFor(scene.camera, scene.light, scene.settings);

  std::vector<float> other = scene.extinction; // thinner here and thicker there
  for (std::size_t node = 0; node < other.size(); ++node)
  {
    other[node] *= static_cast<float>(node % 7) / 3;
  }
  for (const float* extinction : { scene.extinction.data(), std::as_const(other).data() })
  {
    const Score found = MakeSolverBackend(MakeTestedDevice())
                          ->SweepsFrom(problem, problem.Camera())
                          ->ScoreOf(extinction);
    const Score expected = MakeSolverBackend(HostDevice::Shared())
                             ->SweepsFrom(problem, problem.Camera())
                             ->ScoreOf(extinction);

    EXPECT_NEAR(found.visibility, expected.visibility, 1e-5 * expected.visibility);
    EXPECT_NEAR(found.fraction, expected.fraction, 1e-5);
    EXPECT_NEAR(found.sacrificed, expected.sacrificed, 1e-5);
  }
}

TEST(BackendOfDevice, MakesTheSameFirstPassAndTransmittance)
{
  const BoxScene scene = Onion();
  PreparedScene prepared(scene.Fields());
  const Problem problem = prepared.ProblemFor(scene.camera, scene.light, scene.settings);
  const std::shared_ptr<SolverBackend> backends[2] = { MakeSolverBackend(HostDevice::Shared()),
    MakeSolverBackend(MakeTestedDevice()) };
  std::vector<float> extinction[2];
  std::vector<float> transmittance[2];

  for (int i = 0; i < 2; ++i)
  {
    extinction[i] = scene.extinction;
    transmittance[i].resize(scene.extinction.size());
    backends[i]->SweepsFrom(problem, problem.Light())->SweepPolicyOnce(1, extinction[i]);
    backends[i]->FindTransmittance(
      problem, problem.Camera(), 2, extinction[0].data(), transmittance[i].data());
  }

  for (std::size_t voxel = 0; voxel < scene.extinction.size(); ++voxel)
  {
    ASSERT_NEAR(extinction[0][voxel], extinction[1][voxel], 1e-4 * prepared.Majorant());
    ASSERT_NEAR(transmittance[0][voxel], transmittance[1][voxel], 1e-4);
  }
}

class ViewsOfDevice : public ::testing::TestWithParam<Case>
{
protected:
  const BoxScene Scene = Filled(GetParam().content);
  const ViewFields Fields{ Scene.grid, { Scene.extinction.data(), Scene.importance.data() } };
  const Orbit Around = OrbitOf(Scene.grid, GetParam().parallel);
  const std::unique_ptr<ScoreSweep> There = MakeScoreSweep(MakeTestedDevice(), Fields);
  const std::unique_ptr<ScoreSweep> Here = MakeScoreSweep(HostDevice::Shared(), Fields);
};

TEST_P(ViewsOfDevice, HaveTheScoresOfTheProcessor)
{
  for (const Vec3& direction : RandomDirections(10))
  {
    const Seen expected = this->Here->See(this->Fields.PartsOf(this->Around.At(direction), 2));
    const Seen found = this->There->See(this->Fields.PartsOf(this->Around.At(direction), 2));
    EXPECT_NEAR(found.all.visible, expected.all.visible, 1e-5 * expected.all.visible);
    EXPECT_NEAR(
      found.all.unattenuated, expected.all.unattenuated, 1e-5 * expected.all.unattenuated);
  }
}

TEST_P(ViewsOfDevice, HaveTheSlopesOfTheProcessor)
{
  for (const Vec3& direction : RandomDirections(3))
  {
    const Vec3 right = glm::normalize(glm::cross(direction, Vec3(0.3, 0.5, 0.8)));
    const EyeMoves moves{ { right, glm::cross(right, direction) }, this->Around.distance };
    std::vector<ViewFields::Part> parts = this->Fields.PartsOf(this->Around.At(direction), 2);
    std::vector<ViewFields::Part> same = this->Fields.PartsOf(this->Around.At(direction), 2);
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
      const ViewDerivative expected = this->Here->Differentiate(std::move(parts[i]), moves, 2);
      const ViewDerivative found = this->There->Differentiate(std::move(same[i]), moves, 2);
      const double visible = expected.score;
      EXPECT_NEAR(found.score, visible, 1e-5 * visible);
      for (int m = 0; m < 2; ++m)
      {
        // Rays gain and lose; what rounds is up to the size of a change by a turn of one radian.
        EXPECT_NEAR(found.slope[m], expected.slope[m], 1e-5 * visible / this->Around.distance);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, ViewsOfDevice,
  ::testing::Values(Case{ "Onion", Content::Onion, false },
    Case{ "Borders", Content::Borders, false }, Case{ "ParallelWaves", Content::Waves, true }),
  ::testing::PrintToStringParamName());

TEST(BackendChoice, SaysWhatItIsAndWhy)
{
  EXPECT_FALSE(ChooseBackend(BackendKind::Cpu, {}).cuda);
  const BackendChoice choice = ChooseBackend(BackendKind::Auto, {});
  EXPECT_EQ(choice.cuda, FindCuda().usable);
  if (FindCuda().usable)
  {
    EXPECT_NE(choice.name.find(FindCuda().name), std::string::npos);
    EXPECT_TRUE(ChooseBackend(BackendKind::Cuda, {}).cuda);
  }
  else
  {
    EXPECT_NE(choice.name.find("no CUDA: " + FindCuda().reason), std::string::npos) << choice.name;
    EXPECT_THROW(ChooseBackend(BackendKind::Cuda, {}), Error);
  }
}

TEST(BackendChoice, RefusesWhatDoesNotFit)
{
  const GpuNeed tooManyBytes{ 1, std::size_t(1) << 50 };
  const GpuNeed tooManyNodes{ Index(1) << 31, 1 };
  for (const GpuNeed& need : { tooManyBytes, tooManyNodes })
  {
    const BackendChoice choice = ChooseBackend(BackendKind::Auto, need);
    EXPECT_FALSE(choice.cuda);
    EXPECT_NE(choice.name.find("no CUDA"), std::string::npos) << choice.name;
    EXPECT_THROW(ChooseBackend(BackendKind::Cuda, need), Error);
  }
}
