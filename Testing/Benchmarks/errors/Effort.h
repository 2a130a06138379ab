// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_benchmarks_errors_Effort_h
#define limpid_testing_benchmarks_errors_Effort_h

#include "../Options.h"

#include <vector>

namespace limpid::benchmark
{
/// How much is measured, by the size of a scene and the user's patience.
struct Effort
{
  double marchRays = 3;         ///< per voxel and axis, of the reference
  double worthRays = 1.4;       ///< ... of what runs reach; no neighbour of the sweeps' rays
  int repeats = 3;              ///< of whole runs
  double secondsPerSetting = 3; ///< no further repeat after [s]
  double warmLimit = 2;         ///< a first run that takes longer counts [s]
  std::vector<double> rayDensities{ 0.25, 0.5, 1, 2, 3 };
  std::vector<int> quadratureSteps{ 1, 2, 4 };
  double quadratureRays = 2; ///< per voxel and axis, enough for their spacing hardly to matter

  double gridSeconds = 100; ///< for the paper's grids [s]
  std::vector<double> gridSamples{ 0.5, 0.7, 1, 1.4, 2, 2.8, 4, 5.6, 8 }; ///< per voxel and axis

  Effort(const Options& options, double voxels)
    : repeats(options.quick ? 2 : options.repeats)
    , gridSeconds(options.gridSeconds)
  {
    const bool small = voxels < 1e6;
    const bool large = voxels > 4e6;
    this->marchRays = small ? 6 : 3;
    this->quadratureRays = large ? 1 : 2;
    this->worthRays = small ? 3.4 : large ? 1.4 : 1.8;
    this->gridSeconds *= small ? 0.2 : 1.0;
    if (large)
    {
      this->gridSamples = { 0.5, 1, 2, 2.8, 4 };
    }
    if (options.quick)
    {
      this->gridSeconds *= 0.3;
      this->marchRays = small ? 5 : large ? 2 : 2.5;
      this->worthRays = small ? 2.4 : 1.4;
      this->secondsPerSetting = 2;
      this->quadratureSteps = { 1, 2 };
    }
  }
};
}

#endif
