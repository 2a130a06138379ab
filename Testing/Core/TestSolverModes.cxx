// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Modes and settings of the solver: separate fields, lights, restricted view, starts and limits.

#include "BoxScene.h"
#include "Tolerance.h"

#include "math/Require.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
std::vector<float> Optimized(const BoxScene& scene)
{
  Solver solver = scene.MakeSolver();
  solver.Run();
  return solver.Extinction();
}
}

TEST(SolverModes, SeparateIsOneRunForTheCameraAndOneForTheLight)
{
  BoxScene scene = BoxScene::Onion(21);
  scene.settings.mode = Mode::Separate;
  Solver separate = scene.MakeSolver();
  separate.Run();

  scene.settings.mode = Mode::Joint;
  scene.settings.weights.light = 0;
  const std::vector<float> camera = Optimized(scene);
  scene.settings.weights = Weights();
  scene.settings.weights.view = 0;
  const std::vector<float> light = Optimized(scene);

  EXPECT_EQ(separate.Extinction(), camera);
  EXPECT_EQ(separate.LightExtinction(), light);
}

TEST(SolverModes, JointHasNoLightExtinction)
{
  const BoxScene scene = BoxScene::Onion(21);
  Solver solver = scene.MakeSolver();

  solver.Run();

  EXPECT_TRUE(solver.LightExtinction().empty());
}

TEST(SolverModes, LightTransmitsAsACameraInItsPlace)
{
  BoxScene scene = BoxScene::Onion(21);
  std::vector<float> fromLight(scene.extinction.size());
  std::vector<float> fromCamera(scene.extinction.size());
  for (const LightType type : { LightType::Point, LightType::Directional })
  {
    scene.light.type = type;
    scene.MakeSolver().LightTransmittance(fromLight.data());
    BoxScene swapped = scene;
    swapped.camera.position = scene.light.position;
    swapped.camera.focalPoint = scene.light.focalPoint;
    swapped.camera.parallel = type == LightType::Directional;

    swapped.MakeSolver().Transmittance(fromCamera.data());

    EXPECT_EQ(fromLight, fromCamera);
  }
}

TEST(SolverModes, RaysOfAParallelCameraDoNotWiden)
{
  BoxScene scene = BoxScene::Onion(21);
  scene.camera.parallel = true;
  scene.light.type = LightType::Directional;
  scene.settings.derivative = Derivative::Volume;
  const std::vector<float> volume = Optimized(scene);

  scene.settings.derivative = Derivative::Ray;
  const std::vector<float> ray = Optimized(scene);

  EXPECT_EQ(volume, ray);
}

TEST(SolverModes, APointFarAwayIsAParallelCamera)
{
  BoxScene scene = BoxScene::Onion(21);
  scene.camera.position = scene.camera.focalPoint + 1e6 * Vec3(0.3, 0.4, -1);
  const double point = scene.MakeSolver().BaseScore().visibility;

  scene.camera.parallel = true;
  const double parallel = scene.MakeSolver().BaseScore().visibility;

  EXPECT_WITHIN(point, parallel,
    Relative(2.0 / (20 * 20), parallel, "rays at other places, 20 cells across, second order"));
}

TEST(SolverModes, RestrictedToTheViewCountsOnlyThePicture)
{
  BoxScene scene = BoxScene::Onion(21);
  scene.settings.restrictToView = true;
  scene.camera.viewAngle = 90;
  const double wide = scene.MakeSolver().BaseScore().visibility;
  scene.camera.viewAngle = 3;
  const double narrow = scene.MakeSolver().BaseScore().visibility;
  scene.settings.restrictToView = false;
  const double whole = scene.MakeSolver().BaseScore().visibility;

  EXPECT_WITHIN(wide, whole, Relative(1e-5, whole, "the picture shows the whole box"));
  EXPECT_GT(narrow, 0);
  EXPECT_LT(narrow, 0.8 * whole);
}

TEST(SolverModes, StartsFromTheGivenExtinctionAndClampsIt)
{
  const BoxScene scene = BoxScene::Onion(21);
  Solver solver = scene.MakeSolver();
  std::vector<float> wish(scene.extinction.size());
  for (std::size_t node = 0; node < wish.size(); ++node)
  {
    wish[node] = node % 3 == 0 ? -1.0f : node % 3 == 1 ? 1e9f : scene.extinction[node];
  }

  solver.SetInitialExtinction(wish.data());

  for (const float value : solver.Extinction())
  {
    EXPECT_GE(value, 0);
    EXPECT_LE(value, solver.Majorant());
  }
}

TEST(SolverModes, RefusesAnInitialExtinctionForSeparateFields)
{
  BoxScene scene = BoxScene::Onion(21);
  scene.settings.mode = Mode::Separate;
  Solver solver = scene.MakeSolver();

  EXPECT_THROW(solver.SetInitialExtinction(scene.extinction.data()), Error);
}

TEST(SolverModes, KeepsTheBaseForTheLightWhenStoppedBeforeItsRun)
{
  BoxScene scene = BoxScene::Onion(21);
  scene.settings.mode = Mode::Separate;
  Solver solver = scene.MakeSolver();

  solver.Run([](double, const std::string&) { return false; });

  EXPECT_TRUE(solver.Done());
  EXPECT_EQ(solver.LightExtinction(), scene.extinction);
  std::vector<float> transmittance(scene.extinction.size(), -1.0f);
  solver.LightTransmittance(transmittance.data());
  for (const float value : transmittance)
  {
    EXPECT_GE(value, 0);
    EXPECT_LE(value, 1);
  }
}

TEST(SolverModes, RefusesCudaWhereThereIsNone)
{
  if (FindCuda().usable)
  {
    GTEST_SKIP() << "this machine has a GPU";
  }
  BoxScene scene = BoxScene::Onion(21);
  scene.settings.backend = BackendKind::Cuda;

  EXPECT_THROW(scene.MakeSolver(), Error);
}

TEST(SolverModes, StopsAfterTheIterationsItWasGiven)
{
  BoxScene scene = BoxScene::Onion(21);
  scene.settings.tolerance = 0;
  scene.settings.maximumIterations = 3;
  Solver solver = scene.MakeSolver();

  solver.Run();

  EXPECT_TRUE(solver.Done());
  EXPECT_EQ(solver.Iterations(), 3);
  EXPECT_EQ(solver.History().size(), 4u); // and the base
}

TEST(SolverModes, StopsAfterTheTimeItWasGiven)
{
  BoxScene scene = BoxScene::Onion(21);
  scene.settings.tolerance = 0;
  scene.settings.maximumIterations = 1000;
  scene.settings.maximumSeconds = 1e-6;
  Solver solver = scene.MakeSolver();

  solver.Run();

  EXPECT_TRUE(solver.Done());
  EXPECT_EQ(solver.Iterations(), 1);
}

TEST(SolverModes, BestIsTheBestOfTheHistory)
{
  for (const SolverKind kind : { SolverKind::Policy, SolverKind::Adam })
  {
    BoxScene scene = BoxScene::Onion(21);
    scene.settings.solver = kind;
    scene.settings.iterationsPerLevel = { { 8, 8, 16 } };
    Solver solver = scene.MakeSolver();

    solver.Run();

    double least = solver.History().front().energy.Total();
    for (const IterationRecord& record : solver.History())
    {
      least = record.level == 0 ? std::min(least, record.energy.Total()) : least;
    }
    EXPECT_EQ(solver.BestEnergy().Total(), least);
    EXPECT_WITHIN(solver.BestScore().visibility, scene.TrueScore(solver.Extinction()),
      Relative(0.05, solver.BestScore().visibility, "20 cells across a field of steps"));
  }
}

TEST(SolverModes, EnergyIsMadeOfScoresAndTheDistanceFromTheBase)
{
  BoxScene scene = BoxScene::Cube(21);
  scene.FillOnion(4);            // no layer is thick,
  scene.settings.rayDensity = 4; // so that iterations see what scores do
  Solver solver = scene.MakeSolver();
  solver.Run();

  double squares = 0;
  for (std::size_t node = 0; node < scene.extinction.size(); ++node)
  {
    squares += std::pow(double(solver.Extinction()[node]) - scene.extinction[node], 2);
  }
  const Energy energy = solver.BestEnergy();
  const Weights& weights = scene.settings.weights;
  const double truth = scene.TrueScore(solver.Extinction());
  truth::Sampling sampling;
  sampling.raysPerVoxel = 4;
  const double lit =
    truth::VisibilityScore(scene.TruthWith(solver.Extinction()), scene.Lamp(), sampling);

  EXPECT_WITHIN(
    energy.view, -weights.view * solver.BestScore().visibility, Roundoff<float>(8, energy.view));
  const std::string coarse = "20 cells across a field of steps";
  EXPECT_WITHIN(energy.view, -weights.view * truth, Relative(0.05, energy.view, coarse));
  EXPECT_WITHIN(energy.light, -weights.light * lit, Relative(0.05, energy.light, coarse));
  const double distance = weights.regularization * scene.grid.Radius() / 2 * squares *
    scene.grid.CellVolume(); // Eq. (22) in world units
  EXPECT_WITHIN(energy.regularization, distance,
    Relative(0.02, distance, "cells of nodes on the border, halved or not"));
}
