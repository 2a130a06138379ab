// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Ways over a sphere whose scores are known everywhere.

#include "math/Angle.h"
#include "math/Number.h"
#include "viewpoint/CameraPath.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <vector>

using namespace limpid;

namespace
{
/// An octahedron whose triangles are divided into four so many times.
DirectionMesh Octasphere(int divisions)
{
  DirectionMesh mesh;
  mesh.directions = { Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(-1, 0, 0), Vec3(0, -1, 0),
    Vec3(0, 0, -1) };
  mesh.triangles = { { 0, 1, 2 }, { 1, 3, 2 }, { 3, 4, 2 }, { 4, 0, 2 }, { 1, 0, 5 }, { 3, 1, 5 },
    { 4, 3, 5 }, { 0, 4, 5 } };
  for (int i = 0; i < divisions; ++i)
  {
    std::map<std::pair<int, int>, int> middles;
    const auto between = [&](int a, int b)
    {
      const auto [entry, isNew] = middles.emplace(std::minmax(a, b), int(mesh.directions.size()));
      if (isNew)
      {
        mesh.directions.push_back(
          glm::normalize(mesh.directions[std::size_t(a)] + mesh.directions[std::size_t(b)]));
      }
      return entry->second;
    };
    std::vector<std::array<int, 3>> triangles;
    for (const auto& [a, b, c] : mesh.triangles)
    {
      const int ab = between(a, b);
      const int bc = between(b, c);
      const int ca = between(c, a);
      triangles.insert(triangles.end(),
        { { { a, ab, ca } }, { { ab, b, bc } }, { { ca, bc, c } }, { { ab, bc, ca } } });
    }
    mesh.triangles = triangles;
  }
  return mesh;
}

using Score = std::function<double(const Vec3&)>;

std::vector<double> ScoresOf(const DirectionMesh& mesh, const Score& score)
{
  std::vector<double> scores;
  for (const Vec3& direction : mesh.directions)
  {
    scores.push_back(score(direction));
  }
  return scores;
}

/// 1 at the top, e^-1 at `width` from it [radians].
double HillAt(const Vec3& top, double width, const Vec3& direction)
{
  return std::exp(-std::pow(AngleBetween(glm::normalize(top), direction) / width, 2));
}

double LargestTurn(const CameraPath& path)
{
  double largest = 0;
  for (std::size_t i = path.closed ? 0 : 1; i < path.directions.size(); ++i)
  {
    const std::size_t last = (i + path.directions.size() - 1) % path.directions.size();
    largest = std::max(largest, AngleBetween(path.directions[last], path.directions[i]));
  }
  return largest;
}

double SmallestTurn(const CameraPath& path)
{
  double smallest = pi;
  for (std::size_t i = 1; i < path.directions.size(); ++i)
  {
    smallest = std::min(smallest, AngleBetween(path.directions[i - 1], path.directions[i]));
  }
  return smallest;
}

/// The largest change of the path's direction between frames.
double LargestBend(const CameraPath& path)
{
  double largest = 0;
  const std::size_t count = path.directions.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vec3& here = path.directions[i];
    const Vec3 before = here - path.directions[(i + count - 1) % count];
    const Vec3 after = path.directions[(i + 1) % count] - here;
    largest = std::max(largest, AngleBetween(before, after));
  }
  return largest;
}

class RoundTrips : public ::testing::TestWithParam<int>
{
};
}

TEST(DirectionMesh, InterpolatesLinearly)
{
  const DirectionMesh mesh = Octasphere(2);
  const std::vector<double> scores = ScoresOf(mesh, [](const Vec3& d) { return 2 + d.x; });
  for (std::size_t i = 0; i < mesh.directions.size(); ++i)
  {
    EXPECT_NEAR(mesh.At(scores, mesh.directions[i]), scores[i], 1e-12);
  }
  const auto& [a, b, c] = mesh.triangles[5];
  const Vec3 middle = mesh.directions[std::size_t(a)] + mesh.directions[std::size_t(b)] +
    mesh.directions[std::size_t(c)];
  EXPECT_NEAR(mesh.At(scores, glm::normalize(middle)), 2 + middle.x / 3, 1e-12);
  for (const std::vector<int>& ofOne : mesh.Neighbours())
  {
    EXPECT_TRUE(ofOne.size() == 4 || ofOne.size() == 6);
  }
}

TEST_P(RoundTrips, GoThroughTheBestViewsAtEvenSpeed)
{
  const std::vector<Vec3> tops = { Vec3(1, 0.2, 0), Vec3(0, 0.3, 1), Vec3(-1, -0.4, 0.3),
    Vec3(0.2, -0.2, -1), Vec3(0.7, 0.1, 0.8) };
  const DirectionMesh mesh = Octasphere(4);
  const Score score = [&](const Vec3& d)
  {
    double sum = 0.05;
    for (std::size_t i = 0; i < tops.size(); ++i)
    {
      sum += (1 - 0.1 * double(i)) * HillAt(tops[i], 0.35, d);
    }
    return sum;
  };
  CameraPathSettings settings;
  settings.keyViews = 5;
  settings.frames = GetParam();

  const CameraPath path = RoundTrip(mesh, ScoresOf(mesh, score), settings);

  ASSERT_EQ(int(path.directions.size()), settings.frames);
  ASSERT_EQ(path.keyViews.size(), tops.size());
  for (const Vec3& top : tops)
  {
    double best = 0;
    double nearest = pi;
    for (const int frame : path.keyViews)
    {
      const Vec3& direction = path.directions[std::size_t(frame)];
      const double angle = AngleBetween(direction, glm::normalize(top));
      best = angle < nearest ? score(direction) : best;
      nearest = std::min(nearest, angle);
    }
    EXPECT_GE(best, 0.88 * score(glm::normalize(top))); // the mesh does not have the very top
    EXPECT_LT(nearest, 0.2);
  }
  EXPECT_LT(LargestTurn(path), 1.15 * SmallestTurn(path));
  EXPECT_LT(LargestBend(path), 40 * pi / 180 * 120 / settings.frames);
  EXPECT_TRUE(std::is_sorted(path.keyViews.begin(), path.keyViews.end()) ||
    path.keyViews.front() > path.keyViews.back());
  for (std::size_t i = 0; i < path.directions.size(); ++i)
  {
    // Linear over triangles 0.12 wide, of a bend of 2 / 0.35^2.
    EXPECT_NEAR(path.scores[i], score(path.directions[i]), 0.12 * 0.12 / 6 / (0.35 * 0.35) * 2);
  }
}

INSTANTIATE_TEST_SUITE_P(Frames, RoundTrips, ::testing::Values(90, 120, 240));

// Between two hills on a ridge, it takes the ridge and not the valley that is a little shorter.
TEST(RoundTrip, FollowsRidges)
{
  const DirectionMesh mesh = Octasphere(4);
  const auto ridge = [](const Vec3& d)
  { return std::exp(-std::pow(AngleBetween(d, Vec3(0, 1, 0)) - 0.9, 2) / 0.01); };
  const auto score = [&](const Vec3& d)
  { return 0.8 * ridge(d) + HillAt(Vec3(1, 0.8, 0), 0.1, d) + HillAt(Vec3(-1, 0.8, 0.2), 0.1, d); };
  CameraPathSettings settings;
  settings.keyViews = 2;

  const CameraPath path = RoundTrip(mesh, ScoresOf(mesh, score), settings);

  for (const Vec3& direction : path.directions)
  {
    EXPECT_GT(ridge(direction), 0.3);
  }
}

TEST(RoundTrip, StaysWhereItIsAllowed)
{
  const DirectionMesh mesh = Octasphere(4);
  const auto score = [](const Vec3& d) { return 0.1 + HillAt(Vec3(0, 1, 0), 1, d); };
  CameraPathSettings settings;
  settings.allowed.lowest = -0.2;
  settings.allowed.highest = 0.6;
  settings.allowed.avoided = { Vec3(0, 0, 1) };
  settings.allowed.avoidanceAngle = 0.5;

  const CameraPath path = RoundTrip(mesh, ScoresOf(mesh, score), settings);

  ASSERT_EQ(path.directions.size(), 120u);
  for (const Vec3& direction : path.directions)
  {
    const double elevation = std::asin(direction.y);
    EXPECT_TRUE(elevation > -0.2 - 1e-6 && elevation < 0.6 + 1e-6) << elevation;
    EXPECT_GT(AngleBetween(direction, Vec3(0, 0, 1)), 0.45); // chords between its points
  }
  settings.allowed.avoided.emplace_back(0, 0, -1);
  settings.allowed.avoidanceAngle = 2;
  EXPECT_TRUE(RoundTrip(mesh, ScoresOf(mesh, score), settings).directions.empty());
}

TEST(RoundTrip, OfOneKeyViewStaysThere)
{
  const DirectionMesh mesh = Octasphere(3);
  CameraPathSettings settings;
  settings.keyViews = 1;
  settings.frames = 10;
  const CameraPath path =
    RoundTrip(mesh, ScoresOf(mesh, [](const Vec3& d) { return 1 + d.x; }), settings);
  for (const Vec3& direction : path.directions)
  {
    EXPECT_NEAR(AngleBetween(direction, Vec3(1, 0, 0)), 0, 1e-6);
  }
}

TEST(RoundTrip, IsThereWhereAllIsTheSame)
{
  const DirectionMesh mesh = Octasphere(2);
  for (const double same : { 0.0, 3.0 })
  {
    const CameraPath path = RoundTrip(mesh, std::vector<double>(mesh.directions.size(), same), {});
    EXPECT_EQ(path.directions.size(), 120u);
    EXPECT_LT(LargestTurn(path), 0.2);
  }
}

// A hill that wanders is followed, evenly.
TEST(PathThroughTime, FollowsWhatCanBeSeen)
{
  const DirectionMesh mesh = Octasphere(4);
  constexpr int steps = 40;
  const auto topAt = [](int step)
  {
    const double angle = 2.0 * step / steps;
    return Vec3(std::cos(angle), 0.3, std::sin(angle));
  };
  std::vector<std::vector<double>> scores;
  scores.reserve(steps);
  for (int step = 0; step < steps; ++step)
  {
    scores.push_back(
      ScoresOf(mesh, [&](const Vec3& d) { return 0.1 + HillAt(topAt(step), 0.6, d); }));
  }

  const CameraPath path = PathThroughTime(mesh, scores, {});

  ASSERT_EQ(int(path.directions.size()), steps);
  EXPECT_EQ(path.keyViews.size(), path.directions.size());
  for (int step = 0; step < steps; ++step)
  {
    const auto at = std::size_t(step);
    const double best = *std::max_element(scores[at].begin(), scores[at].end());
    EXPECT_GE(path.scores[at], 0.9 * best);
  }
  EXPECT_LT(LargestTurn(path), 0.1); // the hill goes 0.05
}

// It does not go to and fro between two hills that are higher in turns.
TEST(PathThroughTime, StaysWhereTurningWouldGainLittle)
{
  const DirectionMesh mesh = Octasphere(4);
  std::vector<std::vector<double>> scores;
  scores.reserve(20);
  for (int step = 0; step < 20; ++step)
  {
    const double more = step % 2 == 0 ? 1.1 : 1.0;
    scores.push_back(ScoresOf(mesh,
      [&](const Vec3& d) {
        return more * HillAt(Vec3(1, 0, 0), 0.4, d) + (2.1 - more) * HillAt(Vec3(-1, 0, 0), 0.4, d);
      }));
  }

  const CameraPath path = PathThroughTime(mesh, scores, {});

  EXPECT_LT(LargestTurn(path), 0.01);
  EXPECT_GT(std::abs(path.directions[7].x), 0.95);
}

TEST(PathThroughTime, OfOneStepIsTheBestDirection)
{
  const DirectionMesh mesh = Octasphere(3);
  const CameraPath path =
    PathThroughTime(mesh, { ScoresOf(mesh, [](const Vec3& d) { return 1 + d.z; }) }, {});
  ASSERT_EQ(path.directions.size(), 1u);
  EXPECT_NEAR(path.directions[0].z, 1, 1e-12);
  EXPECT_TRUE(PathThroughTime(mesh, {}, {}).directions.empty());
}
