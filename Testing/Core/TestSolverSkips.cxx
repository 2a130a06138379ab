// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What provably cannot change the result is left out, and nothing else.

#include "RandomScene.h"
#include "Tolerance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
Solver Optimize(const BoxScene& scene, bool skip)
{
  Settings settings = scene.settings;
  settings.skipUnneeded = skip;
  settings.maximumIterations = 3;
  Solver solver(scene.Fields(), scene.camera, scene.light, settings);
  solver.Run();
  return solver;
}
}

TEST(SolverSkips, ChangeNothingInScenesAtRandom)
{
  for (unsigned seed = 0; seed < 2000; seed += unsigned(OneOf(10)))
  {
    SCOPED_TRACE("scene " + std::to_string(seed));
    const BoxScene scene = MakeRandomScene(seed);

    const Solver skipping = Optimize(scene, true);
    const Solver full = Optimize(scene, false);

    // Every ray adds up the same numbers. What is skipped adds zeros, in front of which sums may
    // have been rounded, and moves the columns that share a register with those at the end of a
    // row.
    const std::string reason = "rounding of other registers";
    const double base = full.BaseScore().visibility;
    const double best = full.BestScore().visibility;
    EXPECT_WITHIN(skipping.BaseScore().visibility, base, Relative(1e-6, base, reason));
    EXPECT_WITHIN(skipping.BestScore().visibility, best, Relative(1e-6, best, reason));
    // A voxel multiplies rounding by the gain, weight by regularisation: 1e4 of 1e-7.
    double largest = 0;
    for (std::size_t node = 0; node < scene.extinction.size(); ++node)
    {
      const float difference = skipping.Extinction()[node] - full.Extinction()[node];
      largest = std::max(largest, std::abs(double(difference)));
    }
    EXPECT_WITHIN(largest, 0, Relative(1e-3, full.Majorant(), reason + " times the gain"));
  }
}
