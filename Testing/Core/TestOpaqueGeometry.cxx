// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What of an importance lies in front of opaque geometry.

#include "Tolerance.h"
#include "Viewing.h"

#include "math/Range.h"
#include "scene/OpaqueGeometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

using namespace limpid;

namespace
{
Grid Cube()
{
  Grid grid;
  grid.nodes = { 9, 9, 9 };
  grid.origin = { 3, -2, 5 };
  grid.spacing = { 0.5, 0.5, 0.5 };
  return grid;
}

/// A wall over the whole picture, seen along z from z = 0; the view is from 1 to 21 in front.
OpaqueGeometry WallAt(double z)
{
  const Grid grid = Cube();
  OpaqueGeometry wall;
  wall.width = wall.height = 16;
  wall.clipToWorld = Parallel(
    LookAt({ grid.Centre().x, grid.Centre().y, 0 }, grid.Centre(), { 0, 1, 0 }), 3, 1, 1, 21);
  wall.depth.assign(256, float(2 * (z - 1) / 20 - 1));
  return wall;
}

std::vector<float> Ones(const Grid& grid)
{
  return std::vector<float>(std::size_t(grid.NodeCount()), 1.0f);
}

double Sum(const std::vector<float>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0);
}
}

// The hat functions of a column add up to 1 within the box, and the first one begins in its middle.
TEST(OpaqueGeometry, LeavesTheMatterInFrontOfAWall)
{
  const Grid grid = Cube();
  for (const double nodes : { 0.5, 2.0, 3.3, 6.75 })
  {
    const OpaqueGeometry wall = WallAt(grid.origin.z + nodes * grid.spacing.z);

    const std::vector<float> left = wall.InFront(grid, Ones(grid).data());

    EXPECT_WITHIN(
      Sum(left) / 81, nodes + 0.5, Roundoff<float>(200, 21 / grid.spacing.z)); // depths in floats
    EXPECT_EQ(left.back(), 0);
  }
}

TEST(OpaqueGeometry, LeavesAllOrNothingWhereItIsFarAway)
{
  const Grid grid = Cube();
  std::vector<float> importance = Ones(grid);
  importance[300] = 0.25f;

  EXPECT_EQ(WallAt(12).InFront(grid, importance.data()), importance);
  EXPECT_EQ(Sum(WallAt(2).InFront(grid, importance.data())), 0);
}

TEST(OpaqueGeometry, HidesNothingWhereThereIsNoneAndBesideThePicture)
{
  const Grid grid = Cube();
  OpaqueGeometry wall = WallAt(2);
  for (int row = 0; row < 16; ++row)
  {
    std::fill_n(wall.depth.begin() + 16 * row, 8, 1.0f); // its left half
  }
  const std::vector<float> half = wall.InFront(grid, Ones(grid).data());
  EXPECT_GE(Sum(half), 4 * 81);
  EXPECT_LE(Sum(half), 5 * 81);

  OpaqueGeometry aside = WallAt(2);
  aside.clipToWorld = Parallel(LookAt({ 40, 0, 0 }, { 40, 0, 5 }, { 0, 1, 0 }), 3, 1, 1, 21);
  EXPECT_EQ(aside.InFront(grid, Ones(grid).data()), Ones(grid));
}

// Seen from near by, where rays spread and depths are not linear.
TEST(OpaqueGeometry, LeavesTheSameInPerspective)
{
  const Grid grid = Cube();
  const Vec3 eye(grid.Centre().x, grid.Centre().y, 0);
  const double wallAt = grid.origin.z + 2.4 * grid.spacing.z;
  OpaqueGeometry wall;
  wall.width = wall.height = 512;
  wall.clipToWorld = Perspective(LookAt(eye, grid.Centre(), { 0, 1, 0 }), 60, 1, 1, 21);
  const glm::dvec4 clip = glm::inverse(wall.clipToWorld) * glm::dvec4(eye.x, eye.y, wallAt, 1);
  wall.depth.assign(512 * 512, float(clip.z / clip.w));

  const std::vector<float> left = wall.InFront(grid, Ones(grid).data());

  // 0.4 nodes or more in front of it, and 0.6 or more behind.
  const std::vector<Range<float>> shares{ { 1, 1 }, { 1, 1 }, { 0.8f, 1 }, { 0, 0.1f }, { 0, 0 } };
  for (std::size_t node = 0; node < left.size(); ++node)
  {
    const Range<float>& share = shares[std::min<std::size_t>(node / 81, 4)];
    EXPECT_GE(left[node], share.begin);
    EXPECT_LE(left[node], share.end);
  }
}
