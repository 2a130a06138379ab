// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What is taken for important of an array when nobody has said it.

#include "scene/StartingImportance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace
{
using limpid::ImportanceRamp;
using limpid::RampOf;

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

TEST(StartingImportance, IsNotKnownWhereNothingStandsOut)
{
  EXPECT_FALSE(RampOf({}, {}).IsKnown());
  EXPECT_FALSE(RampOf(Mask(10, 0), { { 0, 0 } }).IsKnown());
}
