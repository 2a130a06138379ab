// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// CUDA against the processor, by the solver alone. Needs a GPU, or a program with a pretended one
// (Testing/Gpu).

#include "BoxScene.h"
#include "Tolerance.h"

#include "backend/Choice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
struct Content
{
  const char* name;
  Int3 nodes;
  std::function<void(BoxScene&)> fill;
};

std::ostream& operator<<(std::ostream& stream, const Content& content)
{
  return stream << content.name;
}

/// Smooth noise in [0, 1] that leaves nothing empty.
double Waves(const Vec3& x)
{
  return 0.5 + 0.5 * std::sin(7 * x.x + 1) * std::cos(5 * x.y - 2 * x.z) * std::sin(3 * x.z + 0.5);
}

const Content contents[] = {
  { "Onion", { 48, 40, 52 }, [](BoxScene& scene) { scene.FillOnion(); } },
  { "Haze", { 40, 40, 40 },
    [](BoxScene& scene)
    {
      scene.Fill([](const Vec3& x) { return 3 * Waves(x); },
        [](const Vec3& x) { return Waves(Vec3(x.z, x.x, x.y)); });
    } },
  { "Threads", { 56, 30, 44 },
    [](BoxScene& scene)
    {
      const auto thread = [](const Vec3& x, double phase)
      { return std::hypot(x.x - 0.5 * std::sin(3 * x.z + phase), x.y - 0.2 * phase) < 0.08; };
      scene.Fill([=](const Vec3& x) { return thread(x, 0) || thread(x, 2) ? 30 : 0; },
        [=](const Vec3& x) { return thread(x, 2) ? 1 : 0; });
    } },
  { "Wall", { 33, 33, 33 },
    [](BoxScene& scene)
    {
      scene.Fill([](const Vec3& x) { return x.z < -0.4 ? 50
                                       : x.z > 0.3     ? 5
                                                       : 0.1; },
        [](const Vec3& x) { return x.z > 0.3 ? 0.8 : 0.0; });
    } },
  { "Slab", { 70, 64, 4 },
    [](BoxScene& scene)
    {
      scene.Fill([](const Vec3& x) { return 10 * Waves(2.0 * x); },
        [](const Vec3& x) { return glm::length(x) < 0.5 ? 1 : 0; });
    } },
};

/// What a run ends with.
struct Outputs
{
  std::string backend;
  IterationRecord record;
  Score base;
  Score best;
  std::vector<float> extinction; ///< [majorant]
  std::vector<float> transmittance;
  std::vector<float> lightTransmittance;
};

Outputs Optimize(BoxScene& scene, BackendKind backend, int iterations)
{
  scene.settings.backend = backend;
  Solver solver = scene.MakeSolver();
  solver.Step(iterations);
  Outputs outputs;
  outputs.backend = solver.BackendName();
  outputs.record = solver.History().back();
  outputs.base = solver.BaseScore();
  outputs.best = solver.BestScore();
  outputs.extinction = solver.Extinction();
  for (float& value : outputs.extinction)
  {
    value = static_cast<float>(value / solver.Majorant());
  }
  outputs.transmittance.resize(outputs.extinction.size());
  solver.Transmittance(outputs.transmittance.data());
  outputs.lightTransmittance.resize(outputs.extinction.size());
  solver.LightTransmittance(outputs.lightTransmittance.data());
  return outputs;
}

double RootMeanSquare(const std::vector<float>& one, const std::vector<float>& other)
{
  double squares = 0;
  for (std::size_t node = 0; node < one.size(); ++node)
  {
    squares += std::pow(double(one[node]) - double(other[node]), 2);
  }
  return std::sqrt(squares / double(one.size()));
}

/// The bar for all outputs, relative to the largest values there can be.
Tolerance OtherRounding()
{
  return Tolerance{ 1e-4, "the same sums in another order, in single precision" };
}

void ExpectSame(const Outputs& there, const Outputs& here)
{
  const double scale = std::abs(here.record.energy.view) + std::abs(here.record.energy.light);
  const Tolerance energy = Relative(OtherRounding().value, scale, OtherRounding().reason);
  EXPECT_WITHIN(there.record.energy.view, here.record.energy.view, energy);
  EXPECT_WITHIN(there.record.energy.light, here.record.energy.light, energy);
  EXPECT_WITHIN(there.record.energy.regularization, here.record.energy.regularization, energy);
  EXPECT_WITHIN(there.record.meanChange, here.record.meanChange, OtherRounding());
  EXPECT_WITHIN(there.base.visibility / here.base.visibility, 1, OtherRounding());
  EXPECT_WITHIN(there.best.visibility / here.best.visibility, 1, OtherRounding());
  EXPECT_WITHIN(there.best.fraction, here.best.fraction, OtherRounding());
  // Root mean square: where nothing is at stake, rounding decides about a voxel.
  EXPECT_WITHIN(RootMeanSquare(there.extinction, here.extinction), 0, OtherRounding());
  EXPECT_WITHIN(RootMeanSquare(there.transmittance, here.transmittance), 0, OtherRounding());
  EXPECT_WITHIN(
    RootMeanSquare(there.lightTransmittance, here.lightTransmittance), 0, OtherRounding());
}
}

class Backends : public ::testing::TestWithParam<Content>
{
protected:
  void SetUp() override
  {
    if (!FindCuda().usable)
    {
      GTEST_SKIP() << FindCuda().reason;
    }
  }

  BoxScene Scene() const
  {
    const Int3 nodes = GetParam().nodes;
    BoxScene scene(nodes, Vec3(-1), 2.0 / Vec3(nodes - 1));
    GetParam().fill(scene);
    return scene;
  }
};

TEST_P(Backends, AgreeAfterAnIteration)
{
  BoxScene scene = this->Scene();

  const Outputs here = Optimize(scene, BackendKind::Cpu, 1);
  const Outputs there = Optimize(scene, BackendKind::Cuda, 1);

  EXPECT_NE(there.backend.find("CUDA"), std::string::npos) << there.backend;
  ExpectSame(there, here);
}

TEST_P(Backends, AgreeAfterAStepOfAdam)
{
  BoxScene scene = this->Scene();
  scene.settings.solver = SolverKind::Adam;
  scene.settings.iterationsPerLevel = { { 0, 0, 1 } };

  const Outputs here = Optimize(scene, BackendKind::Cpu, 1);
  const Outputs there = Optimize(scene, BackendKind::Cuda, 1);

  ExpectSame(there, here);
}

TEST_P(Backends, AgreeOnTheScoreOfTheOptimum)
{
  for (const SolverKind solver : { SolverKind::Policy, SolverKind::Adam })
  {
    BoxScene scene = this->Scene();
    scene.settings.solver = solver;
    scene.settings.iterationsPerLevel = { { 6, 6, 12 } };

    const Outputs here = Optimize(scene, BackendKind::Cpu, 24);
    const Outputs there = Optimize(scene, BackendKind::Cuda, 24);

    EXPECT_WITHIN(there.best.visibility / here.best.visibility, 1,
      (Tolerance{ 1e-3, "an iteration makes roundings larger; the bar for a score" }));
  }
}

TEST_P(Backends, CudaGivesTheSameBitsTwice)
{
  for (const SolverKind solver : { SolverKind::Policy, SolverKind::Adam })
  {
    BoxScene scene = this->Scene();
    scene.settings.solver = solver;
    scene.settings.iterationsPerLevel = { { 2, 2, 4 } };

    const Outputs once = Optimize(scene, BackendKind::Cuda, 8);
    const Outputs again = Optimize(scene, BackendKind::Cuda, 8);

    EXPECT_EQ(once.record.energy.view, again.record.energy.view);
    EXPECT_EQ(once.record.energy.light, again.record.energy.light);
    EXPECT_EQ(once.record.energy.regularization, again.record.energy.regularization);
    EXPECT_EQ(once.extinction, again.extinction);
    EXPECT_EQ(once.transmittance, again.transmittance);
    EXPECT_EQ(once.lightTransmittance, again.lightTransmittance);
  }
}

INSTANTIATE_TEST_SUITE_P(
  Scenes, Backends, ::testing::ValuesIn(contents), ::testing::PrintToStringParamName());
