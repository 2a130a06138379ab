// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What keeps an extinction near a previous one: its energy, its minimum, and what comes of it.

#include "BoxScene.h"
#include "TestedDevice.h"
#include "Tolerance.h"

#include "math/Require.h"
#include "optimize/CarriedChange.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using namespace limpid;

namespace
{
float MajorantOf(const BoxScene& scene)
{
  return *std::max_element(scene.extinction.begin(), scene.extinction.end());
}

/// Any extinction of a scene's matter.
std::vector<float> AnyExtinction(const BoxScene& scene)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<float> share(0, MajorantOf(scene));
  std::vector<float> values(scene.extinction.size());
  for (std::size_t node = 0; node < values.size(); ++node)
  {
    const bool empty = scene.extinction[node] == 0 && scene.importance[node] == 0;
    values[node] = empty ? 0.0f : share(random);
  }
  return values;
}

/// As if it had been found for the scene's view.
CarriedChange ChangeFrom(const BoxScene& scene, const std::vector<float>& extinction)
{
  CarriedChange change;
  change.grid = scene.grid;
  change.ofExtinction =
    ChangeOf(scene.grid.NodeCount(), scene.extinction.data(), extinction.data(), MajorantOf(scene));
  change.camera = scene.camera;
  change.light = scene.light;
  change.settings = scene.settings;
  return change;
}

/// The weight of (mu - mu_previous)^2 / 2 [length].
double CoherenceWeightOf(const BoxScene& scene)
{
  const Weights& weights = scene.settings.weights;
  return scene.settings.temporalCoherence * (weights.view + weights.light) / MajorantOf(scene);
}

Solver RunNear(const BoxScene& scene, const std::vector<float>& previous)
{
  Solver solver(
    scene.Fields(), scene.camera, scene.light, scene.settings, ChangeFrom(scene, previous));
  solver.Run();
  return solver;
}

double MeanDistance(const std::vector<float>& one, const std::vector<float>& other)
{
  double sum = 0;
  for (std::size_t node = 0; node < one.size(); ++node)
  {
    sum += std::abs(double(one[node]) - double(other[node]));
  }
  return sum / double(one.size());
}

class EverySolver : public ::testing::TestWithParam<SolverKind>
{
protected:
  BoxScene Scene() const
  {
    BoxScene scene = BoxScene::Onion();
    scene.settings.solver = GetParam();
    scene.settings.iterationsPerLevel = { { 8, 8, 48 } };
    return scene;
  }
};
}

INSTANTIATE_TEST_SUITE_P(Coherence, EverySolver,
  ::testing::Values(SolverKind::Policy, SolverKind::Adam),
  [](const auto& solver) { return solver.param == SolverKind::Policy ? "Policy" : "Adam"; });

TEST_P(EverySolver, FindsTheSameBitsWithNothingToStayNear)
{
  BoxScene scene = this->Scene();
  Solver without = scene.MakeSolver();
  without.Run();
  EXPECT_EQ(RunNear(scene, AnyExtinction(scene)).Extinction(), without.Extinction());

  scene.settings.temporalCoherence = 1;
  Solver nothingBefore = scene.MakeSolver();
  nothingBefore.Run();
  EXPECT_EQ(nothingBefore.Extinction(), without.Extinction());
  EXPECT_EQ(nothingBefore.BestEnergy().coherence, 0);
}

// t / 2 sum (mu - mu_previous)^2 dV, from its definition in world units.
TEST_P(EverySolver, TellsTheEnergyOfItsDefinition)
{
  BoxScene scene = this->Scene();
  scene.settings.temporalCoherence = 0.7;
  scene.settings.smoothness = 0;
  const std::vector<float> previous = AnyExtinction(scene);

  const Solver solver = RunNear(scene, previous);

  const std::vector<float>& found = solver.Extinction();
  double squares = 0;
  for (std::size_t node = 0; node < found.size(); ++node)
  {
    squares += std::pow(double(found[node]) - double(previous[node]), 2);
  }
  const double energy = 0.5 * CoherenceWeightOf(scene) * squares * scene.grid.CellVolume();
  EXPECT_GT(energy, 0);
  EXPECT_WITHIN(solver.BestEnergy().coherence, energy,
    Relative(1e-5, energy, "squares of floats are summed in double precision, row by row"));
  const Energy best = solver.BestEnergy();
  EXPECT_EQ(best.Total(), best.regularization + best.view + best.light + best.coherence);
}

TEST_P(EverySolver, StaysTheNearerTheMoreItCosts)
{
  BoxScene scene = this->Scene();
  const std::vector<float> previous = AnyExtinction(scene);
  double before = MeanDistance(RunNear(scene, previous).Extinction(), previous);
  const double free = before;
  for (const double coherence : { 0.1, 1.0, 10.0 })
  {
    scene.settings.temporalCoherence = coherence;
    const double distance = MeanDistance(RunNear(scene, previous).Extinction(), previous);
    EXPECT_LT(distance, before) << coherence;
    before = distance;
  }
  EXPECT_LT(before, 0.2 * free);
}

// Where nothing is at stake, p (mu - mu-bar) + t (mu - mu_previous) vanishes.
TEST(Coherence, MinimisesItsClosedFormWhereNothingIsAtStake)
{
  BoxScene scene = BoxScene::Cube(17);
  scene.camera.position = Vec3(0, 0, -4);
  scene.settings.weights.light = 0;
  scene.settings.weights.regularization = 5;
  scene.settings.temporalCoherence = 0.7;
  scene.Fill([](const Vec3&) { return 0.5; },
    [](const Vec3& x) { return glm::length(x - Vec3(0, 0, -0.75)) < 0.2 ? 1.0 : 0.0; });
  const std::vector<float> previous = AnyExtinction(scene);

  const Solver solver = RunNear(scene, previous);

  const double p = 5 * scene.grid.Radius();
  const double t = CoherenceWeightOf(scene);
  // Behind all that is important, and beside what is seen of it.
  int nodes = 0;
  for (int k = 8; k < 17; ++k)
  {
    for (int j = 0; j < 17; ++j)
    {
      for (int i = 0; i < 17; ++i, ++nodes)
      {
        const auto node = std::size_t((k * 17 + j) * 17 + i);
        const double wanted = (p * 0.5 + t * previous[node]) / (p + t);
        EXPECT_WITHIN(solver.Extinction()[node], wanted, Roundoff<float>(8, 1));
      }
    }
  }
  EXPECT_EQ(nodes, 9 * 17 * 17);
}

TEST(Coherence, ComesToAnEndAtWhatItFoundBefore)
{
  BoxScene scene = BoxScene::Onion();
  Solver first = scene.MakeSolver();
  first.Run();
  scene.settings.temporalCoherence = 0.1;

  const Solver again = RunNear(scene, first.Extinction());

  const double majorant = MajorantOf(scene);
  EXPECT_LT(MeanDistance(again.Extinction(), first.Extinction()), 0.01 * majorant);
  EXPECT_GT(again.BestScore().visibility, 0.995 * first.BestScore().visibility);
}

TEST(Coherence, TakesWhatWasBeforeIntoTheBounds)
{
  BoxScene scene = BoxScene::Onion();
  scene.settings.temporalCoherence = 10;
  scene.settings.protectImportance = 1;
  std::vector<float> previous(scene.extinction.size(), 1e30f);
  for (std::size_t node = 0; node < previous.size(); node += 2)
  {
    previous[node] = -1;
  }

  const Solver solver = RunNear(scene, previous);

  const float majorant = MajorantOf(scene);
  for (std::size_t node = 0; node < previous.size(); ++node)
  {
    const float value = solver.Extinction()[node];
    const float least = scene.importance[node] * scene.extinction[node];
    ASSERT_TRUE(value >= least * 0.9999f && value <= majorant) << value;
    if (scene.extinction[node] == 0 && scene.importance[node] == 0)
    {
      ASSERT_EQ(value, 0);
    }
  }
}

TEST(Coherence, StaysNearTwoExtinctionsInSeparateMode)
{
  BoxScene scene = BoxScene::Onion();
  scene.settings.mode = Mode::Separate;
  scene.settings.temporalCoherence = 1e6;
  const std::vector<float> camera = AnyExtinction(scene);
  std::vector<float> light = camera;
  std::reverse(light.begin(), light.end());
  for (std::size_t node = 0; node < light.size(); ++node)
  {
    light[node] = scene.extinction[node] == 0 && scene.importance[node] == 0 ? 0 : light[node];
  }

  CarriedChange previous = ChangeFrom(scene, camera);
  previous.ofLight = ChangeFrom(scene, light).ofExtinction;
  Solver solver(scene.Fields(), scene.camera, scene.light, scene.settings, previous);
  solver.Run();

  // Nothing moves a node by more than its weight times |T (V - g)| <= 1 over t.
  const double most = 10 / CoherenceWeightOf(scene) + 1e-5 * MajorantOf(scene);
  EXPECT_LT(MeanDistance(solver.Extinction(), camera), most);
  EXPECT_LT(MeanDistance(solver.LightExtinction(), light), most);
}

TEST(Coherence, StaysNearWhatIsThickerThanTheDataInThickMedia)
{
  BoxScene scene = BoxScene::Onion();
  for (float& value : scene.extinction)
  {
    value *= 4;
  }
  scene.settings.temporalCoherence = 1e6;
  const std::vector<float> before = AnyExtinction(scene);
  Solver solver(
    scene.Fields(), scene.camera, scene.light, scene.settings, ChangeFrom(scene, before));
  solver.Run();

  const double most = 10 / CoherenceWeightOf(scene) + 1e-5 * MajorantOf(scene);
  EXPECT_LT(MeanDistance(solver.Extinction(), before), most);
}

TEST(Coherence, RejectsWhatItCannotWorkWith)
{
  BoxScene scene = BoxScene::Onion(9);
  scene.settings.temporalCoherence = 1;
  CarriedChange small = ChangeFrom(scene, scene.extinction);
  small.ofExtinction.pop_back();
  EXPECT_THROW(Solver(scene.Fields(), scene.camera, scene.light, scene.settings, small), Error);
  for (const double coherence : { -1.0, std::nan(""), HUGE_VAL })
  {
    scene.settings.temporalCoherence = coherence;
    EXPECT_THROW(scene.MakeSolver(), Error) << coherence;
  }
}

TEST(CarriedChange, MakesTheSameExtinctionOfTheSameBase)
{
  const BoxScene scene = BoxScene::Onion();
  const std::vector<float> extinction = AnyExtinction(scene);
  const float majorant = MajorantOf(scene);
  const CarriedChange change = ChangeFrom(scene, extinction);

  const CarriedExtinction again = *AppliedTo(scene.Fields(), majorant, change);

  EXPECT_TRUE(again.light.empty());
  for (std::size_t node = 0; node < extinction.size(); ++node)
  {
    EXPECT_WITHIN(again.extinction[node], extinction[node], Roundoff<float>(8, majorant));
  }
}

// What was clear stays clear, what was wholly opaque stays so, whatever the base becomes.
TEST(CarriedChange, KeepsWhatIsClearAndWhatIsOpaque)
{
  const BoxScene scene = BoxScene::Onion(17);
  const float majorant = MajorantOf(scene);
  std::vector<float> extinction(scene.extinction.size());
  for (std::size_t node = 0; node < extinction.size(); ++node)
  {
    extinction[node] = node % 2 == 0 ? 0.0f : majorant;
  }
  const CarriedChange change = ChangeFrom(scene, extinction);
  BoxScene edited = BoxScene::Onion(17);
  for (float& value : edited.extinction)
  {
    value *= 0.25f;
  }

  const std::vector<float> carried =
    AppliedTo(edited.Fields(), 0.5f * majorant, change)->extinction;

  for (std::size_t node = 0; node < carried.size(); ++node)
  {
    if (scene.extinction[node] > 0 && scene.extinction[node] < majorant)
    {
      EXPECT_WITHIN(
        carried[node], node % 2 == 0 ? 0.0f : 0.5f * majorant, Roundoff<float>(4, majorant));
    }
  }
}

TEST(CarriedChange, GoesToFinerAndCoarserGrids)
{
  const BoxScene scene = BoxScene::Onion(17);
  const BoxScene fine = BoxScene::Onion(33);
  const float majorant = MajorantOf(scene);
  for (const float by : { -1.0f, -0.25f, 0.0f, 0.5f, 1.0f })
  {
    for (const auto& [from, to] : { std::pair(&scene, &fine), std::pair(&fine, &scene) })
    {
      CarriedChange change;
      change.grid = from->grid;
      change.ofExtinction.assign(std::size_t(from->grid.NodeCount()), by);
      const std::vector<float> found = AppliedTo(to->Fields(), majorant, change)->extinction;
      for (std::size_t node = 0; node < found.size(); ++node)
      {
        const float base = to->extinction[node];
        const bool empty = base == 0 && to->importance[node] == 0;
        const float wanted =
          empty ? 0 : base + by * (by < 0 ? base : std::max(majorant - base, 0.0f));
        EXPECT_WITHIN(found[node], wanted, Roundoff<float>(16, majorant));
      }
    }
  }
}

TEST(CarriedChange, IsNearForNearViewsAndTheSameSettings)
{
  const BoxScene scene = BoxScene::Onion(5);
  const CarriedChange change = ChangeFrom(scene, scene.extinction);
  const auto turned = [&](double degrees, auto view)
  {
    const double angle = degrees * std::acos(-1.0) / 180;
    const Vec3 arm = view.position; // from the middle
    const Vec3 side = glm::normalize(glm::cross(arm, Vec3(0, 0, 1))) * glm::length(arm);
    view.position = std::cos(angle) * arm + std::sin(angle) * side;
    return view;
  };
  for (const double degrees : { 0.0, 1.0, 5.0, 19.0, 20.0, 90.0, 180.0 })
  {
    const double wanted = std::max(1 - degrees / 20, 0.0);
    EXPECT_WITHIN(change.NearnessTo(turned(degrees, scene.camera), scene.light, scene.settings),
      wanted, Roundoff<double>(50, 1));
    EXPECT_WITHIN(change.NearnessTo(scene.camera, turned(degrees, scene.light), scene.settings),
      wanted, Roundoff<double>(50, 1));
  }
  Camera closer = scene.camera;
  closer.position *= 0.5;
  EXPECT_WITHIN(change.NearnessTo(closer, scene.light, scene.settings), 1, Roundoff<double>(50, 1));
  Settings other = scene.settings;
  other.weights.view *= 2;
  EXPECT_EQ(change.NearnessTo(scene.camera, scene.light, other), 0);
  Settings elsewhere = scene.settings;
  elsewhere.backend = BackendKind::Cpu;
  EXPECT_EQ(change.NearnessTo(scene.camera, scene.light, elsewhere), 1);
  Camera inTheMiddle = scene.camera;
  inTheMiddle.position = Vec3(0);
  EXPECT_EQ(change.NearnessTo(inTheMiddle, scene.light, scene.settings), 1);
}
