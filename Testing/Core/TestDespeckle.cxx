// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Importance without its specks: the filter by sorting, and what the solver does with it.

#include "BoxScene.h"
#include "Tolerance.h"

#include "backend/Backend.h"
#include "energy/Despeckle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

using namespace limpid;

namespace
{
std::vector<float> Despeckled(const BoxScene& scene)
{
  std::vector<float> result(scene.importance.size(), 0.0f);
  Despeckle(scene.grid, scene.extinction.data(), scene.importance.data(), result.data());
  return result;
}

/// Sorts the node, counted eleven times, with its 26 neighbours, and takes what is in the middle.
float MedianAt(const BoxScene& scene, const Int3& node)
{
  const Int3& nodes = scene.grid.nodes;
  const auto at = [&](const Int3& where)
  {
    const Int3 inside = glm::clamp(where, Int3(0), nodes - 1);
    return scene
      .importance[std::size_t((Index(inside.z) * nodes.y + inside.y) * nodes.x + inside.x)];
  };
  std::vector<float> values(10, at(node)); // an eleventh comes with its neighbours
  for (int dz = -1; dz <= 1; ++dz)
  {
    for (int dy = -1; dy <= 1; ++dy)
    {
      for (int dx = -1; dx <= 1; ++dx)
      {
        values.push_back(at(node + Int3(dx, dy, dz)));
      }
    }
  }
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Importance in a ball and specks all over; half of the nodes have no extinction.
BoxScene Speckled(const Int3& nodes, unsigned seed)
{
  BoxScene scene(nodes, Vec3(-1), Vec3(0.1));
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  scene.ForEachNode(
    [&](std::size_t node, int i, int j, int k)
    {
      const double distance = glm::length(Vec3(i, j, k) - 0.5 * Vec3(nodes)) / nodes.x;
      const bool speck = unit(random) < 0.15f;
      scene.importance[node] = distance < 0.25 || speck ? unit(random) : 0.0f;
      scene.extinction[node] = unit(random) < 0.5f ? unit(random) : 0.0f;
    });
  return scene;
}
}

TEST(Despeckle, IsTheCentreWeightedMedian)
{
  for (const Int3& nodes : { Int3(1, 1, 1), Int3(2, 5, 1), Int3(15, 4, 3), Int3(16, 33, 2),
         Int3(17, 3, 70), Int3(45, 40, 9) })
  {
    const BoxScene scene = Speckled(nodes, 7);
    const std::vector<float> found = Despeckled(scene);
    std::size_t wrong = 0;
    scene.ForEachNode(
      [&](std::size_t node, int i, int j, int k)
      {
        const bool empty = !(scene.extinction[node] > 0) && !(scene.importance[node] > 0);
        wrong += found[node] != (empty ? 0 : MedianAt(scene, { i, j, k })) ? 1 : 0;
      });
    EXPECT_EQ(wrong, 0u) << nodes.x << " x " << nodes.y << " x " << nodes.z;
  }
}

TEST(Despeckle, DoesNotDependOnThreads)
{
  const BoxScene scene = Speckled({ 40, 50, 12 }, 3);
  const std::vector<float> many = Despeckled(scene);
  const ThreadLimit one(1);
  EXPECT_EQ(Despeckled(scene), many);
}

TEST(Despeckle, KeepsVesselsTwoNodesWideAndDropsWhatIsAlone)
{
  BoxScene scene({ 20, 20, 20 }, Vec3(-1), Vec3(0.1));
  std::fill(scene.extinction.begin(), scene.extinction.end(), 1.0f);
  const auto at = [](int i, int j, int k) { return std::size_t((k * 20 + j) * 20 + i); };
  for (int i = 0; i < 20; ++i)
  {
    for (const int j : { 5, 6 })
    {
      scene.importance[at(i, j, 5)] = scene.importance[at(i, j, 6)] = 1;
    }
  }
  const std::vector<float> vessel = scene.importance;
  scene.importance[at(15, 15, 15)] = scene.importance[at(15, 16, 15)] = 1;
  scene.importance[at(15, 15, 16)] = 1;
  EXPECT_EQ(Despeckled(scene), vessel);
}

namespace
{
/// A ball to be seen in fog, and specks of importance in the fog.
BoxScene SpeckledFog()
{
  BoxScene scene = BoxScene::Cube(33);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0, 1);
  scene.Fill([](const Vec3& x) { return glm::length(x) < 0.4 ? 8.0 : 3.0; },
    [&](const Vec3& x) { return glm::length(x) < 0.4 || unit(random) < 0.02f ? 1.0 : 0.0; });
  return scene;
}
}

class DespeckledBy : public ::testing::TestWithParam<SolverKind>
{
};

TEST_P(DespeckledBy, TheSolverWorksWithThatAndScoresWhatWasGiven)
{
  BoxScene scene = SpeckledFog();
  scene.settings.solver = GetParam();
  scene.settings.iterationsPerLevel = { { 4, 4, 8 } };
  BoxScene clean = scene;
  clean.importance = Despeckled(scene);
  Solver given = clean.MakeSolver();
  given.Run();

  scene.settings.importanceSmoothing = ImportanceSmoothing::Median;
  Solver solver = scene.MakeSolver();
  solver.Run();
  EXPECT_EQ(solver.History()[1].score.visibility, 0); // records tell no scores
  // The energy is that of the despeckled importance. Counting scores changes last bits.
  const double energy = given.BestEnergy().Total();
  EXPECT_NEAR(solver.BestEnergy().Total(), energy, 1e-4 * std::abs(energy));

  BoxScene found = scene;
  found.extinction = solver.Extinction();
  found.settings = Settings();
  const Solver judge = found.MakeSolver();
  const double score = judge.BaseScore().visibility;
  EXPECT_WITHIN(solver.BestScore().visibility, score,
    Relative(1e-5, score, "sums of floats in another order of the axes"));
  const BoxScene asGiven = SpeckledFog();
  EXPECT_EQ(solver.BaseScore().visibility, asGiven.MakeSolver().BaseScore().visibility);
}

INSTANTIATE_TEST_SUITE_P(Solvers, DespeckledBy,
  ::testing::Values(SolverKind::Policy, SolverKind::Adam),
  [](const auto& solver) { return solver.param == SolverKind::Policy ? "Policy" : "Adam"; });

TEST(Despeckle, LeavesSpecksAsTheyWere)
{
  BoxScene scene = SpeckledFog();
  scene.settings.protectImportance = 1;
  const std::vector<float> left = Despeckled(scene);
  const Int3 last = scene.grid.nodes - 1;
  // More extinction beside what is left of importance may show more of it.
  const auto isBesideImportance = [&](const Int3& node)
  {
    const Int3 low = glm::max(node - 1, Int3(0));
    const Int3 high = glm::min(node + 1, last);
    float most = 0;
    for (int k = low.z; k <= high.z; ++k)
    {
      for (int j = low.y; j <= high.y; ++j)
      {
        for (int i = low.x; i <= high.x; ++i)
        {
          most = std::max(most, left[std::size_t((k * (last.y + 1) + j) * (last.x + 1) + i)]);
        }
      }
    }
    return most > 0;
  };
  const auto changedSpecks = [&]
  {
    Solver solver = scene.MakeSolver();
    solver.Run();
    int count = 0;
    scene.ForEachNode(
      [&](std::size_t node, int i, int j, int k)
      {
        const bool speck = scene.importance[node] > 0 && !isBesideImportance({ i, j, k });
        count += speck && solver.Extinction()[node] > scene.extinction[node] ? 1 : 0;
      });
    return count;
  };
  EXPECT_GT(changedSpecks(), 100);
  scene.settings.importanceSmoothing = ImportanceSmoothing::Median;
  EXPECT_EQ(changedSpecks(), 0);
}

TEST(Despeckle, OfNothingButSpecksLeavesTheBase)
{
  BoxScene scene = SpeckledFog();
  scene.ForEachNode([&](std::size_t node, int i, int j, int k)
    { scene.importance[node] = i % 8 == 0 && j % 8 == 0 && k % 8 == 0 ? 1.0f : 0.0f; });
  scene.settings.importanceSmoothing = ImportanceSmoothing::Median;
  Solver solver = scene.MakeSolver();
  solver.Run();
  EXPECT_TRUE(solver.Settled());
  // The corners of the box stand for what is beyond, so that a speck there is a larger one.
  std::size_t changed = 0;
  scene.ForEachNode(
    [&](std::size_t node, int i, int j, int k)
    {
      const bool inside = i % 32 != 0 || j % 32 != 0 || k % 32 != 0;
      changed +=
        inside && scene.importance[node] > 0 && solver.Extinction()[node] > scene.extinction[node]
        ? 1
        : 0;
    });
  EXPECT_EQ(changed, 0u);
}
