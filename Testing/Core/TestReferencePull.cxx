// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The pull towards a reference extinction that the caller gives.

#include "BoxScene.h"
#include "PretendedClock.h"
#include "TestedDevice.h"
#include "Tolerance.h"

#include "Resampled.h"
#include "optimize/PreparedScene.h"
#include "optimize/Progressive.h"
#include "optimize/SolverBackend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

using namespace limpid;

namespace
{
constexpr double strong = 1e7; // beside which all other terms are rounding errors

/// An onion with a pull towards `reference`, which lies within the bounds.
struct SceneWithReference
{
  BoxScene scene = BoxScene::Onion();
  std::vector<float> reference;

  SceneWithReference()
  {
    const float majorant = *std::max_element(scene.extinction.begin(), scene.extinction.end());
    std::mt19937 random(5);
    std::uniform_real_distribution<float> value(0, majorant);
    for (std::size_t node = 0; node < scene.extinction.size(); ++node)
    {
      const bool empty = !(scene.extinction[node] > 0) && !(scene.importance[node] > 0);
      reference.push_back(empty ? 0 : value(random));
    }
    scene.settings.referencePull = strong;
  }

  SceneFields Fields() const
  {
    SceneFields fields = scene.Fields();
    fields.references[0] = reference.data();
    return fields;
  }
};

/// Compares with a reference within rounding of the majorant.
void ExpectNear(const float* found, const std::vector<float>& reference, float majorant)
{
  double farthest = 0;
  for (std::size_t node = 0; node < reference.size(); ++node)
  {
    farthest = std::max(farthest, std::abs(double(found[node]) - double(reference[node])));
  }
  EXPECT_WITHIN(farthest, 0.0, Roundoff<float>(16, majorant));
}
}

TEST(ReferencePull, OfLargeWeightReturnsTheReference)
{
  const SceneWithReference with;

  Solver solver(with.Fields(), with.scene.camera, with.scene.light, with.scene.settings);
  solver.Run();

  ExpectNear(solver.Extinction().data(), with.reference, static_cast<float>(solver.Majorant()));
}

TEST(ReferencePull, StaysWithinTheBounds)
{
  SceneWithReference with;
  with.scene.settings.emphasis = 0;

  Solver solver(with.Fields(), with.scene.camera, with.scene.light, with.scene.settings);
  solver.Run();

  std::vector<float> clamped = with.reference;
  for (std::size_t node = 0; node < clamped.size(); ++node)
  {
    clamped[node] = std::min(clamped[node], with.scene.extinction[node]);
  }
  ExpectNear(solver.Extinction().data(), clamped, static_cast<float>(solver.Majorant()));
}

// w/2 sum (mu - reference)^2 dV, from its definition in world units.
TEST(ReferencePull, ReportsItsEnergy)
{
  SceneWithReference with;
  with.scene.settings.referencePull = 0.3;
  with.scene.settings.tolerance = 0; // so that the last iterate is found
  const Weights& weights = with.scene.settings.weights;

  Solver solver(with.Fields(), with.scene.camera, with.scene.light, with.scene.settings);
  solver.Run();

  double squares = 0;
  for (std::size_t node = 0; node < with.reference.size(); ++node)
  {
    squares += std::pow(double(solver.Extinction()[node]) - double(with.reference[node]), 2);
  }
  const double weight = 0.3 * (weights.view + weights.light) / solver.Majorant();
  const double energy = 0.5 * weight * squares * with.scene.grid.CellVolume();
  EXPECT_GT(energy, 0);
  EXPECT_WITHIN(solver.BestEnergy().reference, energy,
    Relative(1e-5, energy, "squares of floats are summed in double precision, row by row"));
}

TEST(ReferencePull, NeedsAReference)
{
  const SceneWithReference with;

  EXPECT_THROW(
    Solver(with.scene.Fields(), with.scene.camera, with.scene.light, with.scene.settings), Error);
}

TEST(ReferencePull, OfNoWeightChangesNothing)
{
  SceneWithReference with;
  with.scene.settings.referencePull = 0;
  Solver ignoring(with.Fields(), with.scene.camera, with.scene.light, with.scene.settings);
  ignoring.Run();
  Solver free(with.scene.Fields(), with.scene.camera, with.scene.light, with.scene.settings);
  free.Run();

  EXPECT_EQ(ignoring.Extinction(), free.Extinction());
}

TEST(ReferencePull, RefusesAReferenceThatIsNoExtinction)
{
  SceneWithReference with;
  with.reference[7] = -1;

  EXPECT_THROW(PreparedScene(with.Fields()), Error);
}

// A preview is on a coarser grid, to which the reference is restricted like all other fields.
TEST(ReferencePull, IsSeenByPreviews)
{
  const SceneWithReference with;
  Progressive progressive(with.Fields(), with.scene.settings);
  progressive.SetView(with.scene.camera, with.scene.light, with.scene.settings);
  const PretendedClock clock(1e-6);

  progressive.Preview(1e-9); // in which nobody gets far

  const Grid& grid = progressive.ShownGrid();
  ASSERT_LT(grid.NodeCount(), with.scene.grid.NodeCount());
  const std::vector<float> coarse = Resampled(with.scene.grid, with.reference.data(), grid);
  const float most = *std::max_element(with.scene.extinction.begin(), with.scene.extinction.end());
  const float mostCoarse = *std::max_element(
    progressive.BaseExtinction(), progressive.BaseExtinction() + grid.NodeCount());
  std::vector<float> clamped = coarse;
  for (std::size_t node = 0; node < clamped.size(); ++node)
  {
    clamped[node] = std::min(clamped[node], mostCoarse);
  }
  ExpectNear(progressive.Extinction(), clamped, most);
}

namespace
{
class ReferencePullOn : public ::testing::TestWithParam<bool>
{
};
}

INSTANTIATE_TEST_SUITE_P(Backends, ReferencePullOn, ::testing::Values(false, true));

TEST_P(ReferencePullOn, ReturnsTheReference)
{
  const SceneWithReference with;
  PreparedScene prepared(with.Fields());
  Problem problem = prepared.ProblemFor(with.scene.camera, with.scene.light, with.scene.settings);
  const std::vector<PullWithReferences> pulls =
    prepared.PullsFor({}, problem, with.scene.camera, with.scene.light);
  ASSERT_EQ(pulls.size(), 1u);
  problem.DrawTo(pulls, false);

  const std::shared_ptr<SolverBackend> backend =
    GetParam() ? MakeSolverBackend(MakeTestedDevice()) : MakeSolverBackend(HostDevice::Shared());
  const auto minimizer = backend->MakeMinimizer(problem, {}, false);
  minimizer->Start();
  const IterationRecord record = minimizer->Iterate();

  EXPECT_GE(record.energy.reference, 0);
  ExpectNear(minimizer->Best().data(), with.reference, prepared.Majorant());
}
