// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SweepCounts.h"
#include "Volume.h"

#include "optimize/PreparedScene.h"

#include <gtest/gtest.h>

namespace
{
using namespace limpid;
using namespace limpid::benchmark;

/// A dense volume with its sweeps, of which `skip` tells whether they leave out what they can.
struct Counted
{
  explicit Counted(bool skip)
    : volume(MakeVolume("dense", 24))
    , prepared(volume.Fields())
    , problem(prepared.ProblemFor(volume.camera, volume.light, SettingsWith(skip)))
    , camera(CountSweep(problem, problem.Camera()))
  {
  }

  static Settings SettingsWith(bool skip)
  {
    Settings settings;
    settings.backend = BackendKind::Cpu;
    settings.skipUnneeded = skip;
    return settings;
  }

  SceneForSolver volume;
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
}
