// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How scores change when the camera moves, against differences of the reference march.

#include "LoadedScene.h"
#include "Tolerance.h"
#include "TurnedMarch.h"
#include "ViewScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
constexpr double angle = 1e-3; // of the differences; they are off by its square

/// Whether a side of the box comes into view between the eyes of a difference. Where the fields are
/// cut off there, S has a kink, and a difference across it is the derivative on neither side.
bool HasKink(const Grid& grid, const Orbit& orbit, const Vec3& direction)
{
  if (orbit.parallel)
  {
    const Vec3 share = glm::abs(glm::transpose(grid.direction) * direction);
    return std::min({ share.x, share.y, share.z }) <= angle;
  }
  const Vec3 eye = grid.PointToIndex(orbit.At(direction).position);
  const Vec3 reach = orbit.distance * angle / grid.spacing;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double last = grid.nodes[axis] - 1;
    if (std::min(std::abs(eye[axis]), std::abs(eye[axis] - last)) <= reach[axis])
    {
      return true;
    }
  }
  return false;
}

struct SlopePair
{
  Vec3 direction;
  glm::dvec2 found;
  glm::dvec2 truth;
};

/// Slopes per radian along two ways.
SlopePair SlopesOf(const ViewScore& score, const Orbit& orbit, const truth::Volume<float>& volume,
  const Vec3& direction, double raysPerVoxel)
{
  const Vec3 right = glm::normalize(glm::cross(direction, Vec3(0.3, 0.5, 0.8)));
  const Vec3 up = glm::cross(right, direction);
  const Vec3 slope = orbit.distance * score.SlopeAt(orbit.At(direction)).slope;
  const truth::Viewer viewer{ ToTruth(orbit.centre), orbit.distance, orbit.parallel,
    ToTruth(direction), { ToTruth(right), ToTruth(up) } };
  truth::Sampling sampling;
  sampling.raysPerVoxel = raysPerVoxel;
  const truth::TurnedScore turned = truth::ScoreTurned(volume, viewer, angle, sampling);
  return { direction, { glm::dot(slope, right), glm::dot(slope, up) },
    { turned.slope[0], turned.slope[1] } };
}

/// The bar: 1 % of the slope or 0.1 % of the largest one. Returns how many are off by more.
int CountBeyondTheBar(const std::vector<SlopePair>& pairs, const std::string& name)
{
  double largest = 0;
  for (const SlopePair& pair : pairs)
  {
    largest = std::max(largest, glm::length(pair.truth));
  }
  int beyond = 0;
  double worst = 0;
  for (const SlopePair& pair : pairs)
  {
    const double error = glm::distance(pair.found, pair.truth);
    const double share = error / glm::length(pair.truth);
    if (share > 0.01 && error > 1e-3 * largest)
    {
      ++beyond;
      std::cout << "from " << pair.direction.x << " " << pair.direction.y << " " << pair.direction.z
                << ": " << pair.found.x << " " << pair.found.y << " for " << pair.truth.x << " "
                << pair.truth.y << ", largest " << largest << "\n";
    }
    worst = std::max(worst, std::min(share, 10 * error / largest));
  }
  std::cout << name << ": " << pairs.size() << " directions, worst " << 100 * worst
            << " % of the slope or of a tenth of the largest\n";
  return beyond;
}

}

class TurnedBox : public ::testing::TestWithParam<Case>
{
};

TEST_P(TurnedBox, ChangesAsTheMarchSaysWhenTheCameraMoves)
{
  const BoxScene scene = Filled(GetParam().content);
  const ViewScore score(scene.grid, { scene.extinction.data(), scene.importance.data() }, 3);
  const Orbit orbit = OrbitOf(scene.grid, GetParam().parallel);
  std::vector<SlopePair> pairs;
  for (const Vec3& direction : RandomDirections(6))
  {
    const double visible = score.At(orbit.At(direction)).visibility;
    EXPECT_NEAR(score.SlopeAt(orbit.At(direction)).score, visible, 0.005 * visible);
    if (!HasKink(scene.grid, orbit, direction))
    {
      pairs.push_back(SlopesOf(score, orbit, scene.TruthWith(scene.extinction), direction,
        GetParam().content == Content::Borders ? 16 : 6));
    }
  }

  EXPECT_GE(pairs.size(), 5u);
  EXPECT_EQ(CountBeyondTheBar(pairs, GetParam().name), 0);
}

INSTANTIATE_TEST_SUITE_P(Boxes, TurnedBox,
  ::testing::Values(
    Case{ "Onion", Content::Onion, false }, Case{ "ParallelWaves", Content::Waves, true }),
  ::testing::PrintToStringParamName());

// Rays meet an edge of the box all at once: the march takes many.
INSTANTIATE_TEST_SUITE_P(Long, TurnedBox,
  ::testing::Values(Case{ "Waves", Content::Waves, false },
    Case{ "ParallelOnion", Content::Onion, true }, Case{ "Borders", Content::Borders, false },
    Case{ "ParallelBorders", Content::Borders, true }),
  ::testing::PrintToStringParamName());

namespace
{
/// How many rays a scene takes to show its slopes.
struct TurnedCase
{
  const char* name;
  bool base; ///< extinction: the base's, otherwise the proxy
  bool parallel;
  double rayDensity;   ///< of the sweep
  double raysPerVoxel; ///< of the march
};

std::ostream& operator<<(std::ostream& stream, const TurnedCase& one)
{
  return stream << one.name << (one.base ? "_base" : "_proxy") << (one.parallel ? "_parallel" : "");
}
}

class TurnedScene : public ::testing::TestWithParam<TurnedCase>
{
};

TEST_P(TurnedScene, ChangesAsTheMarchSaysWhenTheCameraMoves)
{
  const TurnedCase& one = GetParam();
  if (!IsThere(one.name))
  {
    GTEST_SKIP() << PathOf(one.name)
                 << " is not there. Set LIMPID_TEST_DATA to the folder with the test scenes.";
  }
  const LoadedScene scene(one.name);
  const std::vector<float> extinction = one.base ? scene.file.extinction : scene.Proxy();
  const ViewScore score(
    scene.grid, { extinction.data(), scene.file.importance.data() }, one.rayDensity);
  const Orbit orbit = OrbitOf(scene.grid, one.parallel);
  std::vector<SlopePair> pairs;
  for (const Vec3& direction : RandomDirections(20))
  {
    if (!HasKink(scene.grid, orbit, direction))
    {
      pairs.push_back(
        SlopesOf(score, orbit, scene.file.FieldsWith(extinction), direction, one.raysPerVoxel));
    }
  }

  EXPECT_GE(pairs.size(), 18u);
  EXPECT_EQ(CountBeyondTheBar(pairs, ::testing::PrintToString(one)), 0);
}

INSTANTIATE_TEST_SUITE_P(Long, TurnedScene,
  ::testing::Values(TurnedCase{ "carotid_mra", false, false, 4, 16 },
    TurnedCase{ "carotid_mra", true, false, 4, 12 },
    TurnedCase{ "isabel_wind", false, false, 4, 12 },
    TurnedCase{ "isabel_wind", true, false, 4, 12 },
    TurnedCase{ "visible_male", false, false, 3, 5 }),
  ::testing::PrintToStringParamName());
