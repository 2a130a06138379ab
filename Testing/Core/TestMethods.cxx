// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The methods that the paper compares with, on scenes with closed forms: what they show and what
// that is worth by the same measure.

#include "MethodScenes.h"
#include "TestedDevice.h"
#include "Tolerance.h"

#include "optimize/PreparedScene.h"
#include "optimize/Progressive.h"
#include "optimize/SolverBackend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
double Absorbed(double length)
{
  return 1 - std::exp(-thickness * length);
}

/// The mean over the width of the cube of a function of x.
double MeanAcross(const std::function<double(double)>& value)
{
  constexpr int count = 2000;
  double sum = 0;
  for (int i = 0; i < count; ++i)
  {
    sum += value(-1 + (2 * i + 1.0) / count) / count;
  }
  return sum;
}

/// Scores of an important slab behind a way of `inFront(x)` that is not important, by the closed
/// forms of all methods.
void ExpectScoresOfSlab(BoxScene scene, const std::function<double(double)>& inFront)
{
  const AmentWeights& ament = scene.settings.ament;
  const double behind = SquaredImportance(scene.grid.spacing.z) / radius;
  const double keptOfFront =
    ament.regularization / (ament.regularization + ament.occluders * behind);
  const auto transport = [&](double kept)
  {
    return MeanAcross([&](double x) { return std::exp(-thickness * kept * inFront(x)); }) * face *
      Absorbed(width);
  };
  const double equal = face * thickness * width *
    MeanAcross(
      [&](double x)
      {
        const double all = inFront(x) + width;
        return Absorbed(all) / (thickness * all);
      });
  const struct
  {
    Method method;
    double score;
  } expected[] = { { Method::Ordinary, transport(1) }, { Method::Viola2004, transport(0) },
    { Method::Marchesin2010, equal }, { Method::Ament2017, transport(keptOfFront) } };

  for (const auto& closed : expected)
  {
    SCOPED_TRACE(InfoOf(closed.method).name);
    EXPECT_WITHIN(ShownBy(closed.method, scene).score, closed.score,
      Relative(0.01, closed.score, "borders of slabs are a cell wide, second order in it"));
  }
}
}

TEST(Methods, ScoreTwoSlabsAsTheirClosedForms)
{
  ExpectScoresOfSlab(TwoSlabs(64), [](double) { return width; });
}

TEST(Methods, ScoreAWedgeAsTheirClosedForms)
{
  ExpectScoresOfSlab(Wedge(64), [](double x) { return 0.4 * (x + 1); });
}

TEST(Methods, ScoreNestedShellsAsTheirClosedForms)
{
  BoxScene scene = NestedShells(96);
  // The integral of 1 - exp(-2 m u) over the disc, with u half the chord: 2 pi u du.
  const double a = coreRadius;
  const double m = thickness;
  const double bare =
    pi * a * a - 2 * pi * (1 - std::exp(-2 * m * a) * (1 + 2 * m * a)) / (4 * m * m);

  EXPECT_WITHIN(ShownBy(Method::Viola2004, scene).score, bare,
    Relative(0.01, bare, "the border of the ball is a cell wide, second order in it"));
  EXPECT_LT(ShownBy(Method::Ordinary, scene).score, 0.7 * bare);
}

class EveryMethod : public testing::TestWithParam<Method>
{
};

TEST_P(EveryMethod, GivesTheSameOnADevice)
{
  BoxScene scene({ 37, 30, 41 }, { 3, -2, 5 }, { 1.0, 1.3, 0.8 });
  scene.FillOnion();
  scene.settings.method = GetParam();
  PreparedScene prepared(scene.Fields());
  Problem problem = prepared.ProblemFor(scene.camera, scene.light, scene.settings);
  const std::shared_ptr<SolverBackend> there = MakeSolverBackend(MakeTestedDevice());
  const std::shared_ptr<SolverBackend> here = MakeSolverBackend(HostDevice::Shared());
  for (const bool forLight : { false, true })
  {
    problem.forLight = forLight;
    std::vector<float> found = scene.extinction;
    std::vector<float> expected = scene.extinction;

    there->FindByMethod(problem, found);
    here->FindByMethod(problem, expected);

    for (std::size_t node = 0; node < found.size(); ++node)
    {
      EXPECT_NEAR(found[node], expected[node], 1e-4 * prepared.Majorant()) << node;
    }
    EXPECT_NEAR(there->SweepsFrom(problem, problem.Camera())->ScoreOf(found.data()).visibility,
      here->SweepsFrom(problem, problem.Camera())->ScoreOf(expected.data()).visibility,
      1e-4 * here->SweepsFrom(problem, problem.Camera())->ScoreOf(expected.data()).visibility);
  }
}

TEST_P(EveryMethod, TellsWhatAMarchSeesOfItsExtinction)
{
  if (GetParam() == Method::Marchesin2010)
  {
    GTEST_SKIP() << "the score of this method is not computed by light transport";
  }
  BoxScene scene = BoxScene::Cube(33);
  scene.FillOnion(6);

  const Shown shown = ShownBy(GetParam(), scene);

  const double truth = scene.TrueScore(shown.extinction);
  EXPECT_WITHIN(
    shown.score, truth, Relative(0.01, truth, "rays and samples, second order, 32 cells across"));
}

TEST_P(EveryMethod, IsDoneAfterOnePassAndTellsScoreAndEnergy)
{
  BoxScene scene = BoxScene::Cube(21);
  scene.FillOnion();
  scene.settings.method = GetParam();
  scene.settings.smoothness = 0.2;
  scene.settings.importanceSmoothing = ImportanceSmoothing::Median;
  Solver solver = scene.MakeSolver();

  solver.Run();

  ASSERT_EQ(solver.History().size(), InfoOf(GetParam()).hasLightExtinction ? 4u : 2u);
  EXPECT_TRUE(solver.Settled());
  const IterationRecord& record = solver.History()[1];
  EXPECT_GT(record.score.visibility, 0);
  EXPECT_EQ(record.score.visibility, solver.BestScore().visibility);
  EXPECT_EQ(record.energy.view, -10 * solver.BestScore().visibility);
  EXPECT_EQ(record.energy.Total(), solver.BestEnergy().Total());
  EXPECT_EQ(solver.History()[0].score.visibility, solver.BaseScore().visibility);
}

TEST_P(EveryMethod, ShowsNoMoreThanTheOptimum)
{
  BoxScene scene = BoxScene::Cube(25);
  scene.FillOnion();
  if (GetParam() == Method::Marchesin2010)
  {
    GTEST_SKIP() << "the score of this method is not computed by light transport";
  }

  const Shown shown = ShownBy(GetParam(), scene);
  const Shown optimum = ShownBy(Method::Optimized, scene);

  EXPECT_LT(shown.score, optimum.score);
  EXPECT_LT(optimum.energy, shown.energy);
}

TEST_P(EveryMethod, PreviewsAndRefinesToWhatItShows)
{
  BoxScene scene = BoxScene::Cube(25);
  scene.FillOnion();
  const Shown shown = ShownBy(GetParam(), scene);
  const Grid grid = scene.grid;
  Progressive progressive(scene.Fields(), scene.settings);
  progressive.SetView(scene.camera, scene.light, scene.settings);

  progressive.Preview(10);
  const Score preview = progressive.BestScore();
  while (!progressive.Refine())
  {
  }

  EXPECT_GT(preview.visibility, 0);
  EXPECT_EQ(progressive.BestScore().visibility, shown.score);
  const float* found = progressive.Extinction();
  EXPECT_EQ(std::vector<float>(found, found + grid.NodeCount()), shown.extinction);
}

TEST_P(EveryMethod, WorksOnScenesAtTheEdge)
{
  for (const double depth : { 1e-6, 1e6 })
  {
    for (const Int3 nodes : { Int3(2, 2, 2), Int3(2, 9, 3), Int3(1, 5, 5) })
    {
      BoxScene scene(nodes, { 1e7, 0, 0 }, { 1e-3, 1, 1 });
      scene.Fill(Everywhere(depth), Everywhere(1));
      scene.camera.position = scene.grid.Centre();
      scene.camera.focalPoint = scene.grid.Centre() + Vec3(0, 0, 1);

      const Shown shown = ShownBy(GetParam(), scene);

      EXPECT_TRUE(std::isfinite(shown.score) && shown.score >= 0);
      for (const float value : shown.extinction)
      {
        EXPECT_TRUE(value >= 0 && value <= float(depth)) << value;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod,
  testing::Values(Method::Ordinary, Method::Viola2004, Method::Marchesin2010, Method::Ament2017),
  [](const testing::TestParamInfo<Method>& tested)
  {
    std::string name = InfoOf(tested.param).name;
    name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
    return name;
  });
