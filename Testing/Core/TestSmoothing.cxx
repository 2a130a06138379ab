// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What draws the changes of neighbours together: its sums, its closed forms, and what comes of it.

#include "BoxScene.h"
#include "TestedDevice.h"
#include "Tolerance.h"

#include "backend/HostDevice.h"
#include "math/Require.h"
#include "optimize/ResilientVoxel.h"
#include "optimize/Smoothing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace limpid;

namespace
{
struct Fields
{
  Int3 nodes;
  std::vector<float> base, importance, last, lagged, pull;

  explicit Fields(const Int3& size)
    : nodes(size)
  {
    const auto count = std::size_t(Index(size.x) * size.y * size.z);
    for (std::vector<float>* field : { &base, &importance, &last, &lagged, &pull })
    {
      field->assign(count, 0.0f);
    }
  }

  std::size_t At(int i, int j, int k) const
  {
    return std::size_t((Index(k) * this->nodes.y + j) * this->nodes.x + i);
  }

  SmoothedNode Body(float strength, bool lags)
  {
    return { this->nodes, this->base.data(), this->importance.data(), this->last.data(),
      lags ? this->lagged.data() : nullptr, strength, this->pull.data() };
  }
};

Fields AtRandom(const Int3& nodes)
{
  Fields fields(nodes);
  std::mt19937 random(11);
  std::uniform_real_distribution<float> unit(0, 1);
  for (std::size_t node = 0; node < fields.base.size(); ++node)
  {
    const bool empty = unit(random) < 0.3f;
    const bool moved =
      int(node) / nodes.x % 5 > 2; // rows that have changed, and rows that have not
    fields.base[node] = empty ? 0.0f : unit(random);
    fields.importance[node] = empty ? 0.0f : unit(random);
    fields.last[node] = empty ? 0.0f : moved ? 2 * unit(random) : fields.base[node];
    fields.lagged[node] = unit(random);
  }
  return fields;
}

/// From the definition, in double precision: weights 1 / 2^steps of the neighbours.
double PullAt(const Fields& fields, const Int3& node, double strength, bool lags)
{
  double sum = 0;
  double weights = 0;
  const auto changeAt = [&](std::size_t at)
  { return double(fields.last[at]) - double(fields.base[at]); };
  const std::size_t own = fields.At(node.x, node.y, node.z);
  for (int dz = -1; dz <= 1; ++dz)
  {
    for (int dy = -1; dy <= 1; ++dy)
    {
      for (int dx = -1; dx <= 1; ++dx)
      {
        const Int3 other = node + Int3(dx, dy, dz);
        const bool inside = glm::clamp(other, Int3(0), fields.nodes - 1) == other;
        const int steps = std::abs(dx) + std::abs(dy) + std::abs(dz);
        if (!inside || steps == 0)
        {
          continue;
        }
        const std::size_t at = fields.At(other.x, other.y, other.z);
        if (fields.base[at] > 0 || fields.last[at] > 0)
        {
          sum += std::pow(0.5, steps) * changeAt(at);
          weights += std::pow(0.5, steps);
        }
      }
    }
  }
  const double c = changeAt(own);
  const double m = weights > 0 ? sum / weights : c;
  const double g = fields.importance[own];
  const double k = m > c ? (c < 0 ? 0.5 : 1.0) : (c > 0 ? 1.0 : 3 * (1 - g) * (1 - g));
  const bool filled = fields.base[own] > 0 || fields.last[own] > 0;
  const double a = filled ? std::max(c + k * (m - c), -double(fields.base[own])) : 0.0;
  return (lags ? double(fields.lagged[own]) : 0.0) - strength * a;
}

template <class AnyDevice>
void ExpectPull(AnyDevice& device, const Int3& nodes, bool lags)
{
  Fields fields = AtRandom(nodes);
  FindPull(device, fields.Body(0.7f, lags), { 0, nodes.z });
  for (int k = 0; k < nodes.z; ++k)
  {
    for (int j = 0; j < nodes.y; ++j)
    {
      for (int i = 0; i < nodes.x; ++i)
      {
        // Sums of 27 floats up to 2, divided by what may be as little as an eighth of the weights.
        EXPECT_NEAR(fields.pull[fields.At(i, j, k)], PullAt(fields, { i, j, k }, 0.7, lags), 1e-5)
          << i << " " << j << " " << k;
      }
    }
  }
}
}

TEST(Smoothing, PullsAsDefined)
{
  HostDevice processor;
  const auto device = MakeTestedDevice();
  for (const Int3& nodes : { Int3(1, 1, 1), Int3(9, 1, 4), Int3(3, 37, 5), Int3(33, 40, 3) })
  {
    ExpectPull(processor, nodes, true);
    ExpectPull(processor, nodes, false);
    ExpectPull(*device, nodes, true);
  }
}

TEST(Smoothing, LeavesAUniformChangeAsItIs)
{
  for (const float g : { 0.0f, 0.4f, 1.0f })
  {
    EXPECT_EQ((SmoothedChange<float>{ 2, -1, g })(-1), -1);
    EXPECT_EQ((SmoothedChange<float>{ 2, 3, g })(3), 3);
  }
}

TEST(Smoothing, ClearsUnimportantMatterMoreReadilyAndNeverImportantMatter)
{
  EXPECT_EQ((SmoothedChange<float>{ 2, 0, 0 })(-0.5f), -1.5f);
  EXPECT_EQ((SmoothedChange<float>{ 2, 0, 0 })(-1.0f), -2.0f); // all of it: not below zero
  EXPECT_EQ((SmoothedChange<float>{ 2, 0, 1 })(-1.0f), 0.0f);
  EXPECT_EQ((SmoothedChange<float>{ 2, -2, 0 })(-1.0f), -1.5f); // comes back half as readily
}

namespace
{
/// A ball in fog that is as dense as noise makes it.
BoxScene NoisyFog()
{
  BoxScene scene = BoxScene::Cube(41);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  scene.Fill([&](const Vec3& x) { return glm::length(x) < 0.4 ? 20.0 : 12 * unit(random); },
    [](const Vec3& x) { return glm::length(x) < 0.4 ? 1.0 : 0.0; });
  return scene;
}

/// Total variation of the change over its sum.
double VariationOf(const BoxScene& scene, const std::vector<float>& extinction)
{
  const int n = scene.grid.nodes.x;
  double variation = 0;
  double sum = 0;
  const auto changeAt = [&](std::size_t node)
  { return double(extinction[node]) - double(scene.extinction[node]); };
  scene.ForEachNode(
    [&](std::size_t node, int i, int j, int k)
    {
      sum += std::abs(changeAt(node));
      variation += i + 1 < n ? std::abs(changeAt(node + 1) - changeAt(node)) : 0;
      variation += j + 1 < n ? std::abs(changeAt(node + std::size_t(n)) - changeAt(node)) : 0;
      variation += k + 1 < n ? std::abs(changeAt(node + std::size_t(n * n)) - changeAt(node)) : 0;
    });
  return variation / sum;
}
}

// Where nothing else acts, a resilient step ends where the pull of smoothing leads, as a policy
// sweep does, and not a step length away.
TEST(Smoothing, EndsResilientStepsWhereItPulls)
{
  constexpr float sigma = 0.5f;
  constexpr float base = 1.0f;
  constexpr float importance = 0.0f;
  for (const float change : { 0.0f, -0.01f, -0.3f })
  {
    const float gradient = -sigma * change;
    float extinction = base;
    float state = 0.4f; // a step length that the derivative does not reduce
    ResilientVoxel step{};
    step.gradient = &gradient;
    step.base = &base;
    step.importance = &importance;
    step.state = &state;
    step.extinction = &extinction;
    step.pulls = PullsAtVoxels<float>::Of({ { &base, sigma } }, &base);
    step.smooths = true;
    step.longest = 0.4f;
    step.bounds.majorant = 10;

    step(0);

    // The slope, its ratio to sigma and the difference are rounded, each relative to the base.
    EXPECT_WITHIN(extinction, base + change, Roundoff<float>(4, base));
  }
}

class SmoothedBy : public ::testing::TestWithParam<SolverKind>
{
};

TEST_P(SmoothedBy, ChangesVaryLessAndLittleIsLost)
{
  BoxScene scene = NoisyFog();
  scene.settings.solver = GetParam();
  scene.settings.iterationsPerLevel = { { 8, 8, 24 } };
  Solver rough = scene.MakeSolver();
  rough.Run();
  scene.settings.smoothness = 0.2;
  Solver smooth = scene.MakeSolver();
  smooth.Run();

  EXPECT_LT(VariationOf(scene, smooth.Extinction()), 0.9 * VariationOf(scene, rough.Extinction()));
  EXPECT_GT(smooth.BestScore().visibility, 0.97 * rough.BestScore().visibility);
  const std::vector<IterationRecord>& history = smooth.History();
  for (std::size_t i = 0; i < history.size(); ++i)
  {
    EXPECT_EQ(history[i].isResult, i + smoothingSweeps >= history.size()) << i;
  }
  // What is kept is what was smoothed last, not what had the least energy.
  EXPECT_EQ(smooth.BestEnergy().Total(), history.back().energy.Total());
}

INSTANTIATE_TEST_SUITE_P(Solvers, SmoothedBy,
  ::testing::Values(SolverKind::Policy, SolverKind::Adam),
  [](const auto& solver) { return solver.param == SolverKind::Policy ? "Policy" : "Adam"; });

TEST(Smoothing, KeepsTheBoundsAndWhatIsEmpty)
{
  for (const double protect : { 0.0, 0.8 })
  {
    for (const Mode mode : { Mode::Joint, Mode::Separate })
    {
      BoxScene scene({ 30, 33, 28 }, Vec3(-1), Vec3(0.1));
      scene.FillOnion();
      scene.settings.smoothness = 1;
      scene.settings.mode = mode;
      scene.settings.protectImportance = protect;
      Solver solver = scene.MakeSolver();
      solver.Run();
      std::size_t wrong = 0;
      for (std::size_t node = 0; node < scene.extinction.size(); ++node)
      {
        const float found = solver.Extinction()[node];
        const auto share = static_cast<float>(protect) * scene.importance[node];
        const bool empty = !(scene.extinction[node] > 0) && !(scene.importance[node] > 0);
        const bool inBounds =
          found >= share * scene.extinction[node] && found <= float(solver.Majorant());
        wrong += !inBounds || (empty && found != 0) ? 1 : 0;
      }
      EXPECT_EQ(wrong, 0u);
    }
  }
}

TEST(Smoothing, NothingToSeeNothingToSmooth)
{
  BoxScene scene = NoisyFog();
  scene.settings.smoothness = 1;
  scene.settings.maximumIterations = 0; // as it is
  Solver untouched = scene.MakeSolver();
  untouched.Run();
  EXPECT_EQ(untouched.Iterations(), 0);
  EXPECT_EQ(untouched.Extinction(), scene.extinction);
  scene.settings.maximumIterations = 8;
  scene.importance.assign(scene.importance.size(), 0.0f);
  Solver solver = scene.MakeSolver();
  solver.Run();
  EXPECT_EQ(solver.Extinction(), scene.extinction);
}

TEST(Smoothing, OutOfRangeIsRefused)
{
  for (const double smoothness : { -0.1, 11.0, std::numeric_limits<double>::quiet_NaN() })
  {
    BoxScene scene = NoisyFog();
    scene.settings.smoothness = smoothness;
    EXPECT_THROW(scene.MakeSolver(), Error) << smoothness;
  }
}
