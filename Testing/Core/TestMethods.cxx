// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The methods that the paper compares with, on scenes with closed forms: what they show and what
// that is worth by the same measure.

#include "BoxScene.h"
#include "TestedDevice.h"
#include "Tolerance.h"

#include "math/Require.h"
#include "methods/Ament2017.h"
#include "methods/RayObject.h"
#include "methods/WeighedMean.h"
#include "optimize/PreparedScene.h"
#include "optimize/Progressive.h"
#include "optimize/SolverBackend.h"
#include "render/FourFloats.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
constexpr double thickness = 3; // extinction of everything [1/length]
constexpr double width = 0.5;   // of the slabs [length]
constexpr double face = 4;      // of the cube [length^2]
const double radius = std::sqrt(3.0);

/// 1 inside, 0 outside, and a half on the border, which is one cell wide.
double Inside(double distanceToBorder, double cell)
{
  return std::min(std::max(0.5 + distanceToBorder / cell, 0.0), 1.0);
}

/// A cube seen along its last axis in parallel rays, with `cells` cells along each axis.
BoxScene ParallelCube(int cells)
{
  BoxScene scene = BoxScene::Cube(cells + 1);
  scene.camera.parallel = true;
  scene.camera.position = { 0, 0, -4 };
  scene.camera.focalPoint = { 0, 0, 0 };
  scene.light.type = LightType::Directional;
  scene.light.position = { 0, 0, -4 };
  scene.settings.ament.smoothingPasses = 0;
  scene.settings.ament.occluders = 30;
  return scene;
}

/// How far importance reaches beyond what is important, so that borders are important, too [cells].
constexpr double margin = 1;

/// The integral of squared importance through a slab: squares at the nodes, 1 on the border of the
/// slab and a quarter a cell outside.
double SquaredImportance(double cell)
{
  return width + 1.5 * cell;
}

/// An important slab behind what has `widthInFront(x)` in front of it; from z = 0.25 on.
BoxScene SlabBehind(int cells, const std::function<double(double)>& widthInFront)
{
  BoxScene scene = ParallelCube(cells);
  const double cell = 2.0 / cells;
  const auto slab = [=](const Vec3& x, double reach)
  { return Inside(std::min(x.z - 0.25, 0.25 + width - x.z) + reach, cell); };
  scene.Fill(
    [=](const Vec3& x)
    {
      const double end = -0.75 + widthInFront(x.x);
      const double front = end > -0.75 ? Inside(x.z + 0.75, cell) * Inside(end - x.z, cell) : 0.0;
      return thickness * std::min(front + slab(x, 0), 1.0);
    },
    [=](const Vec3& x) { return slab(x, margin * cell); });
  return scene;
}

BoxScene TwoSlabs(int cells)
{
  return SlabBehind(cells, [](double) { return width; });
}

BoxScene Wedge(int cells)
{
  return SlabBehind(cells, [](double x) { return 0.4 * (x + 1); });
}

constexpr double coreRadius = 0.35;

/// An important ball inside an unimportant shell.
BoxScene NestedShells(int cells)
{
  BoxScene scene = ParallelCube(cells);
  const double cell = 2.0 / cells;
  const auto core = [=](const Vec3& x, double reach)
  { return Inside(coreRadius - glm::length(x) + reach, cell); };
  scene.Fill(
    [=](const Vec3& x)
    {
      const double r = glm::length(x);
      return thickness * std::min(core(x, 0) + Inside(std::min(r - 0.6, 0.8 - r), cell), 1.0);
    },
    [=](const Vec3& x) { return core(x, margin * cell); });
  return scene;
}

struct Shown
{
  double score;
  double energy;
  std::vector<float> extinction;
  std::vector<float> lightExtinction;
};

Shown ShownBy(Method method, BoxScene& scene)
{
  scene.settings.method = method;
  Solver solver = scene.MakeSolver();
  solver.Run();
  return { solver.BestScore().visibility, solver.BestEnergy().Total(), solver.Extinction(),
    solver.LightExtinction() };
}

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
  const double pi = 3.14159265358979;
  const double bare =
    pi * a * a - 2 * pi * (1 - std::exp(-2 * m * a) * (1 + 2 * m * a)) / (4 * m * m);

  EXPECT_WITHIN(ShownBy(Method::Viola2004, scene).score, bare,
    Relative(0.01, bare, "the border of the ball is a cell wide, second order in it"));
  EXPECT_LT(ShownBy(Method::Ordinary, scene).score, 0.7 * bare);
}

TEST(Ament2017, KeepsTheShareOfTheClosedForm)
{
  BoxScene scene = NestedShells(64);
  scene.settings.ament.background = 7;
  scene.settings.ament.exponent = 1.5;
  const Shown shown = ShownBy(Method::Ament2017, scene);
  const double chord = (2 * coreRadius + 1.5 * scene.grid.spacing.z) / radius;
  const auto keptAt = [&](const Vec3& position)
  {
    const Vec3 index = scene.grid.PointToIndex(position) + 0.5;
    const std::size_t node =
      std::size_t(index.x) + 65 * (std::size_t(index.y) + 65 * std::size_t(index.z));
    return double(shown.extinction[node]) / double(scene.extinction[node]);
  };
  const Tolerance cell = Relative(0.01, 1, "the border of the ball is a cell wide");

  EXPECT_WITHIN(keptAt({ 0, 0, -0.7 }), 1 / (1 + 30 * chord), cell); // hides it
  EXPECT_WITHIN(keptAt({ 0, 0, 0.7 }), 1 / (1 + 7 * chord), cell);   // lies behind it
  EXPECT_EQ(keptAt({ 0, 0, 0 }), 1);                                 // is it
  EXPECT_EQ(keptAt({ 0.7, 0, 0 }), 1);                               // has nothing to do with it
}

// The march integrates squared importance, linear between nodes, in double precision: from the
// camera on in front, and from the other end of parallel rays behind.
TEST(Ament2017, AgreesWithAMarchAlongObliqueRays)
{
  BoxScene scene({ 33, 27, 30 }, { 3, -2, 5 }, { 1.0, 1.2, 1.1 });
  scene.FillOnion();
  scene.camera.parallel = true;
  scene.settings.ament.background = 7;
  scene.settings.ament.smoothingPasses = 0;
  scene.settings.ament.occluders = 30;
  scene.settings.rayDensity = 2;
  const Shown shown = ShownBy(Method::Ament2017, scene);
  std::vector<float> squares = scene.importance;
  for (float& value : squares)
  {
    value *= value;
  }
  const truth::Volume<float> volume = scene.TruthWith(squares);
  const truth::Source back =
    truth::Source::Parallel(ToTruth(scene.camera.position - scene.camera.focalPoint));
  double error = 0;
  int count = 0;

  scene.ForEachNode(
    [&](std::size_t node, int i, int j, int k)
    {
      if (scene.extinction[node] > 0)
      {
        const truth::Vector here = ToTruth(scene.grid.PointToWorld(Vec3(i, j, k)));
        const double size = scene.grid.Radius();
        const double load = std::pow(1 - double(scene.importance[node]), 2) *
          (7 * truth::OpticalDepth(volume, scene.Eye(), here) / size +
            30 * truth::OpticalDepth(volume, back, here) / size);
        const double share = double(shown.extinction[node]) / double(scene.extinction[node]);
        error += std::pow(share - 1 / (1 + load), 2);
        ++count;
      }
    });

  EXPECT_WITHIN(std::sqrt(error / count), 0.0,
    Relative(0.01, 1, "rays and the means over them, second order, 30 cells across"));
}

TEST(Ament2017, LetsWhatIsHalfImportantGiveWayByItsExponent)
{
  const AmentKeptShare kept{ 2 * 1.5f, 2, 30, 7 };

  const float share = kept(0.5f, 0.2f, 0.4f);

  const double load = std::pow(0.5, 3) * (7 * 0.2 + 30 * 0.4);
  EXPECT_WITHIN(share, 2 / (2 + load), Roundoff<float>(8, 1.0));
}

TEST(Ament2017, IsOrdinaryBitForBitWithoutImportance)
{
  BoxScene scene({ 17, 21, 13 }, { 3, -2, 5 }, { 1.0, 1.3, 0.8 });
  scene.FillOnion();
  scene.settings.ament.smoothingPasses = 3;
  scene.settings.ament.background = 10;
  std::fill(scene.importance.begin(), scene.importance.end(), 0.0f);

  const Shown shown = ShownBy(Method::Ament2017, scene);

  EXPECT_EQ(shown.extinction, scene.extinction);
  EXPECT_EQ(shown.lightExtinction, scene.extinction);
}

TEST(Ament2017, IsOrdinaryBitForBitWhereNothingImportantIsOnTheWay)
{
  BoxScene scene = NestedShells(32);
  scene.settings.ament.smoothingPasses = 0;
  scene.settings.ament.background = 10;

  const Shown shown = ShownBy(Method::Ament2017, scene);

  scene.ForEachNode(
    [&](std::size_t node, int i, int j, int)
    {
      const double across = std::hypot(i - 16, j - 16) / 16;
      if (across > coreRadius + 0.25) // the border of the ball and what the means of rays read
      {
        EXPECT_EQ(shown.extinction[node], scene.extinction[node]);
      }
    });
}

TEST(Ament2017, ClearsForTheLightAsForACameraInItsPlace)
{
  BoxScene scene({ 17, 21, 13 }, { 3, -2, 5 }, { 1.0, 1.3, 0.8 });
  scene.FillOnion();
  const Shown shown = ShownBy(Method::Ament2017, scene);
  scene.camera.position = scene.light.position;

  const Shown fromThere = ShownBy(Method::Ament2017, scene);

  const float most = *std::max_element(scene.extinction.begin(), scene.extinction.end());
  for (std::size_t node = 0; node < scene.extinction.size(); ++node)
  {
    // The fields may lie in another order, so sums are rounded in another one.
    EXPECT_NEAR(shown.lightExtinction[node], fromThere.extinction[node], 1e-5 * most);
  }
}

TEST(Ament2017, KeepsEverySmoothedShareBetweenThoseOfItsNeighbours)
{
  BoxScene scene = BoxScene::Cube(21);
  scene.FillOnion();
  scene.settings.ament.smoothingPasses = 0;
  const Shown rough = ShownBy(Method::Ament2017, scene);
  scene.settings.ament.smoothingPasses = 1;

  const Shown smooth = ShownBy(Method::Ament2017, scene);

  scene.ForEachNode(
    [&](std::size_t node, int i, int j, int k)
    {
      if (!(scene.extinction[node] > 0))
      {
        return;
      }
      float least = 1;
      float most = 0;
      for (int n = 0; n < 27; ++n)
      {
        const Int3 at(i + n % 3 - 1, j + n / 3 % 3 - 1, k + n / 9 - 1);
        const bool inside =
          at.x >= 0 && at.y >= 0 && at.z >= 0 && at.x < 21 && at.y < 21 && at.z < 21;
        const std::size_t other =
          inside ? std::size_t(at.x) + 21 * (std::size_t(at.y) + 21 * std::size_t(at.z)) : node;
        if (scene.extinction[other] > 0)
        {
          const float share = rough.extinction[other] / scene.extinction[other];
          least = std::min(least, share);
          most = std::max(most, share);
        }
      }
      const float share = smooth.extinction[node] / scene.extinction[node];
      EXPECT_GE(share, least - 1e-6f);
      EXPECT_LE(share, most + 1e-6f);
    });
}

TEST(Viola2004, ClearsWhatIsInFrontOfTheObjectAndNothingElse)
{
  BoxScene scene = TwoSlabs(32);

  const Shown shown = ShownBy(Method::Viola2004, scene);

  scene.ForEachNode(
    [&](std::size_t node, int, int, int k)
    {
      const double z = -1 + k / 16.0;
      if (z < 0.1)
      {
        EXPECT_EQ(shown.extinction[node], 0.0f);
      }
      else if (z > 0.4)
      {
        EXPECT_EQ(shown.extinction[node], scene.extinction[node]);
      }
    });
}

TEST(Viola2004, ClipsNothingWhereThereIsNoObject)
{
  BoxScene scene = TwoSlabs(32);
  for (float& value : scene.importance)
  {
    value *= 0.49f;
  }

  EXPECT_EQ(ShownBy(Method::Viola2004, scene).extinction, scene.extinction);
}

TEST(RayObject, IsTheMostImportantOneFromItsBorderOn)
{
  RayObject object;
  const float importance[] = { 0, 0.6f, 0.2f, 0.25f, 0.75f, 1.0f, 0, 0.9f };
  for (int i = 0; i < 8; ++i)
  {
    object.Meet(static_cast<float>(i), importance[i]);
  }

  EXPECT_EQ(object.most, 1.0f);
  EXPECT_EQ(object.begin, 3.5f); // half way from 0.25 to 0.75
}

TEST(RayObject, IsTheForemostOfEqualOnes)
{
  RayObject object;
  for (const float at : { 0.0f, 1.0f, 2.0f, 3.0f, 4.0f })
  {
    object.Meet(at, static_cast<int>(at) % 2 == 1 ? 0.8f : 0.2f);
  }

  EXPECT_EQ(object.begin, 0.5f);
}

TEST(RayObject, ClipsNothingWhereTheRayBeginsInsideIt)
{
  RayObject object;
  object.Meet(2, 0.9f);
  object.Meet(3, 0.1f);

  EXPECT_EQ(object.begin, RayObject::everything);
}

TEST(WeighedMean, IsTheMeanColourByImportanceOverTheBackground)
{
  WeighedMean<FourFloats> mean;
  mean.Add(1.0f, 0.3f, 1, { 0, 1, 0, 0 });
  mean.Add(0.5f, 0.2f, 0.5f, { 0, 0, 1, 0 });
  mean.Add(0.0f, 5.0f, 1, { 0, 0, 0, 1 });
  const double weights = 1 * 0.3 + 0.5 * 0.2;
  const double opacity = 1 - std::exp(-5.5);

  const FourFloats light = mean.Light();

  EXPECT_WITHIN(light[1], opacity * 0.3 / weights, Roundoff<float>(8, 1.0));
  EXPECT_WITHIN(light[2], opacity * 0.5 * 0.1 / weights, Roundoff<float>(8, 1.0));
  EXPECT_EQ(light[3], 0.0f);
  EXPECT_WITHIN(mean.Transmittance(), std::exp(-5.5), Roundoff<float>(8, 1.0));
}

TEST(WeighedMean, TakesAllSamplesAsEquallyImportantWhereNoneIs)
{
  WeighedMean<FourFloats> mean;
  mean.Add(0, 0.3f, 1, { 0, 1, 0, 0 });
  mean.Add(0, 0.1f, 1, { 0, 0, 1, 0 });

  const FourFloats light = mean.Light();

  EXPECT_WITHIN(light[1], (1 - std::exp(-0.4)) * 0.75, Roundoff<float>(8, 1.0));
  EXPECT_WITHIN(light[2], (1 - std::exp(-0.4)) * 0.25, Roundoff<float>(8, 1.0));
}

TEST(WeighedMean, IsNothingOnAnEmptyRay)
{
  const FourFloats light = WeighedMean<FourFloats>().Light();

  EXPECT_EQ(light[1], 0.0f);
}

TEST(WeighedMean, SharesOpacityEquallyAtEveryDepth)
{
  for (double depth = 1e-6; depth < 1e5; depth *= 1.7)
  {
    EXPECT_WITHIN(EqualTransmittance(static_cast<float>(depth)),
      -std::expm1(-double(float(depth))) / double(float(depth)), Roundoff<float>(8, 1.0));
  }
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
    EXPECT_NEAR(there->SweepsFrom(problem, problem.camera)->ScoreOf(found.data()).visibility,
      here->SweepsFrom(problem, problem.camera)->ScoreOf(expected.data()).visibility,
      1e-4 * here->SweepsFrom(problem, problem.camera)->ScoreOf(expected.data()).visibility);
  }
}

TEST_P(EveryMethod, TellsWhatAMarchSeesOfItsExtinction)
{
  if (GetParam() == Method::Marchesin2010)
  {
    GTEST_SKIP() << "its score is not one of transport";
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
  EXPECT_TRUE(solver.TellsScores());
  EXPECT_TRUE(solver.Settled());
  const IterationRecord& record = solver.History()[1];
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
    GTEST_SKIP() << "its score is not one of transport";
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

TEST(AmentWeights, SayWhatIsWrong)
{
  const auto refused = [](auto set)
  {
    Settings settings;
    set(settings.ament);
    EXPECT_THROW(settings.Require(), Error);
  };
  refused([](AmentWeights& weights) { weights.regularization = 0; });
  refused([](AmentWeights& weights) { weights.exponent = -1; });
  refused([](AmentWeights& weights) { weights.occluders = std::nan(""); });
  refused(
    [](AmentWeights& weights) { weights.background = std::numeric_limits<double>::infinity(); });
  refused([](AmentWeights& weights) { weights.smoothingPasses = -1; });
  refused([](AmentWeights& weights) { weights.lightOccluders = -2; });
  refused([](AmentWeights& weights) { weights.lightBackground = -2; });
}
