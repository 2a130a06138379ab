// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What holds for every scene, on scenes at random.

#include "Outcome.h"
#include "RandomScene.h"
#include "Shrinking.h"

#include "backend/Backend.h"
#include "viewpoint/Search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
/// Scenes with all there is to be set.
BoxScene MakeAnyScene(unsigned seed)
{
  BoxScene scene = MakeRandomScene(seed);
  RandomNumbers random(seed + 1000000007ULL);
  Settings& settings = scene.settings;
  settings.solver = random.Chance(0.15) ? SolverKind::Adam : SolverKind::Policy;
  settings.mode = random.Chance(0.2) ? Mode::Separate : Mode::Joint;
  settings.derivative = random.Chance(0.1) ? Derivative::Ray : Derivative::Volume;
  settings.maximumIterations = random.IntegerBetween(0, 4);
  settings.iterationsPerLevel = { { random.IntegerBetween(0, 2), 1, 2 } };
  settings.skipUnneeded = random.Chance(0.8);
  settings.restrictToView = random.Chance(0.2);
  settings.weights.regularization = random.PowerOfTen(-6, 2);
  settings.weights.view = random.Chance(0.1) ? 0.0 : random.PowerOfTen(-3, 4);
  scene.camera.parallelScale = 0.7 * std::max(scene.grid.Radius(), 1e-3);
  scene.camera.viewAngle = random.Between(5, 120);
  return scene;
}

bool AreWithin(const std::vector<float>& values, double low, double high)
{
  return std::all_of(values.begin(), values.end(),
    [&](float value) { return double(value) >= low && double(value) <= high; }); // NaN is not
}

/// Returns a scene with these nodes in another order: its axes are cyclically permuted, or one of
/// them is mirrored.
BoxScene Reordered(const BoxScene& scene, int turns, int mirrored)
{
  const Grid& grid = scene.grid;
  BoxScene other = scene;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int from = (axis + turns) % 3;
    other.grid.nodes[axis] = grid.nodes[from];
    other.grid.spacing[axis] = grid.spacing[from];
    other.grid.direction[axis] = grid.direction[from] * (axis == mirrored ? -1.0 : 1.0);
  }
  const auto indexOf = [&](const Int3& index)
  {
    Int3 from(0);
    for (int axis = 0; axis < 3; ++axis)
    {
      from[(axis + turns) % 3] =
        axis == mirrored ? other.grid.nodes[axis] - 1 - index[axis] : index[axis];
    }
    return from;
  };
  other.grid.origin = grid.PointToWorld(Vec3(indexOf(Int3(0))));
  other.ForEachNode(
    [&](std::size_t node, int i, int j, int k)
    {
      const Int3 from = indexOf({ i, j, k });
      const Index source = (Index(from.z) * grid.nodes.y + from.y) * grid.nodes.x + from.x;
      other.extinction[node] = scene.extinction[std::size_t(source)];
      other.importance[node] = scene.importance[std::size_t(source)];
    });
  return other;
}

/// Lengths are multiplied by a power of two, so that nothing rounds another way.
BoxScene InOtherUnits(const BoxScene& scene, double unit)
{
  BoxScene other = scene;
  other.grid.origin *= unit;
  other.grid.spacing *= unit;
  for (Vec3* position : { &other.camera.position, &other.camera.focalPoint, &other.light.position,
         &other.light.focalPoint })
  {
    *position *= unit;
  }
  other.camera.parallelScale *= unit;
  for (float& extinction : other.extinction)
  {
    extinction /= static_cast<float>(unit);
  }
  return other;
}
}

TEST(Shrinking, LeavesWhatAFailureNeeds)
{
  BoxScene scene = BoxScene::Cube(6);
  scene.Fill(Everywhere(1), Everywhere(1));
  scene.extinction[100] = 3;

  const BoxScene simplest = Shrunk(scene,
    [](const BoxScene& any)
    {
      const auto opaque = [](float extinction) { return extinction > 2; };
      return std::any_of(any.extinction.begin(), any.extinction.end(), opaque) ? "opaque" : "";
    });

  EXPECT_EQ(simplest.extinction, std::vector<float>{ 3 });
  EXPECT_EQ(simplest.importance, std::vector<float>{ 0 });
}

TEST(SceneProperties, KeepTheirBounds)
{
  CheckAtRandom(0, 5000, MakeAnyScene,
    [](const BoxScene& scene) -> std::string
    {
      Solver solver = scene.MakeSolver();
      const Score base = solver.BaseScore();
      solver.Run();
      const double majorant = solver.Majorant();
      if (!AreWithin(solver.Extinction(), 0, majorant) ||
        !AreWithin(solver.LightExtinction(), 0, majorant))
      {
        return "extinction outside [0, majorant]";
      }
      std::vector<float> transmittance(scene.extinction.size());
      solver.Transmittance(transmittance.data());
      if (!AreWithin(transmittance, 0, 1))
      {
        return "transmittance from the camera outside [0, 1]";
      }
      solver.LightTransmittance(transmittance.data());
      if (!AreWithin(transmittance, 0, 1))
      {
        return "transmittance from the light outside [0, 1]";
      }
      for (const Score& score : { base, solver.BestScore() })
      {
        if (!(score.visibility >= 0 && score.fraction >= 0 && score.fraction <= 1) ||
          !std::isfinite(score.visibility))
        {
          return "score " + std::to_string(score.visibility) + ", visible share " +
            std::to_string(score.fraction);
        }
      }
      for (const IterationRecord& record : solver.History())
      {
        if (!std::isfinite(record.energy.Total()) || !(record.meanChange >= 0))
        {
          return "iteration " + std::to_string(record.iteration) + " has no energy";
        }
      }
      // The base is an iterate, too; sums of floats round.
      const Energy& start = solver.History().front().energy;
      const double size = std::abs(start.view) + std::abs(start.light) + start.regularization;
      return solver.BestEnergy().Total() <= start.Total() + 1e-5 * size
        ? ""
        : "energy " + std::to_string(solver.BestEnergy().Total()) + " above that of the base, " +
          std::to_string(start.Total());
    });
}

TEST(SceneProperties, DoNotDependOnTheUnitOfLength)
{
  CheckAtRandom(10000, 2500, MakeAnyScene,
    [](const BoxScene& scene) -> std::string
    {
      // The nodes choose which: the smallest and largest that images may have, and an ordinary one.
      constexpr int exponents[] = { -54, 10, 72 };
      const float unit = std::ldexp(1.0f, exponents[scene.grid.nodes.x % 3]);
      const Outcome here = Optimize(scene);
      const Outcome there = Optimize(InOtherUnits(scene, unit));
      if (there.transmittance != here.transmittance ||
        there.lightTransmittance != here.lightTransmittance)
      {
        return "other transmittances";
      }
      for (std::size_t node = 0; node < here.extinction.size(); ++node)
      {
        if (there.extinction[node] * unit != here.extinction[node])
        {
          return "other extinction";
        }
      }
      return there.best.visibility == here.best.visibility * unit * unit ? "" : "other score";
    });
}

TEST(SceneProperties, DoNotDependOnTheOrderOfTheNodes)
{
  CheckAtRandom(50000, 2000, MakeAnyScene,
    [](const BoxScene& scene) -> std::string
    {
      BoxScene plain = scene; // one step decides by thresholds, so that rounding shows
      plain.settings.maximumIterations = 0;
      plain.settings.iterationsPerLevel = { { 0, 0, 0 } };
      const Outcome here = Optimize(plain);
      for (const auto& [turns, mirrored] : { std::pair{ 1, -1 }, { 2, -1 }, { 0, 0 }, { 0, 2 } })
      {
        const Outcome there = Optimize(Reordered(plain, turns, mirrored));
        if (std::abs(there.base.visibility - here.base.visibility) > 1e-5 * here.base.visibility)
        {
          return "S " + std::to_string(there.base.visibility) + " for " +
            std::to_string(here.base.visibility);
        }
      }
      return "";
    });
}

TEST(SceneProperties, DoNotDependOnThreads)
{
  CheckAtRandom(20000, 2000, MakeAnyScene,
    [](const BoxScene& scene) -> std::string
    {
      const Outcome many = Optimize(scene);
      const ThreadLimit limit(1);
      const Outcome one = Optimize(scene);
      return one.extinction == many.extinction && one.lightExtinction == many.lightExtinction &&
          one.transmittance == many.transmittance && one.best.visibility == many.best.visibility &&
          one.energy.Total() == many.energy.Total()
        ? ""
        : "another result with one thread";
    });
}

TEST(SceneProperties, LeaveTheBaseWhereNothingIsImportant)
{
  CheckAtRandom(30000, 1000, MakeAnyScene,
    [](const BoxScene& scene) -> std::string
    {
      BoxScene other = scene;
      std::fill(other.importance.begin(), other.importance.end(), 0.0f);
      const Outcome outcome = Optimize(other);
      return outcome.extinction == other.extinction && outcome.best.visibility == 0
        ? ""
        : "the extinction changes";
    });
}

TEST(SceneProperties, HaveViewsWithScoresAndSlopes)
{
  CheckAtRandom(40000, 150, MakeAnyScene,
    [](const BoxScene& scene) -> std::string
    {
      const ViewScore score(scene.grid, { scene.extinction.data(), scene.importance.data() }, 1);
      const Score seen = score.At(scene.camera);
      const ViewSlope slope = score.SlopeAt(scene.camera);
      const bool finite = std::isfinite(seen.visibility) && std::isfinite(slope.score) &&
        std::isfinite(glm::length(slope.slope));
      return finite && seen.visibility >= 0 && seen.fraction <= 1 ? "" : "a score is no number";
    });
}
