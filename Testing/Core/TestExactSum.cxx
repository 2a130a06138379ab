// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Sums without rounding: closed forms, any order, any split; against the processor's own rounding
// where a sum of two is rounded once.

#include "math/ExactSum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace limpid;

namespace
{
double SumOf(const std::vector<double>& numbers)
{
  ExactSum sum;
  for (const double number : numbers)
  {
    sum.Add(number);
  }
  return sum.Value();
}

/// Random numbers of very different sizes and both signs.
std::vector<double> Numbers(std::size_t count, int exponents)
{
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> fraction(-1, 1);
  std::uniform_int_distribution<int> exponent(-exponents, exponents);
  std::vector<double> numbers(count);
  for (double& number : numbers)
  {
    number = std::ldexp(fraction(random), exponent(random));
  }
  return numbers;
}
}

TEST(ExactSum, IsEveryNumberItself)
{
  const double least = std::numeric_limits<double>::denorm_min();
  const double tiny = std::numeric_limits<double>::min();
  const double huge = std::numeric_limits<double>::max();
  for (const double number : { 0.0, 1.0, -1.0, 0.1, -1e300, 1e-300, least, -least, 3 * least, tiny,
         -tiny, tiny - least, huge, -huge })
  {
    EXPECT_EQ(number, SumOf({ number }));
  }
}

TEST(ExactSum, RoundsTwoNumbersAsTheProcessorDoes)
{
  for (const int exponents : { 2, 30, 60, 1000 })
  {
    const std::vector<double> numbers = Numbers(2000, exponents);
    for (std::size_t i = 0; i + 1 < numbers.size(); ++i)
    {
      EXPECT_EQ(numbers[i] + numbers[i + 1], SumOf({ numbers[i], numbers[i + 1] }));
    }
  }
}

TEST(ExactSum, RoundsOnceAndToTheNearest)
{
  const double half = std::ldexp(1.0, -53); // of the last bit of 1
  const double next = 1 + 2 * half;
  EXPECT_EQ(1.0, SumOf({ 1, half })); // of two, the even one
  EXPECT_EQ(next + 2 * half, SumOf({ next, half }));
  EXPECT_EQ(next, SumOf({ 1, half, 1e-300 })); // far less than a bit decides
  EXPECT_EQ(1.0, SumOf({ 1, half, -1e-300 }));
  EXPECT_EQ(1.0, SumOf({ 1e300, 1, -1e300 }));
  EXPECT_EQ(-1e-300, SumOf({ 1e300, -1e-300, -1e300 }));
}

TEST(ExactSum, DoesNotDependOnOrderOrSplit)
{
  std::vector<double> numbers = Numbers(10000, 40);
  const double sum = SumOf(numbers);
  std::mt19937 random(3);
  for (int i = 0; i < 5; ++i)
  {
    std::shuffle(numbers.begin(), numbers.end(), random);
    EXPECT_EQ(sum, SumOf(numbers));
    ExactSum parts[7];
    for (std::size_t number = 0; number < numbers.size(); ++number)
    {
      parts[number % 7].Add(numbers[number]);
    }
    ExactSum together;
    for (const ExactSum& part : parts)
    {
      together += part;
    }
    EXPECT_EQ(sum, together.Value());
  }
}

TEST(ExactSum, CarriesThroughManyNumbers)
{
  ExactSum sum;
  const double almostTwo = std::nextafter(2.0, 1.0);
  constexpr int count = 1 << 20;
  for (int i = 0; i < count; ++i)
  {
    sum.Add(almostTwo);
  }
  EXPECT_EQ(count * almostTwo, sum.Value());
  for (int i = 0; i < count; ++i)
  {
    sum.Add(-almostTwo);
  }
  EXPECT_EQ(0.0, sum.Value());
}

TEST(ExactSum, TellsWhatIsNotFinite)
{
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(infinite, SumOf({ 1, infinite, -1e300 }));
  EXPECT_TRUE(std::isnan(SumOf({ infinite, -infinite })));
  EXPECT_TRUE(std::isnan(SumOf({ std::nan(""), 1 })));
}
