// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Every allocation of a run fails once, and once with all after it, and every loop is interrupted:
// the run ends with an exception, keeps no memory, and what it shares with the next run is as it
// was.

#include "BoxScene.h"
#include "FailingAllocations.h"
#include "PretendedClock.h"
#include "RenderScene.h"
#include "ViewScene.h"

#include "backend/Interruption.h"
#include "backend/ThreadTeam.h"
#include "math/Require.h"
#include "optimize/PreparedScene.h"
#include "optimize/Progressive.h"
#include "viewpoint/Concurrent.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <memory>
#include <new>
#include <vector>

using namespace limpid;

namespace
{
/// What a run found, as numbers.
using Outcome = std::vector<double>;
using Run = std::function<Outcome()>;

void Add(const std::vector<float>& field, Outcome& outcome)
{
  outcome.insert(outcome.end(), field.begin(), field.end());
}

enum class Fault
{
  OneAllocation,  ///< fails: a block that is too large, but others are there
  AllAllocations, ///< fail from one on: memory is exhausted
  Interruption    ///< when a loop asks whether to go on
};

/// Calls a function in which a fault happens at the so manieth opportunity. Returns whether there
/// was one; the function may have done without.
template <class Function>
bool FailIn(std::int64_t number, Fault fault, const Function& function)
{
  if (fault == Fault::Interruption)
  {
    std::int64_t asked = 0;
    const Interruptible interruptible([&] { return ++asked < number; }, 0);
    try
    {
      function();
    }
    catch (const Interrupted&)
    {
      EXPECT_EQ(asked, number) << "asked again, or caught in between";
    }
    return asked >= number;
  }
  using Which = FailingAllocations::Which;
  const FailingAllocations failing(
    number, fault == Fault::OneAllocation ? Which::One : Which::AllFromIt);
  try
  {
    function();
  }
  catch (const Error&)
  {
    EXPECT_TRUE(failing.Failed());
  }
  catch (const std::bad_alloc&)
  {
    EXPECT_TRUE(failing.Failed());
  }
  return failing.Failed();
}

/// `every`: distance of the opportunities at which faults happen.
void ExpectToSurvive(const Run& run, int every = 1)
{
  const ThreadLimit one(1); // so that a number is always the same allocation
  const Outcome expected = run();
  ASSERT_FALSE(expected.empty());
  ASSERT_EQ(run(), expected);
  for (const Fault fault : { Fault::OneAllocation, Fault::AllAllocations, Fault::Interruption })
  {
    const std::int64_t before = LiveBlocks();
    std::int64_t number = 1;
    while (FailIn(number, fault, run))
    {
      ASSERT_EQ(LiveBlocks(), before) << "leak after " << number;
      ASSERT_EQ(run(), expected) << "after " << number;
      number += every;
    }
    EXPECT_GT(number, 1);
  }
}

BoxScene Onion(int nodes)
{
  BoxScene scene = BoxScene::Cube(nodes);
  scene.FillOnion();
  scene.settings.maximumIterations = 2;
  scene.settings.iterationsPerLevel = { { 1, 1, 1 } };
  return scene;
}

Outcome Solve(Solver& solver)
{
  solver.Run();
  Outcome outcome{ solver.BestScore().visibility, solver.BestEnergy().Total() };
  Add(solver.Extinction(), outcome);
  Add(solver.LightExtinction(), outcome);
  std::vector<float> transmittance(solver.Extinction().size());
  solver.Transmittance(transmittance.data());
  Add(transmittance, outcome);
  solver.LightTransmittance(transmittance.data());
  Add(transmittance, outcome);
  return outcome;
}

RenderScene Waves()
{
  Grid grid;
  grid.nodes = { 9, 8, 7 };
  grid.origin = Vec3(-1);
  grid.spacing = Vec3(0.25);
  RenderScene scene = RenderScene::Random(1, grid, 5);
  scene.lighting.enabled = true;
  scene.view.width = 12;
  scene.view.height = 8;
  return scene;
}

Outcome Draw(Renderer& renderer, const RenderScene& scene)
{
  Picture picture;
  renderer.Render(scene.view, picture);
  return { picture.rgba.begin(), picture.rgba.end() };
}
}

/// A fault at one in so many opportunities.
class FaultsOneIn : public ::testing::TestWithParam<int>
{
};

TEST_P(FaultsOneIn, OfTheSolvers)
{
  for (const SolverKind kind : { SolverKind::Policy, SolverKind::Adam })
  {
    for (const Mode mode : { Mode::Joint, Mode::Separate })
    {
      BoxScene scene = Onion(6);
      scene.settings.solver = kind;
      scene.settings.mode = mode;
      ExpectToSurvive(
        [&]
        {
          Solver solver = scene.MakeSolver();
          return Solve(solver);
        },
        2 * GetParam());
    }
  }
}

TEST_P(FaultsOneIn, OfSolversThatShareAScene)
{
  const BoxScene scene = Onion(8);
  const auto prepared = std::make_shared<PreparedScene>(scene.Fields());
  ExpectToSurvive(
    [&]
    {
      Solver solver(prepared, scene.camera, scene.light, scene.settings);
      return Solve(solver);
    },
    4 * GetParam());
}

TEST_P(FaultsOneIn, OfTheSearchForViewpoints)
{
  const BoxScene scene = Onion(8);
  const Orbit orbit = OrbitOf(scene.grid, false);
  SearchSettings settings;
  settings.viewpoints = 1;
  settings.largestNumberOfSteps = 2;
  ExpectToSurvive(
    [&]
    {
      const ViewScore score(scene.grid, { scene.extinction.data(), scene.importance.data() }, 1);
      const std::vector<ScoredView> samples =
        ScoreViews(score, orbit, { Vec3(0, 0, 1), Vec3(0, 1, 0) }, {});
      const SearchResult found = FindViewpoints(score, orbit, samples, settings, {});
      const ScoredView& best = found.viewpoints.front();
      return Outcome{ best.worth, best.direction.x, best.direction.y, best.direction.z };
    },
    8 * GetParam());
}

TEST_P(FaultsOneIn, OfExtinctionAndCameraInTurns)
{
  const BoxScene scene = Onion(8);
  ExpectToSurvive(
    [&]
    {
      ConcurrentResult result = OptimizeConcurrently(
        scene.Fields(), scene.camera, scene.light, scene.settings, Guide::Proxy, {});
      return Outcome{ result.solver->BestScore().visibility, result.camera.position.x };
    },
    200 * GetParam());
}

TEST_P(FaultsOneIn, OfTheProgressiveOptimiser)
{
  const BoxScene scene = Onion(17);
  ExpectToSurvive(
    [&]
    {
      Progressive progressive(scene.Fields(), scene.settings);
      const PretendedClock clock(1e-6);
      progressive.SetView(scene.camera, scene.light, scene.settings);
      progressive.Preview(1e-4);
      Outcome outcome{ progressive.BestScore().visibility };
      while (!progressive.Refine())
      {
      }
      outcome.push_back(progressive.BestScore().visibility);
      outcome.push_back(progressive.ScoresFrom(scene.camera).base.visibility);
      const float* extinction = progressive.Extinction();
      outcome.insert(outcome.end(), extinction, extinction + scene.grid.NodeCount());
      return outcome;
    },
    10 * GetParam());
}

TEST_P(FaultsOneIn, OnSeveralThreads)
{
  const ThreadLimit limit(3);
  BoxScene scene = Onion(16);
  const auto run = [&]
  {
    Solver solver = scene.MakeSolver();
    return Solve(solver);
  };
  const Outcome expected = run();
  for (std::int64_t number = 1; FailIn(number, Fault::AllAllocations, run);
       number += 8 * GetParam())
  {
    ASSERT_EQ(run(), expected) << "after allocation " << number;
  }
}

INSTANTIATE_TEST_SUITE_P(Quick, FaultsOneIn, ::testing::Values(47));
INSTANTIATE_TEST_SUITE_P(Long, FaultsOneIn, ::testing::Values(1));

TEST(Faults, OfTheRenderer)
{
  const RenderScene scene = Waves();
  const std::vector<float> extinction(std::size_t(scene.grid.NodeCount()), 1.0f);
  ExpectToSurvive(
    [&]
    {
      Renderer renderer;
      renderer.SetScalars(scene.grid, scene.scalars.data());
      renderer.SetTransferFunctions(scene.functions);
      renderer.SetLighting(scene.lighting);
      Outcome outcome = Draw(renderer, scene);
      renderer.SetExtinction(scene.grid, extinction.data(), extinction.data());
      const Outcome other = Draw(renderer, scene);
      outcome.insert(outcome.end(), other.begin(), other.end());
      return outcome;
    });
}

/// A renderer that could not draw a picture draws it when it is asked again.
TEST(Faults, LeaveARendererThatDraws)
{
  const ThreadLimit one(1);
  const RenderScene scene = Waves();
  const std::vector<float> base(std::size_t(scene.grid.NodeCount()), 1.0f);
  const std::vector<float> extinction(base.size(), 0.25f);
  const std::vector<float>& importance = scene.scalars;
  for (const bool given : { false, true })
  {
    const auto makeRenderer = [&]
    {
      Renderer renderer;
      renderer.SetScalars(scene.grid, scene.scalars.data());
      renderer.SetTransferFunctions(scene.functions);
      renderer.SetLighting(scene.lighting);
      renderer.SetShadowCoarseness(2);
      if (given)
      {
        renderer.SetExtinction(scene.grid, base.data(), extinction.data());
        renderer.SetImportance(importance.data());
        renderer.ShowMissed(std::array<float, 3>{ { 1, 0, 1 } });
      }
      return renderer;
    };
    Renderer undisturbed = makeRenderer();
    const Outcome expected = Draw(undisturbed, scene);

    for (const Fault fault : { Fault::OneAllocation, Fault::Interruption })
    {
      bool failed = true;
      for (std::int64_t number = 1; failed; ++number)
      {
        Renderer renderer = makeRenderer();
        failed = FailIn(number, fault, [&] { Draw(renderer, scene); });
        ASSERT_EQ(Draw(renderer, scene), expected) << "after " << number;
      }
    }
  }
}

/// An extinction that could not be shown is not shown in part: without another one, the picture is
/// that of the transfer functions.
TEST(Faults, ShowAnExtinctionWhollyOrNotAtAll)
{
  const ThreadLimit one(1);
  const RenderScene scene = Waves();
  const std::vector<float> base(std::size_t(scene.grid.NodeCount()), 1.0f);
  const std::vector<float> extinction(base.size(), 0.25f);
  const auto makeRenderer = [&]
  {
    Renderer renderer;
    renderer.SetScalars(scene.grid, scene.scalars.data());
    renderer.SetTransferFunctions(scene.functions);
    renderer.SetLighting(scene.lighting);
    return renderer;
  };
  const auto show = [&](Renderer& renderer)
  { renderer.SetExtinction(scene.grid, base.data(), extinction.data(), 0.5, extinction.data()); };
  Renderer undisturbed = makeRenderer();
  const Outcome expected = Draw(undisturbed, scene);
  show(undisturbed);

  for (const Fault fault : { Fault::OneAllocation, Fault::Interruption })
  {
    std::int64_t number = 1;
    const auto showFails = [&](Renderer& renderer)
    { return FailIn(number, fault, [&] { show(renderer); }); };
    Renderer renderer = makeRenderer();
    while (showFails(renderer))
    {
      ASSERT_EQ(Draw(renderer, scene), expected) << "after " << number;
      renderer = makeRenderer();
      ++number;
    }
    EXPECT_GT(number, 1);
  }
}

TEST(Faults, LeaveNoRendererWithHalfItsInput)
{
  const ThreadLimit one(1);
  const RenderScene scene = Waves();
  RenderScene other = Waves();
  other.grid.nodes = { 7, 8, 9 };
  const auto setScalars = [&](Renderer& renderer)
  { renderer.SetScalars(other.grid, other.scalars.data(), other.scalars.data()); };
  const auto setFunctions = [&](Renderer& renderer)
  { renderer.SetTransferFunctions(other.functions); };
  const std::array<std::function<void(Renderer&)>, 2> changes{ { setScalars, setFunctions } };
  for (const auto& change : changes)
  {
    bool failed = true;
    for (std::int64_t number = 1; failed; ++number)
    {
      Renderer renderer;
      renderer.SetScalars(scene.grid, scene.scalars.data());
      renderer.SetTransferFunctions(scene.functions);
      const Outcome before = Draw(renderer, scene);
      failed = FailIn(number, Fault::OneAllocation, [&] { change(renderer); });
      Outcome after;
      try
      {
        after = Draw(renderer, scene);
      }
      catch (const Error&)
      {
        EXPECT_TRUE(failed); // nothing to be drawn until it is set
        continue;
      }
      EXPECT_TRUE(!failed || after == before) << "after " << number;
    }
  }
}

TEST(Faults, InsideLoopsReachTheCaller)
{
  const auto loop = [](bool withTeam)
  {
    std::unique_ptr<const ThreadTeam> team;
    if (withTeam)
    {
      team = std::make_unique<ThreadTeam>();
    }
    ParallelFor(1000,
      [](Index i)
      {
        if (i == 999)
        {
          throw std::bad_alloc();
        }
      });
  };
  for (const int threads : { 1, 2, 4 })
  {
    const ThreadLimit limit(threads);
    EXPECT_THROW(loop(false), std::bad_alloc);
    EXPECT_THROW(loop(true), std::bad_alloc);
  }
}

TEST(Faults, InterruptTheInnermostOnly)
{
  int outerAsked = 0;
  const Interruptible outer(
    [&]
    {
      ++outerAsked;
      ParallelFor(10, [](Index) {}); // what is done meanwhile asks nobody
      return true;
    },
    0);
  {
    const Interruptible inner([] { return false; }, 0);
    EXPECT_THROW(ParallelFor(10, [](Index) {}), Interrupted);
    EXPECT_THROW(ParallelFor(10, [](Index) {}), Interrupted) << "still";
  }
  EXPECT_EQ(outerAsked, 0);
  EXPECT_NO_THROW(ParallelFor(1, [](Index) {}));
  EXPECT_GT(outerAsked, 0);
}

TEST(Faults, TellHowMuchOfALoopIsDone)
{
  std::vector<double> told;
  const Interruptible interruptible(
    [&](double share)
    {
      told.push_back(share);
      return share < 0.5;
    },
    0);
  const auto loop = []
  {
    for (int done = 0; done < 4; ++done)
    {
      Interruptible::Check(done / 4.0);
    }
  };
  Interruptible::Check();
  EXPECT_THROW(loop(), Interrupted);
  EXPECT_EQ(told, (std::vector<double>{ 0, 0, 0.25, 0.5 }));
}

/// Wherever an allocation fails while several threads work, the next run is right.
