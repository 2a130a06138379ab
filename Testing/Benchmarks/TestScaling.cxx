// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ScalingTimes.h"
#include "SweepCounts.h"
#include "Tolerance.h"

#include "optimize/PreparedScene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace limpid;
using namespace limpid::benchmark;

/// A dense volume with its sweeps, of which `skip` tells whether they leave out what they can.
struct Counted
{
  explicit Counted(bool skip)
    : volume(Filling::Dense, 24)
    , prepared(volume.Fields())
    , problem(prepared.ProblemFor(volume.camera, volume.light, SettingsWith(skip)))
    , camera(CountSweep(problem, problem.camera))
  {
  }

  static Settings SettingsWith(bool skip)
  {
    Settings settings;
    settings.backend = BackendKind::Cpu;
    settings.skipUnneeded = skip;
    return settings;
  }

  GpuScene volume;
  PreparedScene prepared;
  Problem problem;
  SweepCounts camera;
};

TEST(SweepCounts, HaveEveryNodeWhereNothingIsSkipped)
{
  const Counted all(false);

  EXPECT_EQ(CountOf(all.camera.read), double(all.volume.grid.NodeCount()));
  EXPECT_EQ(CountOf(all.camera.updated), double(all.volume.grid.NodeCount()));
}

TEST(SweepCounts, HaveWhateverIsImportantAndNotAll)
{
  const Counted some(true);
  const Counted all(false);

  EXPECT_LT(some.camera.samples, all.camera.samples);
  EXPECT_LT(CountOf(some.camera.read), CountOf(all.camera.read));
  for (std::size_t node = 0; node < some.camera.read.size(); ++node)
  {
    if (some.volume.importance[node] > 0)
    {
      EXPECT_EQ(some.camera.read[node], 1) << "node " << node;
      EXPECT_EQ(some.camera.updated[node], 1) << "node " << node;
    }
  }
}

TEST(SweepCounts, SayThatHazeIsFilled)
{
  const Counted some(true);

  EXPECT_EQ(some.problem.occupancy->FilledVoxels(), some.volume.grid.NodeCount());
}

// The logarithms of a power lie on a straight line, which least squares finds but for rounding: of
// the exponent, and of the logarithms, whose range of 6.2 it is divided by.
TEST(Exponents, AreThoseOfAPower)
{
  std::vector<SizeResult> sizes;
  for (const int side : { 32, 64, 128, 512 })
  {
    SizeResult size{ "power", side, {} };
    const double voxels = std::pow(double(side), 3);
    size.times.seconds[Step::Iteration] = side < 64 ? 1.0 : 3e-9 * std::pow(voxels, 1.25);
    sizes.push_back(size);
  }

  const Exponents fit = FitExponents("power", sizes);

  EXPECT_EQ(fit.smallest, 64);
  EXPECT_EQ(fit.largest, 512);
  EXPECT_WITHIN(
    fit.values[Step::Iteration], 1.25, Roundoff<double>(4, 1.25) + Roundoff<double>(12, 20 / 6.2));
  EXPECT_EQ(fit.values[Step::Adam], 0);
}
}
