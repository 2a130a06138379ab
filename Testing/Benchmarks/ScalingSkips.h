// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How much of a scene an iteration leaves out because it provably does not matter, and the time
// that this saves.

#ifndef limpid_testing_benchmarks_ScalingSkips_h
#define limpid_testing_benchmarks_ScalingSkips_h

#include "Options.h"
#include "Scene.h"
#include "Time.h"

#include <string>

namespace limpid::benchmark
{
/// Rays times layers of the sweeps from an eye.
struct SampleCounts
{
  double taken = 0;
  double all = 0; ///< without skips

  double Skipped() const { return this->all > 0 ? 1 - this->taken / this->all : 0; }
};

struct SkipResult
{
  std::string scene;
  double voxels = 0;
  double filled = 0;       ///< nodes with extinction or importance
  double seenByCamera = 0; ///< nodes that rays of the camera read
  double seenByLight = 0;
  double touched = 0; ///< nodes that rays of either read or that an iteration may change
  SampleCounts camera;
  SampleCounts light;
  TimeResult time; ///< of runs with skips on and off in turns

  double VoxelsSkipped() const { return 1 - this->touched / this->voxels; }
  double SamplesSkipped() const;
};

SkipResult MeasureSkips(const Scene& scene, const Options& options);
}

#endif
