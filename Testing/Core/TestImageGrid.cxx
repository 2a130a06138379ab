// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Grids of images whose direction matrices were written with few digits, or whose spacing is
// negative.

#include "Tolerance.h"

#include "math/Require.h"
#include "scene/ImageGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

using namespace limpid;

namespace
{
const Int3 nodes{ 4, 5, 6 };
const Vec3 origin{ 1, 2, 3 };
const Vec3 spacing{ 0.5, 2, 1 };

/// Three random axes at right angles, right-handed or not.
Mat3 RandomAxes(std::mt19937& random)
{
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vec3(normal(random), normal(random), normal(random)); };
  const Vec3 x = glm::normalize(vector());
  const Vec3 y = glm::normalize(glm::cross(x, vector()));
  const double hand = random() % 2 == 0 ? 1 : -1;
  return { x, y, hand * glm::cross(x, y) };
}

Mat3 Rounded(const Mat3& matrix, int digits)
{
  const double unit = std::pow(10.0, digits);
  Mat3 rounded;
  for (int column = 0; column < 3; ++column)
  {
    rounded[column] = glm::round(matrix[column] * unit) / unit;
  }
  return rounded;
}

double LargestDifference(const Mat3& one, const Mat3& other)
{
  double largest = 0;
  for (int column = 0; column < 3; ++column)
  {
    for (int row = 0; row < 3; ++row)
    {
      largest = std::fmax(largest, std::abs(one[column][row] - other[column][row]));
    }
  }
  return largest;
}

Mat3 DirectionOf(const Mat3& given)
{
  return ImageGrid(nodes, origin, spacing, given).direction;
}
}

TEST(ImageGrid, MakesDirectionsOfFewDigitsOrthonormal)
{
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i)
  {
    const Mat3 axes = RandomAxes(random);
    for (int digits = 3; digits <= 12; ++digits)
    {
      const Mat3 rounded = Rounded(axes, digits);
      const Mat3 found = DirectionOf(rounded);

      // Below 1e-12 the matrix stays as it was given.
      EXPECT_LE(DistanceFromOrthonormal(found), 1.01e-12) << digits << " digits";
      // The nearest orthonormal matrix is no farther from the rounded one than the exact one is, by
      // the sum of squares over the nine entries.
      const double rounding = 3 * 0.5 * std::pow(10.0, -digits);
      EXPECT_LE(LargestDifference(found, rounded), rounding) << digits << " digits";
      EXPECT_GT(glm::determinant(found) * glm::determinant(axes), 0);
    }
  }
}

TEST(ImageGrid, LeavesExactDirectionsAsTheyAre)
{
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i)
  {
    const Mat3 axes = RandomAxes(random);
    EXPECT_EQ(DirectionOf(axes), axes);
  }
}

TEST(ImageGrid, TakesShearThatIsAsSmallAsRounding)
{
  for (const double shear : { 0.001, 0.0017 })
  {
    const Mat3 direction = DirectionOf(Mat3(1, shear, 0, 0, 1, 0, 0, 0, 1));

    EXPECT_LE(DistanceFromOrthonormal(direction), 1.01e-12);
    // The nearest orthonormal matrix turns both axes by half of the shear.
    EXPECT_NEAR(direction[0][1], shear / 2, shear * shear);
    EXPECT_NEAR(direction[1][0], -shear / 2, shear * shear);
  }
}

TEST(ImageGrid, RefusesShearScaleAndWhatIsNoMatrix)
{
  const double notANumber = std::numeric_limits<double>::quiet_NaN();
  for (const Mat3& wrong :
    { Mat3(1, 0.002, 0, 0, 1, 0, 0, 0, 1), Mat3(1, 0.5, 0, 0, 1, 0, 0, 0, 1), Mat3(1.001),
      Mat3(2.0), Mat3(0.0), Mat3(notANumber), Mat3(1, 0, 0, 0, 1, 0, 0, notANumber, 1) })
  {
    EXPECT_THROW(DirectionOf(wrong), Error);
  }
}

TEST(ImageGrid, TurnsAnAxisOfNegativeSpacingRound)
{
  std::mt19937 random(3);
  const Mat3 axes = RandomAxes(random);
  const Vec3 given{ -0.5, 2, -1 };
  const Grid grid = ImageGrid(nodes, origin, given, axes);

  EXPECT_EQ(grid.spacing, glm::abs(given));
  const Vec3 last = Vec3(nodes - 1);
  EXPECT_EQ(grid.PointToWorld(last), origin + axes * (last * given));
}

TEST(ImageGrid, RefusesSpacingsThatAreZeroOrNoNumbers)
{
  for (const double wrong : { 0.0, -0.0, std::numeric_limits<double>::quiet_NaN(),
         -std::numeric_limits<double>::infinity() })
  {
    EXPECT_THROW(ImageGrid(nodes, origin, { 1, wrong, 1 }, Mat3(1.0)), Error);
  }
}
