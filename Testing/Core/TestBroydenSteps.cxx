// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Steps towards a root, on functions whose root is known.

#include "Tolerance.h"

#include "math/BroydenSteps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

using namespace limpid;

namespace
{
using Function = std::function<std::vector<double>(const std::vector<double>&)>;

constexpr BroydenSteps::Limits limits{ -4, 1.6 };

/// Returns the place after some steps from the origin.
std::vector<double> PlaceAfter(int steps, const Function& function)
{
  std::vector<double> place(function({ 0, 0 }).size(), 0.0);
  BroydenSteps broyden(place.size());
  for (int step = 0; step < steps; ++step)
  {
    const std::vector<double> moves = broyden.StepFrom(place, function(place), limits);
    for (std::size_t i = 0; i < place.size(); ++i)
    {
      EXPECT_LE(std::abs(moves[i]), limits.longest);
      place[i] += moves[i];
      EXPECT_GE(place[i], limits.least);
    }
  }
  return place;
}
}

TEST(BroydenSteps, ArriveAtARoot)
{
  const std::vector<double> place = PlaceAfter(12,
    [](const std::vector<double>& x) {
      return std::vector<double>{ 0.8 * x[0] - 0.4 * x[1] - 1, 0.5 * x[1] - 0.2 * x[0] + 0.3 };
    });

  // The root by Cramer's rule. The damping, 0.011 here, leaves 0.095 of the error in the direction
  // of the smaller singular value, whose square is 0.104: three such steps out of twelve would do.
  EXPECT_WITHIN(place[0], 0.38 / 0.32, Relative(1e-3, 1, "damped steps"));
  EXPECT_WITHIN(place[1], -0.04 / 0.32, Relative(1e-3, 1, "damped steps"));
}

TEST(BroydenSteps, AreAsLongNextToAVariableWithoutEffect)
{
  const std::vector<double> place = PlaceAfter(5,
    [](const std::vector<double>& x) {
      return std::vector<double>{ x[0] - 6, 7 };
    });

  // After three steps of 1.6 there are 1.2 to go, of which each damped step leaves 0.02 / 1.02.
  EXPECT_WITHIN(place[0], 6, Relative(0.02 * 0.02, 1.2, "two damped steps"));
  EXPECT_EQ(place[1], limits.least);
}

TEST(BroydenSteps, GoOnWhereAVariableHasNoEffectYet)
{
  const std::vector<double> place = PlaceAfter(4,
    [](const std::vector<double>& x) {
      return std::vector<double>{ x[0] < 4 ? -3.0 : 0.0, 0.0 };
    });

  EXPECT_GT(place[0], 4);
}

TEST(BroydenSteps, GoOnNextToAValueThatStaysHigh)
{
  // The first value stays far above 0 whatever is done; the second one needs its own variable.
  const Function function = [](const std::vector<double>& x)
  {
    return std::vector<double>{ 5 + 0.01 * x[0] - 0.1 * x[1],
      0.05 * std::min(-x[0], 1.0) + 0.4 * x[1] - 0.9 };
  };
  const std::vector<double> values = function(PlaceAfter(8, function));

  EXPECT_GT(values[0], 4);
  EXPECT_NEAR(values[1], 0, 1e-2);
}
