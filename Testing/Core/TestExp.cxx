// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The exponentials of the sweeps against double precision, over all orders of magnitude.

#include "math/Exp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

using namespace limpid;

namespace
{
/// Calls body(depth) for depths from 1e-37 to 86.9, some 60 000 of them.
template <class Body>
void ForDepths(const Body& body)
{
  constexpr std::uint32_t first = 0x02000000; // 1e-37
  constexpr std::uint32_t step = 17011;       // odd, for the sake of all mantissas
  for (std::uint32_t bits = first;; bits += step)
  {
    float depth;
    std::memcpy(&depth, &bits, sizeof(depth));
    if (!(depth < 86.9f))
    {
      return;
    }
    body(depth);
  }
}

/// The last place of a float.
double LastPlace(double value)
{
  int exponent = 0;
  std::frexp(value, &exponent);
  return std::ldexp(1.0, exponent - 24);
}
}

TEST(Exp, AttenuatesToTwoUnitsInTheLastPlace)
{
  ForDepths(
    [](float depth)
    {
      const double truth = std::exp(-double(depth));
      EXPECT_NEAR(Attenuate(depth), truth, 2 * LastPlace(truth)) << depth;
    });
}

TEST(Exp, StopsToTwoUnitsInTheLastPlaceHoweverLittle)
{
  ForDepths(
    [](float depth)
    {
      const double truth = -std::expm1(-double(depth));
      EXPECT_NEAR(Stop(depth), truth, 2 * LastPlace(truth)) << depth;
    });
}

TEST(Exp, EndsInNumbersWithoutRounding)
{
  EXPECT_EQ(Attenuate(0.0f), 1.0f);
  EXPECT_EQ(Stop(0.0f), 0.0f);
  for (const float depth : { 87.0f, 1e30f, std::numeric_limits<float>::infinity() })
  {
    EXPECT_EQ(Attenuate(depth), 0.0f);
    EXPECT_EQ(Stop(depth), 1.0f);
  }
}
