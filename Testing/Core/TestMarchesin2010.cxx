// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Tolerance.h"

#include "methods/WeighedMean.h"
#include "render/PackedNumbers.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace limpid;

TEST(WeighedMean, IsTheMeanColourByImportanceOverTheBackground)
{
  WeighedMean<FourFloats> mean;
  mean.Add(1.0f, 0.3f, 1, { 0, 1, 0, 0 });
  mean.Add(0.5f, 0.2f, 0.5f, { 0, 0, 1, 0 });
  mean.Add(0.0f, 5.0f, 1, { 0, 0, 0, 1 });
  const double weights = 1 * 0.3 + 0.5 * 0.2;
  const double opacity = 1 - std::exp(-5.5);

  const FourFloats light = mean.Light();

  EXPECT_WITHIN(light[1], opacity * 0.3 / weights, Roundoff<float>(8, 1.0));
  EXPECT_WITHIN(light[2], opacity * 0.5 * 0.1 / weights, Roundoff<float>(8, 1.0));
  EXPECT_EQ(light[3], 0.0f);
  EXPECT_WITHIN(mean.Transmittance(), std::exp(-5.5), Roundoff<float>(8, 1.0));
}

TEST(WeighedMean, TakesAllSamplesAsEquallyImportantWhereNoneIs)
{
  WeighedMean<FourFloats> mean;
  mean.Add(0, 0.3f, 1, { 0, 1, 0, 0 });
  mean.Add(0, 0.1f, 1, { 0, 0, 1, 0 });

  const FourFloats light = mean.Light();

  EXPECT_WITHIN(light[1], (1 - std::exp(-0.4)) * 0.75, Roundoff<float>(8, 1.0));
  EXPECT_WITHIN(light[2], (1 - std::exp(-0.4)) * 0.25, Roundoff<float>(8, 1.0));
}

TEST(WeighedMean, TakesAnImportanceThatComesOfRoundingForNone)
{
  // The entry of a ray is off by 1e-14 nodes, the importance beside it 1 per node.
  for (const float rounding : { 0.0f, 1e-19f, 1e-14f })
  {
    WeighedMean<FourFloats> mean;
    mean.Add(rounding, 0.3f, 1, { 0, 1, 0, 0 });
    mean.Add(0, 0.1f, 1, { 0, 0, 1, 0 });

    EXPECT_FALSE(mean.HasImportance());
    EXPECT_WITHIN(mean.Light()[1], (1 - std::exp(-0.4)) * 0.75, Roundoff<float>(8, 1.0));
  }
}

TEST(WeighedMean, IsNothingOnAnEmptyRay)
{
  const FourFloats light = WeighedMean<FourFloats>().Light();

  EXPECT_EQ(light[1], 0.0f);
}

TEST(WeighedMean, SharesOpacityEquallyAtEveryDepth)
{
  for (int step = 0; step < 48; ++step) // up to 1e5
  {
    const double depth = 1e-6 * std::pow(1.7, step);
    EXPECT_WITHIN(EqualTransmittance(static_cast<float>(depth)),
      -std::expm1(-double(float(depth))) / double(float(depth)), Roundoff<float>(8, 1.0));
  }
}
