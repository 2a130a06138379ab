// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The list of pulls: a pull towards any reference is an entry in it, for every minimiser and
// device.

#include "BoxScene.h"
#include "TestedDevice.h"
#include "Tolerance.h"

#include "backend/HostDevice.h"
#include "optimize/PreparedScene.h"
#include "optimize/SolverBackend.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

using namespace limpid;

namespace
{
/// A little absorption everywhere, and importance in front only: nothing behind it matters.
BoxScene LampInFog(SolverKind solver)
{
  BoxScene scene = BoxScene::Cube(17);
  scene.camera.position = Vec3(0, 0, -4);
  scene.settings.weights.light = 0;
  scene.settings.weights.regularization = 5;
  scene.settings.solver = solver;
  scene.settings.iterationsPerLevel = { { 8, 8, 300 } };
  scene.Fill([](const Vec3&) { return 0.5; },
    [](const Vec3& x) { return glm::length(x - Vec3(0, 0, -0.75)) < 0.2 ? 1.0 : 0.0; });
  return scene;
}

std::vector<float> AnyReference(const BoxScene& scene)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<float> value(0.1f, 0.45f);
  std::vector<float> reference(scene.extinction.size());
  for (float& node : reference)
  {
    node = value(random);
  }
  return reference;
}

/// The summand of the energy that the pulls of these tests are reported in.
double& Coherence(Energy& energy)
{
  return energy.coherence;
}

struct Case
{
  SolverKind solver;
  bool onDevice;
};

class Pulled : public ::testing::TestWithParam<Case>
{
protected:
  std::shared_ptr<SolverBackend> Backend() const
  {
    return GetParam().onDevice ? MakeSolverBackend(MakeTestedDevice())
                               : MakeSolverBackend(HostDevice::Shared());
  }
};
}

INSTANTIATE_TEST_SUITE_P(Pulls, Pulled,
  ::testing::Values(Case{ SolverKind::Policy, false }, Case{ SolverKind::Policy, true },
    Case{ SolverKind::Adam, false }, Case{ SolverKind::Adam, true }),
  [](const auto& one)
  {
    return std::string(one.param.solver == SolverKind::Policy ? "Policy" : "Adam") +
      (one.param.onDevice ? "OnDevice" : "OnProcessor");
  });

// Where nothing is at stake, the sum of w (mu - reference) over all pulls vanishes.
TEST_P(Pulled, EndsAtTheWeightedMeanOfTheReferences)
{
  const BoxScene scene = LampInFog(GetParam().solver);
  PreparedScene prepared(scene.Fields());
  const std::vector<float> reference = AnyReference(scene);
  Problem problem = prepared.ProblemFor(scene.camera, scene.light, scene.settings);
  const double p = problem.RegularizationWeight();
  const double weight = 2 * p;
  problem.furtherPulls = { { reference.data(), weight, Coherence } };

  const std::shared_ptr<SolverBackend> backend = this->Backend();
  const auto minimizer = backend->MakeMinimizer(problem, {}, false);
  IterationRecord record = minimizer->Start();
  for (int made = 0; made < minimizer->IterationLimit() && !minimizer->Converged(); ++made)
  {
    record = minimizer->Iterate();
  }

  const std::vector<float>& found = minimizer->Best();
  // Adam goes to and fro about the minimum by a step at most.
  const bool isAdam = GetParam().solver == SolverKind::Adam;
  const Tolerance step{ isAdam ? scene.settings.learningRate * prepared.Majorant() : 0.0,
    "length of a step of Adam" };
  double squares = 0;
  for (std::size_t node = 0; node < found.size(); ++node)
  {
    const double to = reference[node];
    squares += std::pow(found[node] - to, 2);
    if (node >= 9 * 17 * 17) // behind all that is important
    {
      const double wanted = (p * 0.5 + weight * to) / (p + weight);
      EXPECT_WITHIN(found[node], wanted, Roundoff<float>(8, 1) + step);
    }
  }
  EXPECT_GT(record.energy.coherence, 0);
  if (!isAdam) // the last iterate is the best
  {
    const double energy = 0.5 * weight * squares * scene.grid.CellVolume();
    EXPECT_WITHIN(record.energy.coherence, energy,
      Relative(1e-5, energy, "squares of floats are summed in double precision, row by row"));
  }
}

// A preview sweeps once, and a pull that is much stronger than all else leaves no choice.
TEST_P(Pulled, PreviewsEndAtAStrongReference)
{
  const BoxScene scene = LampInFog(GetParam().solver);
  PreparedScene prepared(scene.Fields());
  const std::vector<float> reference = AnyReference(scene);
  Problem problem = prepared.ProblemFor(scene.camera, scene.light, scene.settings);
  problem.furtherPulls = { { reference.data(), 1e9, Coherence } };
  std::vector<float> found = scene.extinction;

  const std::shared_ptr<SolverBackend> backend = this->Backend();
  backend->SweepsFrom(problem, problem.Camera())->SweepPolicyOnce(10, found);

  for (std::size_t node = 0; node < found.size(); ++node)
  {
    EXPECT_WITHIN(found[node], reference[node], Roundoff<float>(16, 1));
  }
}

TEST(Pulls, ToTheBaseAddUpAndOthersHaveASlotEach)
{
  const float base = 1;
  const float one = 2;
  const float other = 3;

  const PullsOfKernel pulls({ { &base, 0.5 }, { &one, 0.25 }, { &base, 2 }, { &other, 4 } }, &base);

  EXPECT_EQ(pulls.toBase, 2.5);
  EXPECT_EQ(pulls.all, 6.75);
  EXPECT_EQ(pulls.references[0], &one);
  EXPECT_EQ(pulls.weights[0], 0.25);
  EXPECT_EQ(pulls.references[1], &other);
  EXPECT_EQ(pulls.weights[1], 4);
}

// A central difference of the energy, the sum of w/2 (mu - reference)^2, is its derivative.
TEST(Pulls, HaveTheDerivativeOfTheirEnergy)
{
  const float base = 1;
  const float one = 2;
  const float other = 3;
  const std::vector<Pull> pulls{ { &base, 0.5 }, { &one, 0.25 }, { &other, 4 } };
  const auto at = PullsAtVoxels<float>::Of(pulls, &base);
  const auto energy = [&](double mu)
  {
    double sum = 0;
    for (const Pull& pull : pulls)
    {
      sum += 0.5 * pull.weight * std::pow(mu - double(*pull.reference), 2);
    }
    return sum;
  };

  const float slope = at.AddedTo(0.125f, 1.5f, base, 0);

  // All these numbers and their products are exact, and the energy is quadratic.
  EXPECT_EQ(slope, 0.125 + (energy(1.75) - energy(1.25)) / 0.5);
  EXPECT_EQ(at.Weight(), 4.75);
}
