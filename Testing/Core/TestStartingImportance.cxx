// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What is taken for important of an array when nobody has said it.

#include "scene/StartingImportance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace
{
using limpid::CleanRamp;
using limpid::ImportanceRamp;
using limpid::mostSpecks;
using limpid::RampOf;
using limpid::SpeckShare;
using limpid::ValueWithNeighbours;

/// Values of size^3 nodes.
struct Image
{
  int size;
  std::vector<double> values;

  double& At(int i, int j, int k)
  {
    return this->values[static_cast<std::size_t>((k * this->size + j) * this->size + i)];
  }

  std::vector<double> Sorted() const
  {
    std::vector<double> sorted = this->values;
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  }

  std::vector<ValueWithNeighbours> Above(double least) const
  {
    std::vector<ValueWithNeighbours> above;
    const auto valueAt = [this](int i, int j, int k)
    { return this->values[static_cast<std::size_t>((k * this->size + j) * this->size + i)]; };
    for (int node = 0; node < this->size * this->size * this->size; ++node)
    {
      const int i = node % this->size;
      const int j = node / this->size % this->size;
      const int k = node / (this->size * this->size);
      if (valueAt(i, j, k) > least)
      {
        above.push_back({ valueAt(i, j, k),
          limpid::EighthLargestNeighbour(
            { { this->size, this->size, this->size } }, { { i, j, k } }, valueAt) });
      }
    }
    return above;
  }
};

/// A ball of 1 in 0.5 in nothing, with Rician noise of a standard deviation.
Image Ball(double noise)
{
  Image image{ 40, {} };
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (int node = 0; node < 64000; ++node)
  {
    const double x = node % 40 - 19.5;
    const double y = node / 40 % 40 - 19.5;
    const double z = node / 1600 - 19.5;
    const double radius = std::sqrt(x * x + y * y + z * z);
    const double value = radius < 7 ? 1 : radius < 17 ? 0.5 : 0;
    image.values.push_back(std::hypot(value + noise * normal(random), noise * normal(random)));
  }
  return image;
}

/// So many zeros and ones.
std::vector<double> Mask(std::size_t zeros, std::size_t ones)
{
  std::vector<double> values(zeros + ones, 0.0);
  std::fill(values.begin() + static_cast<std::ptrdiff_t>(zeros), values.end(), 1.0);
  return values;
}
}

TEST(StartingImportance, RisesBetweenThe95thAnd99thPercentile)
{
  std::vector<double> values(1001);
  std::iota(values.begin(), values.end(), 0.0);

  const ImportanceRamp ramp = RampOf(values, { { 0, 1000 } });

  EXPECT_EQ(ramp.begin, 950);
  EXPECT_EQ(ramp.end, 990);
  EXPECT_EQ(ramp.range[1], 1000);
}

TEST(StartingImportance, OfAMaskIsItsInsideHoweverLargeThatIs)
{
  for (const std::size_t ones : { 2, 30, 100, 900 })
  {
    const ImportanceRamp ramp = RampOf(Mask(1000 - ones, ones), { { 0, 1 } });

    EXPECT_EQ(ramp.begin, 0) << ones;
    EXPECT_EQ(ramp.end, 1) << ones;
  }
}

TEST(StartingImportance, TakesLargeFillValuesForNothing)
{
  std::vector<double> values(1001);
  std::iota(values.begin(), values.end(), 0.0);
  const std::size_t count = values.size();
  for (const double fill : { 1e20, 9.96921e36, 3.4028235e38, 1.7e308 })
  {
    for (const std::size_t fills : { 1, 30, 100, 5000 })
    {
      values.resize(count);
      values.resize(count + fills, fill);

      const ImportanceRamp ramp = RampOf(values, { { 0, fill } });

      EXPECT_EQ(ramp.begin, 950) << fill << ", " << fills;
      EXPECT_EQ(ramp.end, 990) << fill << ", " << fills;
    }
  }
}

TEST(StartingImportance, TakesLargeValuesThatAreNoFillForValues)
{
  std::vector<double> labels{ 0, 3, 1034 };
  labels.resize(1000, 1034);
  labels.resize(1100, 65535);
  EXPECT_EQ(RampOf(labels, { { 0, 65535 } }).end, 65535);

  std::vector<double> decades; // no gap
  for (int power = 0; power < 200; ++power)
  {
    decades.push_back(std::pow(10.0, 0.15 * power));
  }
  EXPECT_GT(RampOf(decades, { { 1, 1e30 } }).end, 1e29);

  // A mask of large numbers.
  EXPECT_EQ(RampOf({ 0, 0, 0, 1e20 }, { { 0, 1e20 } }).end, 1e20);
}

TEST(StartingImportance, OfCleanValuesStaysWhatItIs)
{
  const Image image = Ball(0.0);

  const ImportanceRamp first = RampOf(image.Sorted(), {});
  const ImportanceRamp ramp = CleanRamp(first, image.Sorted(), image.Above(first.begin));

  EXPECT_LT(SpeckShare(first, image.Above(first.begin)), mostSpecks);
  EXPECT_EQ(ramp.begin, first.begin);
  EXPECT_EQ(ramp.end, first.end);
}

// The ball is 2.2 % of the nodes, and stands out of the noise; the 95th percentile is within it.
TEST(StartingImportance, MovesUpOutOfTheNoise)
{
  for (const double noise : { 0.08, 0.09, 0.1 })
  {
    const Image image = Ball(noise);

    const ImportanceRamp first = RampOf(image.Sorted(), {});
    const std::vector<ValueWithNeighbours> above = image.Above(first.begin);
    const ImportanceRamp ramp = CleanRamp(first, image.Sorted(), above);

    EXPECT_GT(SpeckShare(first, above), mostSpecks) << noise;
    EXPECT_LT(SpeckShare(ramp, above), mostSpecks) << noise;
    EXPECT_GT(ramp.begin, first.begin) << noise;
    EXPECT_LT(ramp.end, 1 + 3 * noise) << "the ball is still important";
  }
}

TEST(StartingImportance, OfNothingButNoiseIsTheLeastNoisyOne)
{
  const Image image = Ball(10.0);

  const ImportanceRamp first = RampOf(image.Sorted(), {});
  const std::vector<ValueWithNeighbours> above = image.Above(first.begin);
  const ImportanceRamp ramp = CleanRamp(first, image.Sorted(), above);

  EXPECT_LE(SpeckShare(ramp, above), SpeckShare(first, above));
  EXPECT_TRUE(ramp.IsKnown());
}

TEST(StartingImportance, KnowsSpecksAsTheMedianDoes)
{
  // One node alone, a wall, and what the border stands for.
  Image image{ 5, std::vector<double>(125, 0.0) };
  image.At(2, 2, 2) = 1;
  EXPECT_EQ(SpeckShare({ 0, 1, {} }, image.Above(0)), 1);
  for (int number = 0; number < 25; ++number)
  {
    image.At(0, number % 5, number / 5) = 1;
  }
  EXPECT_NEAR(SpeckShare({ 0, 1, {} }, image.Above(0)), 1.0 / 26, 1e-12);
}

TEST(StartingImportance, TakesNeighboursThatAreNoNumbersForEmpty)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double none : { std::numeric_limits<double>::quiet_NaN(), infinity, -infinity })
  {
    const auto valueAt = [none](int i, int j, int k) { return i * j * k == 1 ? 1.0 : none; };

    EXPECT_EQ(limpid::EighthLargestNeighbour({ { 3, 3, 3 } }, { { 1, 1, 1 } }, valueAt), -infinity);
  }
}

TEST(StartingImportance, IsNotKnownWhereNothingStandsOut)
{
  EXPECT_FALSE(RampOf({}, {}).IsKnown());
  EXPECT_FALSE(RampOf(Mask(10, 0), { { 0, 0 } }).IsKnown());
}
