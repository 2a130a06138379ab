// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Fronts.h"

#include "Tolerance.h"

#include <gtest/gtest.h>

namespace limpid::benchmark
{
namespace
{
TEST(Fronts, HoldWhatNothingIsFasterAndBetterThan)
{
  const std::vector<TimedError> settings{ { "slow", 8, 1 }, { "fast", 1, 8 }, { "middle", 4, 4 },
    { "beaten", 5, 4 }, { "worst", 9, 9 } };

  const std::vector<std::string> expected{ "fast", "middle", "slow" };
  EXPECT_EQ(FrontOf(settings), expected);
}

TEST(Fronts, HaveTheFirstSettingIfNothingIsBetterInBoth)
{
  const FrontFacts facts = PlaceOfFirst({ { "first", 4, 4 }, { "fast", 1, 5 }, { "good", 5, 1 } });

  EXPECT_EQ(facts.factor, 1);
  EXPECT_EQ(facts.rival, "");
}

TEST(Fronts, AreAsFarAwayAsTheRivalIsBetterInBoth)
{
  const FrontFacts facts =
    PlaceOfFirst({ { "first", 4, 4 }, { "a little", 3.5, 1 }, { "more", 2, 1 } });

  EXPECT_EQ(facts.factor, 2); // twice as fast, and four times as good
  EXPECT_EQ(facts.rival, "more");
}

/// Grids of two resolutions with an error of S that is the time's inverse, and sweeps of two.
SceneResult GridsAndSweeps()
{
  SceneResult scene;
  for (const double seconds : { 4.0, 16.0 })
  {
    GridResult grid;
    grid.samplesPerVoxel = seconds;
    grid.score.base = 1 / seconds;
    grid.seconds = seconds;
    scene.grids.push_back(grid);
  }
  for (const double rayDensity : { 1.0, 2.0 })
  {
    SweepAccuracy sweep;
    sweep.rayDensity = rayDensity;
    sweep.score.base = rayDensity == 1 ? 0.15 : 0.01;
    scene.sweeps.push_back(sweep);
    scene.iterations.push_back({ SolverKind::Adam, rayDensity, true, 2, 0.1 * rayDensity, 1 });
  }
  return scene;
}

TEST(EqualErrors, TakeTheCheapestIterationThatIsAtLeastAsExact)
{
  const std::vector<EqualError> equal = EqualErrorsOf(GridsAndSweeps());

  EXPECT_EQ(equal[0].error, 0.25);
  EXPECT_EQ(equal[0].adamDensity, 1);
  EXPECT_EQ(equal[1].error, 1.0 / 16);
  EXPECT_EQ(equal[1].adamDensity, 2);
  EXPECT_EQ(equal[1].policySeconds, 0); // not measured
}

TEST(EqualErrors, AreStraightInTheLogarithmsBetweenTwoGrids)
{
  const std::vector<EqualError> equal = EqualErrorsOf(GridsAndSweeps());

  ASSERT_EQ(equal.size(), 4u); // two grids, and 20 % and 10 % between them
  EXPECT_EQ(equal[2].error, 0.2);
  // Two quotients, two logarithms and a power.
  EXPECT_WITHIN(equal[2].gridSeconds, 5, Roundoff<double>(10, 5));
  EXPECT_WITHIN(equal[3].gridSeconds, 10, Roundoff<double>(10, 10));
}
}
}
