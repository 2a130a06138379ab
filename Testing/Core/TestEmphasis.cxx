// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Emphasis: how far above its base extinction matter may become.

#include "Shrinking.h"

#include "math/Require.h"
#include "optimize/ExtinctionBounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
/// The number of voxels outside of pi g mu-bar <= mu <= mu-bar + epsilon (majorant - mu-bar).
std::size_t CountOutside(
  const BoxScene& scene, double majorant, const std::vector<float>& extinction)
{
  const auto protect = static_cast<float>(scene.settings.protectImportance);
  const double emphasis = scene.settings.emphasis;
  // Despeckling takes importance away, so that less may be protected.
  const bool asGiven = scene.settings.importanceSmoothing == ImportanceSmoothing::Off;
  std::size_t outside = 0;
  for (std::size_t node = 0; node < extinction.size(); ++node)
  {
    const float base = scene.extinction[node];
    const float least = asGiven ? protect * scene.importance[node] * base : 0.0f;
    // Two products and a sum in single precision, unless both ends are the same.
    const double most =
      emphasis == 0 ? double(base) : base + emphasis * (majorant - base) + 4e-7 * majorant;
    outside += extinction[node] < least || extinction[node] > most ? 1 : 0;
  }
  return outside;
}

std::string Broken(const BoxScene& scene, const Solver& solver)
{
  const std::size_t outside = CountOutside(scene, solver.Majorant(), solver.Extinction()) +
    CountOutside(scene, solver.Majorant(), solver.LightExtinction());
  return outside == 0 ? "" : std::to_string(outside) + " voxels are outside of their bounds";
}

/// Any emphasis and protection, by any solver.
BoxScene MakeEmphasisedScene(std::uint64_t seed)
{
  BoxScene scene = MakeRandomScene(seed);
  RandomNumbers random(seed + 1000000);
  Settings& settings = scene.settings;
  settings.emphasis = random.Chance(0.3) ? 0 : random.Between(0, 1);
  settings.protectImportance = random.Chance(0.3) ? 0 : random.Between(0, 1);
  settings.mode = random.Chance(0.3) ? Mode::Separate : Mode::Joint;
  settings.smoothness = random.Chance(0.3) ? random.Between(0, 2) : 0;
  if (random.Chance(0.3))
  {
    settings.solver = SolverKind::Adam;
    settings.iterationsPerLevel = { { 3, 3, 3 } };
  }
  return scene;
}
}

TEST(Emphasis, BoundsAreTheBaseWithZeroAndTheMajorantWithOne)
{
  RandomNumbers random(7);
  for (int i = 0; i < 1000; ++i)
  {
    const auto majorant = static_cast<float>(random.PowerOfTen(-6, 6));
    const auto base = std::min(majorant, static_cast<float>(majorant * random.Between(0, 1)));
    const auto emphasis = static_cast<float>(random.Between(0, 1));

    EXPECT_EQ((ExtinctionBounds<float>{ 0, 0, majorant }.Clamp(2 * majorant, 0, base)), base);
    EXPECT_EQ((ExtinctionBounds<float>{ 0, 1, majorant }.Clamp(2 * majorant, 0, base)), majorant);
    const ExtinctionBounds<float> between{ 0, emphasis, majorant };
    EXPECT_EQ(between.Clamp(base, 0, base), base);
    EXPECT_LE(between.Most(base), majorant);
    EXPECT_EQ(between.Most(majorant), majorant);
  }
}

TEST(Emphasis, NoVoxelLeavesItsBoundsInRandomScenes)
{
  CheckAtRandom(1, 400, MakeEmphasisedScene,
    [](const BoxScene& scene)
    {
      Solver solver = scene.MakeSolver();
      solver.Run();
      return Broken(scene, solver);
    });
}

TEST(Emphasis, HoldsFromTheFirstIterateOnWhateverItIs)
{
  CheckAtRandom(1001, 100, MakeEmphasisedScene,
    [](BoxScene scene)
    {
      scene.settings.mode = Mode::Joint;
      Solver solver = scene.MakeSolver();
      const auto majorant = static_cast<float>(solver.Majorant());
      solver.SetInitialExtinction(std::vector<float>(scene.extinction.size(), majorant).data());
      const std::string atStart = Broken(scene, solver);
      solver.Step(1);
      return atStart + Broken(scene, solver);
    });
}

TEST(Emphasis, HoldsForWhatIsCarriedOnFromASceneWithMore)
{
  BoxScene scene = BoxScene::Onion();
  scene.settings.temporalCoherence = 1;
  Solver before = scene.MakeSolver();
  before.Run();
  CarriedChange change = before.Change();
  EXPECT_GT(*std::max_element(change.ofExtinction.begin(), change.ofExtinction.end()), 0.5f);

  scene.settings.emphasis = 0;
  change.settings = scene.settings; // so that it counts
  Solver after(scene.Fields(), scene.camera, scene.light, scene.settings, change);
  after.Run();

  EXPECT_EQ(CountOutside(scene, after.Majorant(), after.Extinction()), 0u);
}

TEST(Emphasis, TheEnergyIsNoLowerTheLessIsAllowed)
{
  double energy = -std::numeric_limits<double>::infinity();
  for (const double emphasis : { 1.0, 0.5, 0.0 })
  {
    BoxScene scene = BoxScene::Onion();
    scene.settings.emphasis = emphasis;
    Solver solver = scene.MakeSolver();
    solver.Run();
    const double now = solver.BestEnergy().Total();
    // The more is allowed, the lower is the minimum; the solver comes as near to it as 0.5 %.
    EXPECT_GE(now, energy - 0.005 * std::abs(energy)) << emphasis;
    energy = now;
  }
}

TEST(Emphasis, OfAShareOutOfRangeIsRefused)
{
  for (const double emphasis : { -0.1, 1.1, std::numeric_limits<double>::quiet_NaN() })
  {
    BoxScene scene = BoxScene::Onion();
    scene.settings.emphasis = emphasis;
    EXPECT_THROW(scene.MakeSolver(), Error) << emphasis;
  }
}

namespace
{
/// What is wrong if a scene shows less than `least` of what its base shows, nothing else.
std::string ShowsLess(BoxScene scene, double lightWeight, double least)
{
  scene.settings.emphasis = 0;
  scene.settings.weights.light = lightWeight;
  Solver solver = scene.MakeSolver();
  solver.Run();
  const double before = solver.BaseScore().fraction;
  const double after = solver.BestScore().fraction;
  return after < least * before ? std::to_string(after) + " is less than " + std::to_string(before)
                                : std::string();
}
}

// With nothing thicker than in the data, the score is the numerator of the visible fraction: what
// is removed lets more of the rest be seen, or it was not worth it.
TEST(Emphasis, OfZeroNeverLetsLessBeSeen)
{
  CheckAtRandom(
    1, 1000, MakeEmphasisedScene, [](const BoxScene& scene) { return ShowsLess(scene, 0, 1); });
}

TEST(Emphasis, OfZeroNeverLetsLessBeSeenForALightOfNoMoreWeight)
{
  CheckAtRandom(
    1, 500, MakeEmphasisedScene, [](const BoxScene& scene) { return ShowsLess(scene, 1, 1); });
}

// Something visible may go where that lights more of the rest.
TEST(Emphasis, OfZeroLetsHardlyLessBeSeenForALightOfMoreWeight)
{
  CheckAtRandom(
    1, 500, MakeEmphasisedScene, [](const BoxScene& scene) { return ShowsLess(scene, 20, 0.98); });
}
