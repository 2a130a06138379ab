// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What can be seen at most: closed forms, all choices of a single ray, the independent march, and
// no result above it.

#include "CeilingMarch.h"
#include "LeastEnergy.h"
#include "RandomScene.h"
#include "Shrinking.h"
#include "TestedDevice.h"
#include "Tolerance.h"
#include "ViewScene.h"

#include "backend/HostDevice.h"
#include "optimize/PreparedScene.h"
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
/// The ceiling by itself, to which Solver adds what was found.
Ceiling CeilingOf(
  const BoxScene& scene, SolverBackend& backend, double emphasis, bool fromLight = false)
{
  PreparedScene prepared(scene.Fields());
  const Problem problem = prepared.ProblemForScores(scene.camera, scene.light, scene.settings);
  const NodeValues least = prepared.LeastExtinction(scene.settings);
  const MostExtinction<float> most{ static_cast<float>(emphasis), prepared.Majorant() };
  const auto sweeps =
    fromLight ? backend.SweepsFrom(problem, problem.Light()) : backend.SweepsFromCameras(problem);
  return sweeps->CeilingOf(least.Data(), most);
}

Ceiling CeilingOf(const BoxScene& scene, double emphasis = 1)
{
  return CeilingOf(scene, *MakeSolverBackend(HostDevice::Shared()), emphasis);
}

/// The scene as the march takes it, with extinction up to an upper bound.
struct Bounds
{
  std::vector<float> least;
  std::vector<float> most;

  Bounds(const BoxScene& scene, double emphasis)
    : least(scene.extinction)
    , most(scene.extinction)
  {
    const double majorant = *std::max_element(most.begin(), most.end());
    for (std::size_t node = 0; node < most.size(); ++node)
    {
      const double base = scene.extinction[node];
      least[node] =
        static_cast<float>(scene.settings.protectImportance * scene.importance[node] * base);
      most[node] = static_cast<float>(base + emphasis * (majorant - base));
    }
  }

  double CeilingFrom(const BoxScene& scene, const truth::Source& source) const
  {
    truth::Sampling sampling;
    sampling.raysPerVoxel = 3;
    return truth::CeilingOf(
      { scene.Lattice(), scene.importance.data(), this->least.data(), this->most.data() }, source,
      sampling);
  }
};

/// A column of fields along the third axis of a slab one unit wide and high, seen from its front.
BoxScene Column(const std::vector<double>& extinction, const std::vector<double>& importance)
{
  const int nodes = static_cast<int>(extinction.size());
  BoxScene scene({ 2, 2, nodes }, Vec3(0), Vec3(1, 1, 1));
  scene.ForEachNode(
    [&](std::size_t node, int, int, int k)
    {
      scene.extinction[node] = static_cast<float>(extinction[std::size_t(k)]);
      scene.importance[node] = static_cast<float>(importance[std::size_t(k)]);
    });
  scene.camera.parallel = true;
  scene.camera.position = scene.grid.Centre() - Vec3(0, 0, 20);
  scene.camera.focalPoint = scene.grid.Centre();
  return scene;
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

void LookFrom(BoxScene& scene, const Vec3& direction, bool parallel)
{
  scene.camera = OrbitOf(scene.grid, parallel).At(glm::normalize(direction));
}

class CeilingOfBox : public ::testing::TestWithParam<Place>
{
protected:
  static BoxScene Make()
  {
    BoxScene scene = Filled(GetParam().content);
    GetParam().put(scene);
    return scene;
  }
};

BoxScene MakeAnyScene(unsigned seed)
{
  BoxScene scene = MakeRandomScene(seed);
  RandomNumbers random(seed + 1000000007ULL);
  Settings& settings = scene.settings;
  settings.solver = random.Chance(0.3) ? SolverKind::Adam : SolverKind::Policy;
  settings.mode = random.Chance(0.2) ? Mode::Separate : Mode::Joint;
  settings.maximumIterations = random.IntegerBetween(0, 6);
  settings.iterationsPerLevel = { { random.IntegerBetween(0, 2), 1, 8 } };
  settings.skipUnneeded = random.Chance(0.8);
  settings.restrictToView = random.Chance(0.2);
  settings.smoothness = random.Chance(0.2) ? random.Between(0, 2) : 0;
  settings.weights.regularization = random.PowerOfTen(-6, 2);
  scene.camera.parallelScale = 0.7 * std::max(scene.grid.Radius(), 1e-3);
  scene.camera.viewAngle = random.Between(5, 120);
  return scene;
}
}

TEST(Ceiling, OfAHomogeneousSlabIsWhatIsSeenOfIt)
{
  // Seen in parallel, nothing behind a thing is worth more than itself: the base is the best.
  const double mu = 0.3;
  const BoxScene scene = Column({ mu, mu, mu, mu, mu }, { 0.8, 0.8, 0.8, 0.8, 0.8 });

  const Ceiling ceiling = CeilingOf(scene);

  const double stopped = -std::expm1(-4 * mu);
  EXPECT_WITHIN(ceiling.visibility, 0.8 * stopped, Roundoff<float>(100, 1));
  EXPECT_WITHIN(ceiling.fraction, stopped / (4 * mu), Roundoff<float>(100, 1));
}

TEST(Ceiling, OfTwoSlabsClearsTheFrontOneOrKeepsItsShare)
{
  // Fog of importance 0.25 in front of a slab of importance 1 and of the same extinction. Behind
  // the fog, 1 - e^-3 can be seen, so the fog goes; with protection, a share of its importance
  // stays.
  constexpr int half = 40;
  const double mu = 3.0 / half;
  std::vector<double> importance(2 * half + 1, 1.0);
  std::fill(importance.begin(), importance.begin() + half, 0.25);
  BoxScene scene = Column(std::vector<double>(importance.size(), mu), importance);
  const double behind = -std::expm1(-3.0);
  const Tolerance border{ 1.5 * mu, "the importance rises in a layer between the slabs" };

  EXPECT_WITHIN(CeilingOf(scene).visibility, behind, border);

  scene.settings.protectImportance = 1;
  const double through = std::exp(-0.25 * 3.0);
  EXPECT_WITHIN(CeilingOf(scene).visibility, 0.25 * (1 - through) + behind * through, border);
}

TEST(Ceiling, IsTheBestOfAllChoicesOfARay)
{
  constexpr int layers = 6;
  constexpr int halves = 2 * layers;
  for (int seed = 0; seed < 50; ++seed)
  {
    RandomNumbers random(std::uint64_t(seed) + 1);
    std::vector<double> extinction;
    std::vector<double> importance;
    for (int k = 0; k <= layers; ++k)
    {
      // Thin enough for two halves a layer (Problem::MayHaveThickLayers).
      extinction.push_back(random.Chance(0.2) ? 0 : random.PowerOfTen(-2, -0.6));
      importance.push_back(random.Chance(0.3) ? 0 : random.Between(0, 1));
    }
    BoxScene scene = Column(extinction, importance);
    scene.settings.protectImportance = random.Chance(0.3) ? 0 : random.Between(0, 1);
    const double emphasis = random.Chance(0.5) ? 0 : random.Between(0, 1);
    const Bounds bounds(scene, emphasis);
    struct Half
    {
      double importance, least, most;
    };
    std::vector<Half> ray;
    for (int number = 0; number < halves; ++number)
    {
      const double share = gaussPoints[number % 2];
      const auto at = [&](const std::vector<float>& field)
      {
        const std::size_t node = 4 * std::size_t(number / 2); // four in a slice
        return (1 - share) * field[node] + share * field[node + 4];
      };
      ray.push_back({ at(scene.importance), at(bounds.least), at(bounds.most) });
    }
    double best = 0;
    for (unsigned choice = 0; choice < 1U << halves; ++choice)
    {
      double behind = 0;
      for (int number = halves; number-- > 0;)
      {
        const Half& half = ray[std::size_t(number)];
        const double mu = (choice >> number) % 2 ? half.most : half.least;
        behind = half.importance + (behind - half.importance) * std::exp(-0.5 * mu);
      }
      best = std::max(best, behind);
    }

    EXPECT_WITHIN(
      CeilingOf(scene, emphasis).visibility, best, Roundoff<float>(20 * halves, best + 0.01))
      << seed;
  }
}

TEST(Ceiling, OfThickLayersIsThatOfAFineMarch)
{
  constexpr int layers = 6;
  constexpr int stepsPerLayer = 20000;
  for (int seed = 0; seed < 50; ++seed)
  {
    RandomNumbers random(std::uint64_t(seed) + 1);
    std::vector<double> extinction;
    std::vector<double> importance;
    for (int k = 0; k <= layers; ++k)
    {
      extinction.push_back(random.Chance(0.2) ? 0 : random.PowerOfTen(-1, 2));
      importance.push_back(random.Chance(0.3) ? 0 : random.Between(0, 1));
    }
    const BoxScene scene = Column(extinction, importance);
    double best = 0;
    for (int step = layers * stepsPerLayer; step-- > 0;)
    {
      const double depth = (step + 0.5) / stepsPerLayer;
      const auto front = static_cast<std::size_t>(depth);
      const auto at = [&](const std::vector<double>& field)
      { return field[front] + (depth - double(front)) * (field[front + 1] - field[front]); };
      const double passed = std::exp(-at(extinction) / stepsPerLayer);
      best = std::max(best, at(importance) + (best - at(importance)) * passed);
    }

    EXPECT_WITHIN(
      CeilingOf(scene, 0).visibility, best, Relative(5e-3, best, "pieces of constant extinction"))
      << seed;
  }
}

TEST_P(CeilingOfBox, IsThatOfTheMarch)
{
  BoxScene scene = Make();
  for (const double protect : { 0.0, 1.0 })
  {
    for (const double emphasis : { 0.0, 1.0 })
    {
      scene.settings.protectImportance = protect;
      const Bounds bounds(scene, emphasis);
      const Bounds kept(scene, 0);
      const double important = truth::ImportantExtinction(scene.TruthWith(scene.extinction));
      const double expected = bounds.CeilingFrom(scene, scene.Eye());

      const Ceiling ceiling = CeilingOf(scene, emphasis);

      EXPECT_WITHIN(ceiling.visibility, expected,
        Relative(0.01, expected, "cuts from node to node, an image of 40 voxels"))
        << protect << ", " << emphasis;
      EXPECT_WITHIN(ceiling.fraction, kept.CeilingFrom(scene, scene.Eye()) / important,
        (Tolerance{ 0.005, "the bar for fractions" }))
        << protect << ", " << emphasis;
    }
  }
}

TEST_P(CeilingOfBox, IsThatOfADevice)
{
  BoxScene scene = Make();
  scene.settings.protectImportance = 0.7;
  const std::shared_ptr<SolverBackend> there = MakeSolverBackend(MakeTestedDevice());
  const std::shared_ptr<SolverBackend> here = MakeSolverBackend(HostDevice::Shared());
  for (const double emphasis : { 0.0, 0.5 })
  {
    const Ceiling expected = CeilingOf(scene, *here, emphasis);
    const Ceiling found = CeilingOf(scene, *there, emphasis);

    // Both do these operations in single precision, in different orders.
    EXPECT_WITHIN(found.visibility, expected.visibility, Roundoff<float>(100, expected.visibility));
    EXPECT_WITHIN(found.fraction, expected.fraction, Roundoff<float>(100, 1));
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, CeilingOfBox,
  ::testing::Values(Place{ "OnionFromOutside", Content::Onion,
                      [](BoxScene& scene) { LookFrom(scene, Vec3(0.4, -0.3, 0.8), false); } },
    Place{ "WavesOblique", Content::Waves,
      [](BoxScene& scene) { LookFrom(scene, Vec3(0.7, 0.6, 0.65), false); } },
    Place{ "BordersOblique", Content::Borders,
      [](BoxScene& scene) { LookFrom(scene, Vec3(0.7, 0.6, 0.65), false); } },
    Place{ "BordersParallel", Content::Borders,
      [](BoxScene& scene) { LookFrom(scene, Vec3(-0.9, 0.3, 0.2), true); } },
    Place{ "BordersFromInside", Content::Borders,
      [](BoxScene& scene)
      {
        scene.camera.position = scene.grid.Centre() + 0.2 * scene.grid.Radius();
        scene.camera.focalPoint = scene.grid.Centre();
      } }),
  ::testing::PrintToStringParamName());

TEST(Ceiling, IsNotBelowAnyResult)
{
  CheckAtRandom(60000, 4000, MakeAnyScene,
    [](const BoxScene& scene) -> std::string
    {
      Solver solver = scene.MakeSolver();
      solver.Run();
      const Score found = solver.BestScore();
      const Ceiling told = solver.FindCeiling();
      if (found.visibility > told.visibility || found.fraction > told.fraction)
      {
        return "the ceiling that the solver tells is below what it has found";
      }
      const Ceiling ceiling = CeilingOf(scene);
      // Sums of floats in opposite orders, and of a result that has become denser, a thick layer is
      // cut into other pieces than of the base.
      const double rounding = 0.02;
      if (found.visibility > ceiling.visibility * (1 + rounding))
      {
        return "S " + std::to_string(found.visibility) + " above the ceiling, " +
          std::to_string(ceiling.visibility);
      }
      if (found.fraction > ceiling.fraction + rounding)
      {
        return "visible share " + std::to_string(found.fraction) + " above the ceiling, " +
          std::to_string(ceiling.fraction);
      }
      const Energy energy = solver.BestEnergy();
      const double least = LeastEnergyOf(scene.Fields(), scene.camera, scene.light, scene.settings);
      return energy.Total() >= least - rounding * std::abs(least)
        ? ""
        : "energy " + std::to_string(energy.Total()) + " below the least, " + std::to_string(least);
    });
}

TEST(Ceiling, IsOfTheLightAsWell)
{
  BoxScene scene = BoxScene::Onion(25);
  const Bounds bounds(scene, 1);
  const double expected = bounds.CeilingFrom(scene, scene.Lamp());
  Solver solver = scene.MakeSolver();

  const Ceiling ceiling = solver.FindCeiling();

  EXPECT_WITHIN(ceiling.lightVisibility, expected,
    Relative(0.01, expected, "cuts from node to node, an image of 25 voxels"));
  scene.settings.weights.light = 0;
  EXPECT_EQ(scene.MakeSolver().FindCeiling().lightVisibility, 0);
}

TEST(Ceiling, StaysTheSameWhileIterationsGoOn)
{
  const BoxScene scene = BoxScene::Onion(25);
  Solver solver = scene.MakeSolver();
  const Ceiling before = solver.FindCeiling();
  solver.Run();
  const Ceiling after = solver.FindCeiling();

  EXPECT_EQ(before.visibility, after.visibility);
  EXPECT_EQ(before.fraction, after.fraction);
  EXPECT_LE(solver.BestScore().fraction, after.fraction);
  EXPECT_GT(solver.BestScore().visibility, 0.9 * after.visibility);
}

TEST(Ceiling, OfSeveralCamerasIsTheMeanOfTheirs)
{
  BoxScene scene = BoxScene::Onion(25);
  const Camera first = scene.camera;
  Camera second = first;
  second.position = scene.grid.Centre() - 0.7 * (first.position - scene.grid.Centre());
  const Ceiling one = CeilingOf(scene);
  scene.camera = second;
  const Ceiling other = CeilingOf(scene);
  scene.camera = first;
  scene.settings = ForCameras(scene.settings, { first, second });

  const Ceiling both = CeilingOf(scene);

  EXPECT_WITHIN(both.visibility, 0.5 * (one.visibility + other.visibility),
    Roundoff<float>(10, one.visibility));
  EXPECT_WITHIN(
    both.fraction, 0.5 * (one.fraction + other.fraction), Roundoff<float>(10, one.fraction));
}
