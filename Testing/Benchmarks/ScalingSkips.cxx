// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ScalingSkips.h"

#include "SweepCounts.h"

#include "optimize/PreparedScene.h"

namespace limpid::benchmark
{
namespace
{
/// An iteration with skips on or off.
struct IterationCounts
{
  Index filled = 0;
  SweepCounts camera;
  SweepCounts light;
};

IterationCounts CountIteration(const Scene& scene, bool skip)
{
  Settings settings;
  settings.backend = BackendKind::Cpu;
  settings.skipUnneeded = skip;
  PreparedScene prepared(scene.Fields());
  const Problem problem = prepared.ProblemFor(scene.camera, scene.light, settings);
  return { problem.occupancy->FilledVoxels(), CountSweep(problem, problem.camera),
    CountSweep(problem, problem.light) };
}
}

double SkipResult::SamplesSkipped() const
{
  return SampleCounts{ this->camera.taken + this->light.taken, this->camera.all + this->light.all }
    .Skipped();
}

SkipResult MeasureSkips(const Scene& scene, const Options& options)
{
  const IterationCounts on = CountIteration(scene, true);
  SkipResult result;
  result.scene = scene.file.name;
  result.voxels = double(scene.grid.NodeCount());
  result.filled = double(on.filled);
  result.seenByCamera = CountOf(on.camera.read);
  result.seenByLight = CountOf(on.light.read);
  NodeSet touched = on.camera.read;
  for (const NodeSet* more : { &on.light.read, &on.camera.updated, &on.light.updated })
  {
    Add(*more, touched);
  }
  result.touched = CountOf(touched);
  const IterationCounts off = CountIteration(scene, false);
  result.camera = { on.camera.samples, off.camera.samples };
  result.light = { on.light.samples, off.light.samples };
  result.time = MeasureTime(scene, options);
  return result;
}
}
