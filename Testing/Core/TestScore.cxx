// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What is reported of an extinction: S, and which share of the important structures that the data
// has is seen and is removed. Against the independent march and closed forms.

#include "Tolerance.h"
#include "ViewScene.h"

#include "backend/HostDevice.h"
#include "optimize/PreparedScene.h"
#include "optimize/SolverBackend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
/// What a solver can make of an extinction: parts gone, parts as they were, parts much thicker.
std::vector<float> Changed(const BoxScene& scene)
{
  std::vector<float> changed = scene.extinction;
  const float most = *std::max_element(changed.begin(), changed.end());
  scene.ForEachNode(
    [&](std::size_t node, int i, int j, int k)
    {
      const int part = (i / 4 + j / 5 + k / 6) % 3;
      const bool thicker = part == 2 && changed[node] > 0; // what is empty stays empty
      changed[node] = part == 0 ? 0.0f : thicker ? most : changed[node];
    });
  return changed;
}

Score ScoreByMarch(const BoxScene& scene, const std::vector<float>& extinction)
{
  truth::Sampling sampling;
  sampling.raysPerVoxel = 4;
  const truth::Shares shares =
    truth::SharesOf(scene.TruthWith(extinction), scene.extinction.data(), scene.Eye(), sampling);
  return { scene.TrueScore(extinction), shares.visible, shares.removed };
}

Score ScoreOf(const BoxScene& scene, const std::vector<float>& extinction)
{
  PreparedScene prepared(scene.Fields());
  const Problem problem = prepared.ProblemFor(scene.camera, scene.light, scene.settings);
  return MakeSolverBackend(HostDevice::Shared())
    ->SweepsFrom(problem, problem.Camera())
    ->ScoreOf(extinction.data());
}

struct Place
{
  const char* name;
  Content content;
  std::function<void(BoxScene&)> put;
};

std::ostream& operator<<(std::ostream& stream, const Place& place)
{
  return stream << place.name;
}

void FromOutside(BoxScene& scene)
{
  scene.camera = OrbitOf(scene.grid, false).At(glm::normalize(Vec3(0.4, -0.3, 0.8)));
}

void Oblique(BoxScene& scene)
{
  scene.camera = OrbitOf(scene.grid, false).At(glm::normalize(Vec3(0.7, 0.6, 0.65)));
}

void Parallel(BoxScene& scene)
{
  scene.camera = OrbitOf(scene.grid, true).At(glm::normalize(Vec3(-0.9, 0.3, 0.2)));
}

void FromInside(BoxScene& scene)
{
  scene.camera.position = scene.grid.Centre() + 0.2 * scene.grid.Radius();
  scene.camera.focalPoint = scene.grid.Centre();
}

const Tolerance ofTheIssue{ 0.005, "the bar for fractions" };
}

class SeenBox : public ::testing::TestWithParam<Place>
{
};

TEST_P(SeenBox, HasTheFractionsOfTheMarch)
{
  BoxScene scene = Filled(GetParam().content);
  GetParam().put(scene);
  for (const std::vector<float>& extinction : { scene.extinction, Changed(scene) })
  {
    const Score expected = ScoreByMarch(scene, extinction);

    const Score found = ScoreOf(scene, extinction);

    EXPECT_WITHIN(found.visibility, expected.visibility,
      Relative(0.01, expected.visibility, "cuts from node to node, an image of 40 voxels"));
    EXPECT_WITHIN(found.fraction, expected.fraction, ofTheIssue);
    EXPECT_WITHIN(found.sacrificed, expected.sacrificed, ofTheIssue);
  }
}

TEST_P(SeenBox, TellsTheSameWhoeverIsAsked)
{
  BoxScene scene = Filled(GetParam().content);
  scene.settings.rayDensity = 4; // as scores of small volumes have
  GetParam().put(scene);
  for (const SolverKind solver : { SolverKind::Policy, SolverKind::Adam })
  {
    for (const Derivative derivative : { Derivative::Volume, Derivative::Ray })
    {
      scene.settings.solver = solver;
      scene.settings.derivative = derivative;
      scene.settings.iterationsPerLevel = { { 2, 2, 3 } };
      Solver solved = scene.MakeSolver();
      solved.Run();

      const Score again = ScoreOf(scene, solved.Extinction());

      // In float, in another order.
      EXPECT_WITHIN(
        solved.BestScore().visibility, again.visibility, Roundoff<float>(100, again.visibility));
      EXPECT_WITHIN(solved.BestScore().fraction, again.fraction, Roundoff<float>(100, 1));
      EXPECT_WITHIN(solved.BestScore().sacrificed, again.sacrificed, Roundoff<float>(100, 1));
      EXPECT_WITHIN(solved.History().front().score.sacrificed, 0, Roundoff<float>(100, 1));
    }
  }
}

TEST_P(SeenBox, HasTheFractionsOfTheMarchForASearch)
{
  BoxScene scene = Filled(GetParam().content);
  GetParam().put(scene);
  const std::vector<float> extinction = Changed(scene);
  const Score expected = ScoreByMarch(scene, extinction);

  const ViewScore score(
    scene.grid, { extinction.data(), scene.importance.data(), scene.extinction.data() }, 2);
  const Score found = score.At(scene.camera);

  EXPECT_WITHIN(found.fraction, expected.fraction, ofTheIssue);
  EXPECT_WITHIN(found.sacrificed, expected.sacrificed, ofTheIssue);
}

INSTANTIATE_TEST_SUITE_P(Boxes, SeenBox,
  ::testing::Values(Place{ "OnionFromOutside", Content::Onion, FromOutside },
    Place{ "WavesOblique", Content::Waves, Oblique },
    Place{ "BordersOblique", Content::Borders, Oblique },
    Place{ "BordersParallel", Content::Borders, Parallel },
    Place{ "BordersFromInside", Content::Borders, FromInside }),
  ::testing::PrintToStringParamName());

TEST(Score, OfABoxHasAClosedForm)
{
  // For a thin slab seen along its normal, T = exp(-mu x). So the visible share of the base a in an
  // extinction b >= a is (1 - exp(-b d)) / (b d); for b <= a it is b / a times that.
  BoxScene scene = BoxScene::Cube(17);
  scene.camera.parallel = true;
  scene.camera.position = scene.grid.Centre() + Vec3(0, 0, 5);
  scene.camera.focalPoint = scene.grid.Centre();
  const double depth = scene.grid.spacing.z * (scene.grid.nodes.z - 1);
  const double base = 0.7 / depth;
  scene.Fill(Everywhere(base), Everywhere(0.6));
  for (const double factor : { 0.0, 0.25, 1.0, 4.0, 100.0 })
  {
    const double b = factor * base;
    const std::vector<float> extinction(scene.extinction.size(), static_cast<float>(b));
    const double shown = factor > 0 ? -std::expm1(-b * depth) / (b * depth) : 1;

    const Score score = ScoreOf(scene, extinction);

    const double kept = std::min(factor, 1.0);
    EXPECT_WITHIN(score.fraction, kept * shown, Roundoff<float>(100, 1)) << factor;
    EXPECT_WITHIN(score.sacrificed, 1 - kept, Roundoff<float>(100, 1)) << factor;
  }
}

TEST(Score, IsZeroWithoutAnythingImportant)
{
  BoxScene scene = BoxScene::Cube(9);
  scene.Fill(Everywhere(1.0), Everywhere(0.0));

  const Score score = ScoreOf(scene, scene.extinction);

  EXPECT_EQ(score.visibility, 0);
  EXPECT_EQ(score.fraction, 0);
  EXPECT_EQ(score.sacrificed, 0);
}

TEST(Score, IsThatOfTheResultWithoutWeightOfTheView)
{
  BoxScene scene = Filled(Content::Onion);
  scene.settings.rayDensity = 4; // as scores of small volumes have
  scene.settings.weights.view = 0;
  Solver solver = scene.MakeSolver();
  solver.Run();

  const Score expected = ScoreOf(scene, solver.Extinction());

  EXPECT_NE(solver.Extinction(), scene.extinction);
  EXPECT_EQ(solver.BestScore().visibility, expected.visibility);
  EXPECT_EQ(solver.BestScore().fraction, expected.fraction);
  EXPECT_EQ(solver.BestScore().sacrificed, expected.sacrificed);
}
