// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A camera that moves and rests: what is refined is what a solver finds, whatever was shown before.

#include "BoxScene.h"
#include "PretendedClock.h"
#include "Tolerance.h"

#include "Resampled.h"
#include "backend/Interruption.h"
#include "math/Require.h"
#include "optimize/PassTime.h"
#include "optimize/Progressive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
Progressive MakeProgressive(const BoxScene& scene)
{
  Progressive progressive(scene.Fields(), scene.settings);
  progressive.SetView(scene.camera, scene.light, scene.settings);
  return progressive;
}

/// Refines to the end. Returns the number of calls.
int RefineAll(Progressive& progressive)
{
  int calls = 1;
  while (!progressive.Refine() && calls < 1000)
  {
    ++calls;
  }
  EXPECT_TRUE(progressive.Converged());
  return calls;
}

std::vector<float> Copy(const Progressive& progressive, const float* field)
{
  return { field, field + progressive.ShownGrid().NodeCount() };
}

void ExpectWhatASolverFinds(const Progressive& progressive, const BoxScene& scene)
{
  Solver solver = scene.MakeSolver();
  solver.Run();
  const bool separate = scene.settings.mode == Mode::Separate;

  ASSERT_EQ(progressive.ShownGrid().nodes, scene.grid.nodes);
  EXPECT_EQ(progressive.BaseExtinction(), scene.extinction.data());
  EXPECT_EQ(Copy(progressive, progressive.Extinction()), solver.Extinction());
  EXPECT_EQ(Copy(progressive, progressive.LightExtinction()),
    separate ? solver.LightExtinction() : solver.Extinction());
  EXPECT_EQ(progressive.BaseScore().visibility, solver.BaseScore().visibility);
  EXPECT_EQ(progressive.BestScore().visibility, solver.BestScore().visibility);
  EXPECT_EQ(progressive.BestScore().fraction, solver.BestScore().fraction);
  EXPECT_EQ(progressive.Iterations(), solver.Iterations());
}

/// The camera turned about the z axis through the centre.
Camera Turned(const BoxScene& scene, double degrees)
{
  const double angle = degrees * std::acos(-1.0) / 180;
  Camera camera = scene.camera;
  const Vec3 arm = camera.position - camera.focalPoint;
  camera.position = camera.focalPoint +
    Vec3(std::cos(angle) * arm.x - std::sin(angle) * arm.y,
      std::sin(angle) * arm.x + std::cos(angle) * arm.y, arm.z);
  return camera;
}

struct Way
{
  const char* name;
  SolverKind solver;
  Mode mode;
};

std::ostream& operator<<(std::ostream& stream, const Way& way)
{
  return stream << way.name;
}
}

class ProgressiveWays : public ::testing::TestWithParam<Way>
{
protected:
  BoxScene Scene() const
  {
    BoxScene scene = BoxScene::Onion(33);
    scene.settings.solver = GetParam().solver;
    scene.settings.mode = GetParam().mode;
    scene.settings.iterationsPerLevel = { { 2, 2, 3 } };
    return scene;
  }
};

INSTANTIATE_TEST_SUITE_P(Ways, ProgressiveWays,
  ::testing::Values(Way{ "PolicyJoint", SolverKind::Policy, Mode::Joint },
    Way{ "PolicySeparate", SolverKind::Policy, Mode::Separate },
    Way{ "AdamJoint", SolverKind::Adam, Mode::Joint },
    Way{ "AdamSeparate", SolverKind::Adam, Mode::Separate }),
  ::testing::PrintToStringParamName());

TEST_P(ProgressiveWays, RefinesToWhatASolverFinds)
{
  const BoxScene scene = this->Scene();
  Progressive progressive = MakeProgressive(scene);

  RefineAll(progressive);

  ExpectWhatASolverFinds(progressive, scene);
}

TEST_P(ProgressiveWays, MeasuresWhatAnotherCameraSees)
{
  BoxScene scene = this->Scene();
  Progressive progressive = MakeProgressive(scene);
  RefineAll(progressive);
  BoxScene other = scene;
  other.camera = Turned(scene, 70);
  other.settings.mode = Mode::Joint;
  other.settings.weights.light = 0;
  Solver there = other.MakeSolver();
  const double base = there.BestScore().visibility;
  there.SetInitialExtinction(progressive.Extinction());

  const Scores seen = progressive.ScoresFrom(other.camera);

  EXPECT_EQ(seen.base.visibility, base);
  EXPECT_EQ(seen.best.visibility, there.BestScore().visibility);
  EXPECT_EQ(seen.best.fraction, there.BestScore().fraction);
  EXPECT_NE(seen.best.visibility, progressive.BestScore().visibility);
  // One is summed from the front to the back of a ray, the other from the back to the front.
  const double best = progressive.BestScore().visibility;
  EXPECT_WITHIN(
    progressive.ScoresFrom(scene.camera).best.visibility, best, Roundoff<float>(100, best));
}

TEST_P(ProgressiveWays, ForgetsWhatWasShownBefore)
{
  BoxScene scene = this->Scene();
  Progressive progressive = MakeProgressive(scene);
  const PretendedClock clock(1e-6);
  for (const double degrees : { 10.0, 20.0, 30.0 })
  {
    progressive.SetView(Turned(scene, degrees), scene.light, scene.settings);
    progressive.Preview(degrees < 25 ? 0.004 : 1.0);
    progressive.Refine();
    progressive.Refine();
  }
  scene.camera = Turned(scene, 30.5);
  progressive.SetView(scene.camera, scene.light, scene.settings);
  progressive.Preview(0.01);
  progressive.Refine();
  progressive.Preview(1);

  RefineAll(progressive);

  ExpectWhatASolverFinds(progressive, scene);
}

TEST_P(ProgressiveWays, StepsOneIterationPerCall)
{
  const BoxScene scene = this->Scene();
  Progressive progressive = MakeProgressive(scene);

  EXPECT_FALSE(progressive.Refine());
  EXPECT_EQ(progressive.Iterations(), 0);
  EXPECT_FALSE(progressive.Refine());
  EXPECT_EQ(progressive.Iterations(), 1);
  EXPECT_FALSE(progressive.Converged());
}

TEST_P(ProgressiveWays, NeverShowsTheBaseAgainOnceItHasShownMore)
{
  const BoxScene scene = this->Scene();
  Progressive progressive = MakeProgressive(scene);
  progressive.Preview(1);
  bool done = false;
  for (int view = 0; view < 2; ++view)
  {
    do
    {
      done = progressive.Refine();
      EXPECT_NE(Copy(progressive, progressive.Extinction()),
        Copy(progressive, progressive.BaseExtinction()));
      EXPECT_NE(Copy(progressive, progressive.LightExtinction()),
        Copy(progressive, progressive.BaseExtinction()));
    } while (!done);
    progressive.SetView(Turned(scene, 5), scene.light, scene.settings);
  }
}

TEST_P(ProgressiveWays, PreviewsInTheScenesBounds)
{
  const BoxScene scene = this->Scene();
  Progressive progressive = MakeProgressive(scene);

  progressive.Preview(1e-9);

  const Grid& grid = progressive.ShownGrid();
  EXPECT_LT(grid.NodeCount(), scene.grid.NodeCount());
  const Vec3 last = Vec3(grid.nodes) - 1.0;
  const Vec3 end = scene.grid.PointToWorld(Vec3(scene.grid.nodes) - 1.0);
  EXPECT_WITHIN(
    glm::length(grid.PointToWorld(last) - end), 0, Roundoff<double>(20, glm::length(end)));
  const float most = *std::max_element(scene.extinction.begin(), scene.extinction.end());
  for (const float* field : { progressive.Extinction(), progressive.LightExtinction() })
  {
    for (const float value : Copy(progressive, field))
    {
      ASSERT_TRUE(value >= 0 && value <= most) << value;
    }
  }
  const bool separate = GetParam().mode == Mode::Separate;
  EXPECT_EQ(progressive.Extinction() != progressive.LightExtinction(), separate);
  EXPECT_GT(progressive.BestScore().fraction, 1.5 * progressive.BaseScore().fraction);
  EXPECT_LE(progressive.BestScore().fraction, 1);
  EXPECT_EQ(progressive.Iterations(), 0);
  EXPECT_FALSE(progressive.Converged());
}

TEST(Progressive, KeepsShowingTheLastViewUntilThereIsSomethingNew)
{
  const BoxScene scene = BoxScene::Onion(33);
  Progressive progressive = MakeProgressive(scene);
  RefineAll(progressive);
  const std::vector<float> shown = Copy(progressive, progressive.Extinction());
  const Camera turned = Turned(scene, 40);

  progressive.SetView(turned, scene.light, scene.settings);
  EXPECT_FALSE(progressive.Converged());
  EXPECT_EQ(Copy(progressive, progressive.Extinction()), shown);
  const Scores seen = progressive.ScoresFrom(turned);
  EXPECT_EQ(progressive.BestScore().visibility, seen.best.visibility);
  EXPECT_EQ(progressive.BaseScore().visibility, seen.base.visibility);
  progressive.Refine();
  EXPECT_EQ(Copy(progressive, progressive.Extinction()), shown);
  progressive.Refine();
  EXPECT_NE(Copy(progressive, progressive.Extinction()), shown);
}

TEST(Progressive, NeverShowsTheBaseWhileIteratesAreNoBetter)
{
  const BoxScene scene = BoxScene::Onion(45); // in smaller ones, no first iterate is worse
  int worse = 0;
  for (const double regularization : { 0.1, 1.0, 10.0, 100.0 })
  {
    Progressive progressive = MakeProgressive(scene);
    RefineAll(progressive);
    Settings settings = scene.settings;
    settings.weights.regularization = regularization;
    progressive.SetView(scene.camera, scene.light, settings);
    while (!progressive.Refine())
    {
      EXPECT_NE(Copy(progressive, progressive.Extinction()), scene.extinction) << regularization;
    }
    Solver solver(scene.Fields(), scene.camera, scene.light, settings);
    solver.Step(1);
    const std::vector<IterationRecord>& history = solver.History();
    worse += history[1].energy.Total() > history[0].energy.Total() ? 1 : 0;
  }
  EXPECT_GT(worse, 0); // or nothing was tested
}

TEST(Progressive, GoesOnFromWhatAnotherSceneShowed)
{
  const BoxScene scene = BoxScene::Onion(33);
  Progressive first = MakeProgressive(scene);
  EXPECT_TRUE(first.Change().ofExtinction.empty());
  RefineAll(first);
  const std::vector<float> shown = Copy(first, first.Extinction());
  BoxScene edited = BoxScene::Onion(33);
  for (float& value : edited.extinction)
  {
    value *= 0.5f;
  }

  Progressive second(edited.Fields(), edited.settings);
  second.GoOnFrom(first.Change());
  second.SetView(edited.camera, edited.light, edited.settings);

  ASSERT_EQ(second.ShownGrid().nodes, edited.grid.nodes);
  const std::vector<float> carried = Copy(second, second.Extinction());
  const float majorant = *std::max_element(edited.extinction.begin(), edited.extinction.end());
  for (std::size_t node = 0; node < shown.size(); ++node)
  {
    // All of the scene is half as much, and so is the change.
    EXPECT_WITHIN(carried[node], 0.5 * shown[node], Roundoff<float>(16, majorant));
  }
  EXPECT_GT(second.BestScore().fraction, second.BaseScore().fraction);
  second.Refine();
  EXPECT_EQ(Copy(second, second.Extinction()), carried);
  RefineAll(second);
  ExpectWhatASolverFinds(second, edited);
}

TEST(Progressive, DoesNotGoOnFromAnotherBox)
{
  const BoxScene scene = BoxScene::Onion(33);
  Progressive first = MakeProgressive(scene);
  RefineAll(first);
  BoxScene moved = BoxScene::Onion(33);
  moved.grid.origin.x += 0.5;

  Progressive second(moved.Fields(), moved.settings);
  second.GoOnFrom(first.Change());

  EXPECT_TRUE(second.Change().ofExtinction.empty());
}

TEST_P(ProgressiveWays, StaysNearWhatItShows)
{
  BoxScene scene = this->Scene();
  scene.settings.iterationsPerLevel = { { 8, 8, 48 } }; // Adam begins at the base
  const auto distances = [&](double coherence)
  {
    scene.settings.temporalCoherence = coherence;
    Progressive progressive = MakeProgressive(scene);
    RefineAll(progressive);
    const std::vector<float> before = Copy(progressive, progressive.Extinction());
    const std::vector<float> lightBefore = Copy(progressive, progressive.LightExtinction());
    progressive.SetView(Turned(scene, 3), scene.light, scene.settings);
    RefineAll(progressive);
    const auto distance = [&](const float* now, const std::vector<float>& then)
    {
      double sum = 0;
      for (std::size_t node = 0; node < then.size(); ++node)
      {
        sum += std::abs(double(now[node]) - double(then[node]));
      }
      return sum;
    };
    return std::pair(distance(progressive.Extinction(), before),
      distance(progressive.LightExtinction(), lightBefore));
  };

  const auto [free, freeOfLight] = distances(0);
  const auto [near, nearOfLight] = distances(1);

  EXPECT_LT(near, 0.7 * free);
  if (GetParam().solver == SolverKind::Policy) // steps of Adam go to and fro about an optimum
  {
    EXPECT_LE(nearOfLight, std::max(freeOfLight, 1e-2 * free)); // the light has not moved
  }
}

TEST_P(ProgressiveWays, PreviewsStayNearWhatIsShown)
{
  BoxScene scene = this->Scene();
  scene.settings.temporalCoherence = 1e7; // changes are large where little absorbs
  Progressive progressive = MakeProgressive(scene);
  RefineAll(progressive);
  const CarriedChange before = progressive.Change();

  progressive.SetView(Turned(scene, 1), scene.light, scene.settings);
  progressive.Preview(1e-9); // on a coarse grid

  ASSERT_LT(progressive.ShownGrid().NodeCount(), scene.grid.NodeCount());
  const std::vector<float> coarse =
    Resampled(before.grid, before.ofExtinction.data(), progressive.ShownGrid());
  const std::vector<float> now = progressive.Change().ofExtinction;
  double sum = 0;
  double size = 0;
  for (std::size_t node = 0; node < now.size(); ++node)
  {
    const bool filled = progressive.BaseExtinction()[node] > 0;
    sum += filled ? std::abs(double(now[node]) - double(coarse[node])) : 0.0;
    size += std::abs(double(coarse[node]));
  }
  EXPECT_LT(sum, 0.01 * size);
}

TEST(Progressive, DoesNothingForTheSameView)
{
  const BoxScene scene = BoxScene::Onion(33);
  Progressive progressive = MakeProgressive(scene);
  const int calls = RefineAll(progressive);
  EXPECT_GT(calls, 2);

  progressive.SetView(scene.camera, scene.light, scene.settings);

  EXPECT_TRUE(progressive.Converged());
  progressive.Preview(1e-9); // would be worse than what is shown
  EXPECT_EQ(progressive.ShownGrid().nodes, scene.grid.nodes);
  EXPECT_EQ(progressive.Iterations(), calls - 1);
}

TEST(Progressive, StartsAgainForAnyChange)
{
  const BoxScene scene = BoxScene::Onion(17);
  Progressive progressive = MakeProgressive(scene);
  const auto startsAgain = [&](const Camera& camera, const Light& light, const Settings& settings)
  {
    progressive.SetView(scene.camera, scene.light, scene.settings);
    RefineAll(progressive);
    progressive.SetView(camera, light, settings);
    return !progressive.Converged();
  };

  Camera camera = scene.camera;
  camera.viewUp = Vec3(1, 0, 0);
  EXPECT_TRUE(startsAgain(camera, scene.light, scene.settings));
  camera = scene.camera;
  camera.corners = { Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0) };
  EXPECT_TRUE(startsAgain(camera, scene.light, scene.settings));
  Light light = scene.light;
  light.position.x += 0.1;
  EXPECT_TRUE(startsAgain(scene.camera, light, scene.settings));
  Settings settings = scene.settings;
  settings.weights.light = 2;
  EXPECT_TRUE(startsAgain(scene.camera, scene.light, settings));
  EXPECT_FALSE(startsAgain(scene.camera, scene.light, scene.settings));
}

TEST(Progressive, PreviewsOnCoarserGridsForSmallerBudgets)
{
  const BoxScene scene = BoxScene::Onion(65);
  Index last = std::numeric_limits<Index>::max();
  for (const double seconds : { 1.0, 0.1, 0.02, 0.002 })
  {
    Progressive progressive = MakeProgressive(scene);
    const double secondsPerNode = 1e-6;
    const PretendedClock clock(secondsPerNode);
    for (const double degrees : { 0.0, 2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 14.0, 16.0, 18.0 })
    {
      progressive.SetView(Turned(scene, degrees), scene.light, scene.settings);
      progressive.Preview(seconds);
    }

    const Index nodes = progressive.ShownGrid().NodeCount();
    EXPECT_LT(nodes, last) << seconds;
    EXPECT_LE(secondsPerNode * double(nodes), seconds);
    last = nodes;
  }
}

TEST(Progressive, LeavesTheBaseWhereNothingIsToBeSeen)
{
  BoxScene scenes[] = { BoxScene::Onion(17), BoxScene::Onion(17), BoxScene::Onion(17),
    BoxScene({ 9, 9, 1 }, Vec3(0), Vec3(1)) };
  std::fill(scenes[0].importance.begin(), scenes[0].importance.end(), 0.0f);
  std::fill(scenes[1].extinction.begin(), scenes[1].extinction.end(), 0.0f);
  scenes[2].settings.weights.view = scenes[2].settings.weights.light = 0;
  scenes[3].Fill(Everywhere(1), Everywhere(1));
  for (BoxScene& scene : scenes)
  {
    for (const Mode mode : { Mode::Joint, Mode::Separate })
    {
      scene.settings.mode = mode;
      Progressive progressive = MakeProgressive(scene);
      EXPECT_NE(progressive.Extinction(), nullptr);
      progressive.Preview(1e-9);
      EXPECT_EQ(Copy(progressive, progressive.Extinction()),
        Copy(progressive, progressive.BaseExtinction()));
      EXPECT_EQ(Copy(progressive, progressive.LightExtinction()),
        Copy(progressive, progressive.BaseExtinction()));
      EXPECT_TRUE(std::isfinite(progressive.BestScore().fraction));

      RefineAll(progressive);

      ExpectWhatASolverFinds(progressive, scene);
    }
  }
}

TEST(Progressive, SeesWithTheLightAloneWhenTheViewHasNoWeight)
{
  BoxScene scene = BoxScene::Onion(33);
  scene.settings.weights.view = 0;
  Progressive progressive = MakeProgressive(scene);

  progressive.Preview(1e-9);
  EXPECT_NE(
    Copy(progressive, progressive.Extinction()), Copy(progressive, progressive.BaseExtinction()));

  RefineAll(progressive);
  ExpectWhatASolverFinds(progressive, scene);
}

TEST(Progressive, KeepsItsViewWhenTheNewOneIsNoGood)
{
  const BoxScene scene = BoxScene::Onion(17);
  Progressive progressive = MakeProgressive(scene);
  RefineAll(progressive);
  Camera camera = scene.camera;
  camera.position = camera.focalPoint;
  Settings settings = scene.settings;
  settings.rayDensity = -1;

  EXPECT_THROW(progressive.SetView(camera, scene.light, scene.settings), Error);
  EXPECT_THROW(progressive.SetView(scene.camera, scene.light, settings), Error);

  ExpectWhatASolverFinds(progressive, scene);
}

TEST(Progressive, RejectsScenesThatASolverRejects)
{
  BoxScene scene = BoxScene::Onion(9);
  scene.extinction[5] = -1;
  EXPECT_THROW(Progressive(scene.Fields(), scene.settings), Error);
  scene.extinction[5] = 1;
  scene.importance[5] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(Progressive(scene.Fields(), scene.settings), Error);
}

TEST(Progressive, RefusesCudaWhereThereIsNone)
{
  if (FindCuda().usable)
  {
    GTEST_SKIP() << "this machine has a GPU";
  }
  BoxScene scene = BoxScene::Onion(9);
  scene.settings.backend = BackendKind::Cuda;
  EXPECT_THROW(Progressive(scene.Fields(), scene.settings), Error);
}

TEST(PassTime, ChoosesTheFinestGridThatFits)
{
  PassTime time;
  const std::vector<Index> nodes{ 1000000, 125000, 15625 };
  for (int n = 0; n < 40; ++n)
  {
    time.Learn(1e-7);
  }

  EXPECT_EQ(time.Choose(nodes, 1, 2), 0u);
  EXPECT_EQ(time.Choose(nodes, 0.05, 2), 1u);
  EXPECT_EQ(time.Choose(nodes, 0.001, 2), 2u);
  EXPECT_EQ(time.Choose(nodes, 0, 2), 2u);
}

TEST(PassTime, ChangesToAFinerGridOnlyWithTimeToSpare)
{
  PassTime time;
  const std::vector<Index> nodes{ 1000000, 125000 };
  for (int n = 0; n < 40; ++n)
  {
    time.Learn(1e-7);
  }

  EXPECT_EQ(time.Choose(nodes, 0.11, 0), 0u);
  EXPECT_EQ(time.Choose(nodes, 0.11, 1), 1u);
  EXPECT_EQ(time.Choose(nodes, 0.15, 1), 0u);
}

TEST(PassTime, LearnsFromWhatIsSlow)
{
  PassTime time;
  const std::vector<Index> nodes{ 1000000, 125000 };
  time.Learn(8e-9);
  time.Learn(8e-9);
  time.Learn(8e-9);
  EXPECT_EQ(time.Choose(nodes, 0.1, 1), 0u);

  time.Learn(5e-7);

  EXPECT_EQ(time.Choose(nodes, 0.1, 0), 1u);
}

TEST(Progressive, GoesOnAsIfNothingHadHappenedWhenItsBeginningIsInterrupted)
{
  BoxScene scene = BoxScene::Onion(33);
  Progressive progressive = MakeProgressive(scene);
  RefineAll(progressive);
  const std::vector<float> before = Copy(progressive, progressive.Extinction());
  scene.camera = Turned(scene, 100);
  progressive.SetView(scene.camera, scene.light, scene.settings);

  bool interrupted = true;
  for (int number = 1; interrupted; ++number)
  {
    int asked = 0;
    interrupted = false;
    try
    {
      const Interruptible interruptible([&] { return ++asked < number; }, 0);
      progressive.Refine();
    }
    catch (const Interrupted&)
    {
      interrupted = true;
      ASSERT_FALSE(progressive.HasBegun());
      ASSERT_EQ(Copy(progressive, progressive.Extinction()), before);
    }
  }

  RefineAll(progressive);
  ExpectWhatASolverFinds(progressive, scene);
}
