// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "math/BroydenSteps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace limpid
{
namespace
{
constexpr BroydenSteps::Limits limits{ -4.6, 1.6 };

/// Returns the values of a function after so many steps from 0.
std::vector<double> ValuesAfter(int steps, std::size_t variables,
  const std::function<std::vector<double>(const std::vector<double>&)>& function)
{
  BroydenSteps broyden(variables);
  std::vector<double> place(variables, 0.0);
  for (int n = 0; n < steps; ++n)
  {
    const std::vector<double> step = broyden.StepFrom(place, function(place), limits);
    for (std::size_t i = 0; i < variables; ++i)
    {
      EXPECT_LE(std::abs(step[i]), limits.longest);
      place[i] += step[i];
      EXPECT_GE(place[i], limits.least);
    }
  }
  return function(place);
}
}

TEST(BroydenSteps, FindTheRootOfLinearFunctions)
{
  // What one variable gains another one loses.
  const auto values = ValuesAfter(8, 2,
    [](const std::vector<double>& x) -> std::vector<double> {
      return { 0.8 * x[0] - 0.3 * x[1] - 0.5, -0.2 * x[0] + 0.6 * x[1] - 0.4 };
    });
  EXPECT_NEAR(values[0], 0, 1e-3);
  EXPECT_NEAR(values[1], 0, 1e-3);
}

TEST(BroydenSteps, GoOnWhereAVariableHasNoEffect)
{
  // The first value stays far above 0 whatever is done; the second one needs its own variable.
  const auto values = ValuesAfter(8, 2,
    [](const std::vector<double>& x) -> std::vector<double> {
      return { 5 + 0.01 * x[0] - 0.1 * x[1], 0.05 * std::min(-x[0], 1.0) + 0.4 * x[1] - 0.9 };
    });
  EXPECT_GT(values[0], 4);
  EXPECT_NEAR(values[1], 0, 1e-2);
}
}
