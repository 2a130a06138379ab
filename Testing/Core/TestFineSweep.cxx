// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A change that was found on a coarser grid is improved by a sweep at the resolution of the data,
// whose fields are made where the sweep is.

#include "BoxScene.h"
#include "SceneInBoxes.h"

#include "backend/HostDevice.h"
#include "optimize/ControlledScene.h"
#include "optimize/FineFields.h"
#include "optimize/PolicyTurns.h"
#include "optimize/Smoothing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

using namespace limpid;

namespace
{
/// An onion of uneven size, with specks, seen along an axis.
BoxScene SeenAlong(int axis, double sign)
{
  BoxScene scene(Int3(43, 38, 47), Vec3(1, 2, 3), Vec3(0.1, 0.12, 0.09));
  scene.FillOnion();
  for (std::size_t node = 100; node < scene.importance.size(); node += 997)
  {
    scene.importance[node] = 1;
  }
  Vec3 towards(0.21, 0.34, -0.28);
  towards[axis] = sign;
  scene.camera.position = scene.grid.Centre() + 3.0 * scene.grid.Radius() * towards;
  Vec3 above(0.3, -0.2, 0.25);
  above[(axis + 1) % 3] = 1;
  scene.light.position = scene.grid.Centre() + 3.0 * scene.grid.Radius() * above;
  scene.camera.viewUp = axis == 1 ? Vec3(0, 0, 1) : Vec3(0, 1, 0);
  return scene;
}

/// A result of half resolution, and what a sweep of the data makes of it.
struct Swept
{
  std::vector<float> before;
  std::vector<float> after;
  ScoresOnData scores;
  CarriedChange change;
  double majorant = 0;
};

Swept SweepOf(const BoxScene& scene, int factor = 2, const Progress& progress = {})
{
  SceneFields data;
  data.grid = scene.grid;
  ControlledScene controlled(
    data, BoxesOf(scene), Coarser(factor), scene.settings.importanceSmoothing);
  auto solver =
    std::make_unique<Solver>(controlled.Fields(), scene.camera, scene.light, scene.settings);
  solver->Run(controlled.OfSolver(progress, scene.settings));
  Swept swept;
  swept.before.resize(scene.extinction.size());
  controlled.FillExtinction(*solver, swept.before.data(), nullptr);
  swept.after.assign(swept.before.size(), -1.0f);
  swept.change = solver->Change();
  swept.majorant = solver->Majorant();
  swept.scores = controlled.SweepData(std::move(solver), progress, swept.after.data());
  return swept;
}

/// Returns the result of this sweep with all fields in memory.
std::vector<float> SweptInMemory(const BoxScene& scene, const Swept& of)
{
  const FieldsOfBox boxes = BoxesOf(scene);
  const auto majorant = static_cast<float>(of.majorant);
  FineFields fields(scene.grid, boxes, of.change, majorant);
  fields.Survey();
  fields.MoveTo(NodeBox::Of(scene.grid.nodes),
    { fields.Importance(), fields.NodeImportance(), fields.Changed() });
  const auto all = [&](const float* field)
  {
    const float* values = fields.Values(field).values;
    return std::vector<float>(values, values + scene.grid.NodeCount());
  };
  const std::vector<float> importance = all(fields.Importance());
  const std::vector<float> nodeImportance = all(fields.NodeImportance());
  const std::vector<float> changed = all(fields.Changed());
  Problem problem;
  problem.grid = scene.grid;
  problem.baseExtinction = scene.extinction.data();
  problem.importance = importance.data();
  problem.nodeImportance = nodeImportance.data();
  problem.occupancy = fields.Occupied();
  problem.majorant = majorant;
  problem.sources = SourcesOf(scene.camera, scene.light, scene.settings, scene.grid);
  problem.settings = scene.settings;
  problem.tellsScores = false;
  const auto device = HostDevice::Shared();
  Terms<HostDevice> energy(device, problem);
  const PolicyTurns<HostDevice> turns(problem, energy, true);
  const bool smooths = scene.settings.smoothness > 0;
  const PolicyTurn<HostDevice> turn = smooths ? turns.Smoothing(0) : turns.Of(0);
  energy.MeasureTerm(*turn.swept, changed.data());
  std::vector<float> lagged(changed.size());
  for (EnergyTerm<HostDevice>* other : turn.others)
  {
    energy.DifferentiateTerm(*other, changed.data(), 0, lagged.data());
  }
  if (smooths)
  {
    FindPull(*device,
      { scene.grid.nodes, scene.extinction.data(), importance.data(), changed.data(), lagged.data(),
        static_cast<float>(turn.smoothing), lagged.data() },
      { 0, scene.grid.nodes.z });
  }
  std::vector<Pull> pulls = energy.Pulls();
  pulls.push_back({ scene.extinction.data(), turn.smoothing });
  std::vector<float> next = of.before;
  ExactDifferences moved;
  PolicySweep sweep{ changed.data(), lagged.data(), next.data(), turn.swept->Weight(), pulls,
    turn.transmittance, Kept::Ignored };
  sweep.alternative = turn.weighs ? scene.extinction.data() : nullptr;
  sweep.reach = turn.reach;
  SweepPolicy(*device, *turn.swept, energy, problem, sweep, moved);
  return next;
}

class FineSweep : public ::testing::TestWithParam<std::tuple<int, double, bool, double>>
{
};
}

TEST_P(FineSweep, HasTheBitsOfASweepWithFieldsInMemory)
{
  const auto [axis, sign, smooths, protect] = GetParam();
  BoxScene scene = SeenAlong(axis, sign);
  scene.settings.smoothness = smooths ? scene.settings.smoothness : 0;
  scene.settings.protectImportance = protect;
  scene.settings.emphasis = smooths ? 0.4 : 0;
  const Swept swept = SweepOf(scene);
  EXPECT_NE(swept.after, swept.before);
  EXPECT_EQ(swept.after, SweptInMemory(scene, swept));
}

INSTANTIATE_TEST_SUITE_P(Axes, FineSweep,
  ::testing::Combine(::testing::Values(0, 1, 2), ::testing::Values(1.0, -1.0), ::testing::Bool(),
    ::testing::Values(0.0, 0.6)));

TEST(FineSweep, ShowsAlmostWhatFullResolutionShows)
{
  for (const int axis : { 0, 1, 2 })
  {
    const BoxScene scene = SeenAlong(axis, 1);
    const Swept swept = SweepOf(scene, 4);
    Solver whole = scene.MakeSolver();
    whole.Run();
    const double base = scene.TrueScore(scene.extinction);
    const double full = scene.TrueScore(whole.Extinction()) - base;
    const double before = scene.TrueScore(swept.before) - base;
    const double after = scene.TrueScore(swept.after) - base;
    EXPECT_LT(before, 0.9 * full);
    EXPECT_GT(after, 0.97 * full);
    // Scores are those of the data, by two quadratures of second order.
    EXPECT_NEAR(swept.scores.result.visibility, base + after, 0.01 * (base + after));
    EXPECT_NEAR(swept.scores.base.visibility, whole.BaseScore().visibility, 1e-6 * (base + after));
  }
}

TEST(FineSweep, StaysWithinTheBoundsOfTheData)
{
  BoxScene scene = SeenAlong(2, 1);
  scene.settings.protectImportance = 0.5;
  scene.settings.emphasis = 0;
  scene.settings.importanceSmoothing = ImportanceSmoothing::Off;
  const std::vector<float> after = SweepOf(scene, 3).after;
  for (std::size_t node = 0; node < after.size(); ++node)
  {
    ASSERT_LE(after[node], scene.extinction[node]);
    ASSERT_GE(after[node], 0.5f * scene.importance[node] * scene.extinction[node] * (1 - 1e-6f));
  }
}

TEST(FineSweep, SeesFromWithin)
{
  BoxScene scene = SeenAlong(2, 1);
  scene.camera.position = scene.grid.Centre() + 0.3 * scene.grid.Radius() * Vec3(0.4, 0.1, 0.7);
  scene.camera.viewAngle = 140;
  const Swept swept = SweepOf(scene);
  EXPECT_EQ(swept.after, SweptInMemory(scene, swept));
  EXPECT_GE(swept.scores.result.visibility, swept.scores.base.visibility);
}

TEST(FineSweep, IsAPartOfTheProgress)
{
  std::vector<double> shares;
  std::vector<std::string> texts;
  SweepOf(SeenAlong(2, 1), 2,
    [&](double share, const std::string& text)
    {
      shares.push_back(share);
      texts.push_back(text);
      return true;
    });
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_GT(shares.front(), 0);
  EXPECT_LT(shares.back(), 1);
  EXPECT_EQ(texts.back(), "Sweep at the resolution of the data");
  EXPECT_NE(texts.front(), texts.back());
}

TEST(FineSweep, CanBeStopped)
{
  const std::string sweep = "Sweep at the resolution of the data";
  const BoxScene scene = SeenAlong(0, 1);
  for (int steps = 0; steps < 3; ++steps)
  {
    int left = steps;
    const Swept swept = SweepOf(
      scene, 2, [&](double, const std::string& text) { return text != sweep || left-- > 0; });
    EXPECT_EQ(swept.after, swept.before);
    EXPECT_GE(swept.scores.result.visibility, swept.scores.base.visibility);
  }
}

TEST(FineSweep, NeedsPolicySweepsOfOneCameraForOneExtinction)
{
  EXPECT_TRUE(CanSweepData(Settings()));
  const auto refuses = [](const auto& change)
  {
    Settings settings;
    change(settings);
    return !CanSweepData(settings);
  };
  EXPECT_TRUE(refuses([](Settings& of) { of.mode = Mode::Separate; }));
  EXPECT_TRUE(refuses([](Settings& of) { of.weights.view = 0; }));
  EXPECT_TRUE(refuses([](Settings& of) { of.otherCameras.resize(1); }));
  EXPECT_TRUE(refuses([](Settings& of) { of.solver = SolverKind::Adam; }));
  EXPECT_TRUE(refuses([](Settings& of) { of.maximumIterations = 0; }));
  EXPECT_TRUE(refuses([](Settings& of) { of.temporalCoherence = 0.1; }));
  EXPECT_TRUE(refuses([](Settings& of) { of.referencePull = 0.1; }));
}

TEST(FineSweep, LeavesWhatNeedsNoChange)
{
  for (const bool important : { false, true })
  {
    BoxScene scene = SeenAlong(2, 1);
    std::fill(scene.importance.begin(), scene.importance.end(), important ? 1.0f : 0.0f);
    const Swept swept = SweepOf(scene);
    EXPECT_TRUE(
      std::all_of(swept.after.begin(), swept.after.end(), [](float value) { return value >= 0; }));
    EXPECT_GE(swept.scores.result.visibility, swept.scores.base.visibility);
    EXPECT_LE(swept.scores.result.fraction, swept.scores.ceiling.fraction * (1 + 1e-9));
    if (!important)
    {
      EXPECT_EQ(swept.after, scene.extinction);
    }
  }
}
