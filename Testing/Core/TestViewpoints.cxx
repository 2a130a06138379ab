// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Scores of directions against the reference march, and the search for the best of them.

#include "LoadedScene.h"
#include "Tolerance.h"
#include "ViewScene.h"

#include "backend/Backend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

using namespace limpid;

namespace
{
/// Evenly spread, by the golden angle.
std::vector<Vec3> SpreadDirections(int count)
{
  std::vector<Vec3> directions;
  for (int i = 0; i < count; ++i)
  {
    const double z = 1 - 2 * (i + 0.5) / count;
    const double r = std::sqrt(1 - z * z);
    const double angle = i * 2.399963229728653;
    directions.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
  }
  return directions;
}

double March(const BoxScene& scene, const Camera& camera, double rays)
{
  BoxScene seen = scene;
  seen.camera = camera;
  return seen.TrueScore(seen.extinction, rays);
}
}

class ScoredBox : public ::testing::TestWithParam<Case>
{
};

TEST_P(ScoredBox, HasTheScoreOfTheMarchInEveryDirection)
{
  const BoxScene scene = Filled(GetParam().content);
  const ViewScore score(scene.grid, { scene.extinction.data(), scene.importance.data() }, 1);
  const Orbit orbit = OrbitOf(scene.grid, GetParam().parallel);

  for (const Vec3& direction : RandomDirections(20))
  {
    const Camera camera = orbit.At(direction);
    const double truth = March(scene, camera, 4);
    EXPECT_WITHIN(score.At(camera).visibility, truth,
      Relative(0.005, truth, "the bar for scores of directions"));
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, ScoredBox,
  ::testing::Values(Case{ "Onion", Content::Onion, false }, Case{ "Waves", Content::Waves, false },
    Case{ "Borders", Content::Borders, false }, Case{ "ParallelOnion", Content::Onion, true },
    Case{ "ParallelWaves", Content::Waves, true },
    Case{ "ParallelBorders", Content::Borders, true }),
  ::testing::PrintToStringParamName());

TEST(ViewScore, OfABallIsTheSameEverywhere)
{
  BoxScene scene = BoxScene::Cube(41);
  const auto ball = [](const Vec3& x)
  { return std::min(1.0, std::max(0.0, (0.7 - glm::length(x)) / 0.1)); };
  scene.Fill([=](const Vec3& x) { return 5 * ball(x); }, ball);
  const ViewScore score(scene.grid, { scene.extinction.data(), scene.importance.data() }, 1);
  for (const bool parallel : { false, true })
  {
    double least = 1e300;
    double most = 0;
    for (const ScoredView& view :
      ScoreViews(score, OrbitOf(scene.grid, parallel), SpreadDirections(100), nullptr))
    {
      least = std::min(least, view.worth);
      most = std::max(most, view.worth);
    }
    EXPECT_LE(most, 1.005 * least);
  }
}

TEST(ViewScore, IsZeroWithoutAnythingToSee)
{
  BoxScene scene = BoxScene::Cube(9);
  const ViewScore nothing(scene.grid, { scene.extinction.data(), scene.importance.data() }, 1);
  const Camera camera = OrbitOf(scene.grid, false).At(Vec3(0, 0, 1));

  EXPECT_EQ(nothing.At(camera).visibility, 0);
  EXPECT_EQ(nothing.SlopeAt(camera).slope, Vec3(0));
}

TEST(ViewScore, IsFiniteFromInsideAndFromVeryFarAway)
{
  const BoxScene scene = Filled(Content::Borders);
  const ViewScore score(scene.grid, { scene.extinction.data(), scene.importance.data() }, 1);
  for (const double distance : { 0.01, 0.3, 0.9, 1e5 })
  {
    Orbit orbit = OrbitOf(scene.grid, false);
    orbit.distance = distance * scene.grid.Radius();
    for (const Vec3& direction : RandomDirections(5))
    {
      const ViewSlope slope = score.SlopeAt(orbit.At(direction));
      EXPECT_TRUE(std::isfinite(slope.score) && std::isfinite(glm::length(slope.slope)));
      EXPECT_GT(slope.score, 0);
    }
  }
}

TEST(ViewScore, HasAFiniteSlopeWhereVoxelsAreOpaque)
{
  for (const float opticalDepth : { 10.0f, 100.0f, 1e4f, 1e8f })
  {
    BoxScene scene = Filled(Content::Borders);
    std::mt19937 generator(11);
    for (float& extinction : scene.extinction)
    {
      extinction = generator() % 2 == 0 ? opticalDepth : 0.0f; // voxels are about 1 wide
    }
    const ViewScore score(scene.grid, { scene.extinction.data(), scene.importance.data() }, 1);
    for (const Vec3& direction : RandomDirections(5))
    {
      for (const bool parallel : { false, true })
      {
        const ViewSlope slope = score.SlopeAt(OrbitOf(scene.grid, parallel).At(direction));
        EXPECT_TRUE(std::isfinite(slope.score)) << opticalDepth;
        EXPECT_TRUE(std::isfinite(glm::length(slope.slope))) << opticalDepth;
      }
    }
  }
}

TEST(ViewScore, DoesNotDependOnThreads)
{
  const BoxScene scene = Filled(Content::Waves);
  const ViewScore score(scene.grid, { scene.extinction.data(), scene.importance.data() }, 1);
  const Orbit orbit = OrbitOf(scene.grid, false);
  const std::vector<Vec3> directions = RandomDirections(12);
  const std::vector<ScoredView> views = ScoreViews(score, orbit, directions, nullptr);
  const ThreadLimit limit(1);

  for (std::size_t i = 0; i < directions.size(); ++i)
  {
    EXPECT_EQ(views[i].worth, score.At(orbit.At(directions[i])).visibility);
  }
}

TEST(ViewAngles, AreThoseOfTheRotation)
{
  for (const Vec3& direction : RandomDirections(50))
  {
    const Mat3 rotation = RotationOf(AnglesOf(direction));
    EXPECT_LE(glm::distance(rotation[2], direction), 1e-15);
    EXPECT_LE(glm::distance(glm::cross(rotation[0], rotation[1]), rotation[2]), 1e-15);
    EXPECT_EQ(rotation[0].y, 0); // upright
    EXPECT_GE(rotation[1].y, 0);
  }
  EXPECT_EQ(AnglesOf(Vec3(0, 1, 0)).azimuth, 0);
  EXPECT_EQ(AnglesOf(Vec3(0, 0, 1)).polar, 0);
}

TEST(FindViewpoints, SeesTwoBlobsFromTheSide)
{
  // Blobs that touch each other, one behind the other from the ends of their axis: best at right
  // angles to it, where S is flat to second order.
  BoxScene scene = BoxScene::Cube(41);
  for (const Vec3& axis : { Vec3(0, 0, 1), glm::normalize(Vec3(1, 2, -0.5)) })
  {
    const auto blobs = [=](const Vec3& x)
    {
      const Vec3 one = x - 0.25 * axis;
      const Vec3 other = x + 0.25 * axis;
      return std::min(
        1.0, std::exp(-glm::dot(one, one) / 0.08) + std::exp(-glm::dot(other, other) / 0.08));
    };
    scene.Fill([=](const Vec3& x) { return 20 * blobs(x); }, blobs);
    const ViewScore score(scene.grid, { scene.extinction.data(), scene.importance.data() }, 1);
    const Orbit orbit = OrbitOf(scene.grid, false);

    const SearchResult result = FindViewpoints(score, orbit,
      ScoreViews(score, orbit, SpreadDirections(162), nullptr), SearchSettings(), nullptr);

    ASSERT_FALSE(result.viewpoints.empty());
    const double fromSide =
      std::asin(std::abs(glm::dot(result.viewpoints.front().direction, axis)));
    EXPECT_LE(fromSide, glm::radians(1.0)) << "the bar for symmetric scenes";
  }
}

TEST(FindViewpoints, RanksDistinctViewsAndNeverEndsBelowASample)
{
  const BoxScene scene = Filled(Content::Waves);
  const ViewScore score(scene.grid, { scene.extinction.data(), scene.importance.data() }, 1);
  const Orbit orbit = OrbitOf(scene.grid, false);
  const std::vector<ScoredView> samples = ScoreViews(score, orbit, SpreadDirections(60), nullptr);
  SearchSettings settings;
  settings.viewpoints = 5;

  const SearchResult result = FindViewpoints(score, orbit, samples, settings, nullptr);

  ASSERT_FALSE(result.viewpoints.empty());
  for (const ScoredView& sample : samples)
  {
    EXPECT_GE(result.viewpoints.front().worth, sample.worth);
  }
  for (std::size_t i = 0; i < result.viewpoints.size(); ++i)
  {
    for (std::size_t k = 0; k < i; ++k)
    {
      EXPECT_GE(result.viewpoints[k].worth, result.viewpoints[i].worth);
      EXPECT_LE(glm::dot(result.viewpoints[k].direction, result.viewpoints[i].direction),
        std::cos(settings.separation) + 1e-12);
    }
  }
  for (const std::vector<ScoredView>& path : result.paths)
  {
    for (std::size_t step = 1; step < path.size(); ++step)
    {
      EXPECT_GT(path[step].worth, path[step - 1].worth);
    }
  }
}

TEST(FindViewpoints, KeepsWhatWasDoneWhenItIsStopped)
{
  const BoxScene scene = Filled(Content::Onion);
  const ViewScore score(scene.grid, { scene.extinction.data(), scene.importance.data() }, 1);
  const Orbit orbit = OrbitOf(scene.grid, false);
  int calls = 0;

  const std::vector<ScoredView> samples =
    ScoreViews(score, orbit, SpreadDirections(50), [&](double) { return ++calls < 5; });
  const SearchResult result =
    FindViewpoints(score, orbit, samples, SearchSettings(), [](double) { return false; });

  const auto valid = std::count_if(
    samples.begin(), samples.end(), [](const ScoredView& view) { return view.valid; });
  EXPECT_GE(valid, 5);
  EXPECT_LT(valid, 50);
  EXPECT_FALSE(result.viewpoints.empty());
  EXPECT_TRUE(result.paths.empty());
}

// Observers of the progress may run code that is for one thread alone, as Python's is.
TEST(FindViewpoints, AsksOnTheThreadOfTheCallerAlone)
{
  const BoxScene scene = Filled(Content::Onion);
  const ViewScore score(scene.grid, { scene.extinction.data(), scene.importance.data() }, 1);
  const std::thread::id here = std::this_thread::get_id();
  std::atomic<int> elsewhere{ 0 };

  ScoreViews(score, OrbitOf(scene.grid, false), SpreadDirections(50),
    [&](double)
    {
      elsewhere += std::this_thread::get_id() == here ? 0 : 1;
      return true;
    });

  EXPECT_EQ(elsewhere, 0);
}

TEST(FindViewpoints, StaysWhereItIsAllowed)
{
  const BoxScene scene = Filled(Content::Waves);
  const ViewScore score(scene.grid, { scene.extinction.data(), scene.importance.data() }, 1);
  Orbit orbit = OrbitOf(scene.grid, false);
  const std::vector<ScoredView> samples = ScoreViews(score, orbit, SpreadDirections(40), nullptr);
  for (const Vec3& up : { Vec3(0, 1, 0), glm::normalize(Vec3(1, -2, 0.5)) })
  {
    SearchSettings settings;
    settings.viewpoints = 2;
    settings.precision = 0.02;
    settings.allowed.up = up;
    const std::vector<ScoredView> anywhere =
      FindViewpoints(score, orbit, samples, settings, nullptr).viewpoints;
    // Above the best, at it, and a ring that no sample lies in.
    const double best = ElevationOf(anywhere.front().direction, up);
    for (const auto& [lowest, highest] : { std::pair(best + 0.2, 0.5 * pi),
           std::pair(-0.5 * pi, best + 0.01), std::pair(0.123, 0.124), std::pair(0.0, 0.0) })
    {
      settings.allowed.lowest = std::min(lowest, 1.4);
      settings.allowed.highest = highest;
      settings.allowed.avoided = { glm::normalize(Vec3(1, 1, 1)) };
      settings.allowed.avoidanceAngle = 0.6;
      const SearchResult result = FindViewpoints(score, orbit, samples, settings, nullptr);

      ASSERT_FALSE(result.viewpoints.empty());
      for (const ScoredView& view : result.viewpoints)
      {
        EXPECT_TRUE(settings.allowed.Contains(view.direction));
        const double elevation = std::asin(glm::clamp(glm::dot(view.direction, up), -1.0, 1.0));
        EXPECT_GE(elevation, settings.allowed.lowest - 1e-6);
        EXPECT_LE(elevation, settings.allowed.highest + 1e-6);
        EXPECT_GE(std::acos(glm::dot(view.direction, settings.allowed.avoided[0])), 0.6 - 1e-6);
      }
      for (const ScoredView& sample : samples)
      {
        EXPECT_TRUE(!settings.allowed.Contains(sample.direction) ||
          result.viewpoints.front().worth >= sample.worth);
      }
    }
  }
}

// Along the edge of what is allowed it climbs as far as anywhere.
TEST(FindViewpoints, ClimbsAlongAnEdge)
{
  const BoxScene scene = Filled(Content::Waves);
  const ViewScore score(scene.grid, { scene.extinction.data(), scene.importance.data() }, 1);
  const Orbit orbit = OrbitOf(scene.grid, false);
  SearchSettings settings;
  settings.viewpoints = 4;
  settings.separation = 0.2;
  settings.allowed.lowest = settings.allowed.highest = 0.3;
  std::vector<Vec3> ring;
  for (int step = 0; step < 120; ++step)
  {
    const double azimuth = step * pi / 60;
    ring.emplace_back(
      std::cos(0.3) * std::cos(azimuth), std::sin(0.3), std::cos(0.3) * std::sin(azimuth));
  }
  const std::vector<ScoredView> all = ScoreViews(score, orbit, ring, nullptr);
  const double best = std::min_element(all.begin(), all.end(), IsBetter)->worth;

  const std::vector<ScoredView> samples = ScoreViews(score, orbit, SpreadDirections(60), nullptr);
  const SearchResult result = FindViewpoints(score, orbit, samples, settings, nullptr);

  ASSERT_FALSE(result.viewpoints.empty());
  EXPECT_GE(result.viewpoints.front().worth, 0.99 * best);
}

TEST(Orbit, KeepsUpWhatIsUp)
{
  Orbit orbit;
  for (const Vec3& up : { Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(-1, 0, 0), Vec3(0, -1, 0),
         glm::normalize(Vec3(1, -2, 0.5)) })
  {
    orbit.up = up;
    for (const Vec3& direction : RandomDirections(40))
    {
      const Vec3 viewUp = orbit.At(direction).viewUp;
      EXPECT_WITHIN(glm::length(viewUp), 1, Roundoff<double>(20, 1));
      EXPECT_WITHIN(glm::dot(viewUp, direction), 0, Roundoff<double>(20, 1));
      // As far up as it can be, so that nothing of it is to the side.
      EXPECT_GE(glm::dot(viewUp, up), 0);
      EXPECT_WITHIN(glm::dot(glm::cross(direction, viewUp), up), 0, Roundoff<double>(20, 1));
    }
    EXPECT_WITHIN(glm::dot(orbit.At(up).viewUp, up), 0, Roundoff<double>(20, 1));
  }
}

class SearchedScene : public RealScene
{
};

TEST_P(SearchedScene, ScoresAsTheMarchAndFindsTheBestOfManyDirections)
{
  LoadedScene scene(GetParam().name);
  const std::vector<float> proxy = scene.Proxy();
  const Orbit orbit = OrbitOf(scene.grid, false);
  for (const bool base : { false, true })
  {
    const std::vector<float>& extinction = base ? scene.file.extinction : proxy;
    const ViewScore score(scene.grid, { extinction.data(), scene.file.importance.data() }, 1);
    double worst = 0;
    for (const Vec3& direction : RandomDirections(5))
    {
      truth::SceneFile seen = scene.file;
      const Camera camera = orbit.At(direction);
      for (int axis = 0; axis < 3; ++axis)
      {
        seen.cameraPosition[std::size_t(axis)] = camera.position[axis];
        seen.cameraFocalPoint[std::size_t(axis)] = camera.focalPoint[axis];
      }
      truth::Sampling sampling;
      sampling.raysPerVoxel = 3;
      const double truth =
        truth::VisibilityScore(seen.FieldsWith(extinction), seen.Eye(), sampling);
      worst = std::max(worst, std::abs(score.At(camera).visibility / truth - 1));
    }
    EXPECT_LE(worst, 0.005);

    const std::vector<ScoredView> samples =
      ScoreViews(score, orbit, SpreadDirections(162), nullptr);
    SearchSettings settings;
    settings.firstStep = 0.13;
    const SearchResult result = FindViewpoints(score, orbit, samples, settings, nullptr);
    double best = 0;
    for (const ScoredView& view : ScoreViews(score, orbit, SpreadDirections(2562), nullptr))
    {
      best = std::max(best, view.worth);
    }
    std::cout << GetParam().name << (base ? ", base" : ", proxy") << ": worst score off by "
              << 100 * worst << " %, best found " << 100 * result.viewpoints.front().worth / best
              << " % of the best of 2562 directions with " << result.evaluations
              << " evaluations\n";
    EXPECT_GE(result.viewpoints.front().worth, 0.998 * best);
    EXPECT_LE(result.evaluations, 2562 / 4);
  }
}

INSTANTIATE_TEST_SUITE_P(Long, SearchedScene,
  ::testing::Values(Bars{ "carotid_mra", 0, 0 }, Bars{ "isabel_wind", 0, 0 },
    Bars{ "visible_male", 0, 0 }, Bars{ "engine", 0, 0 }),
  ::testing::PrintToStringParamName());
