// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_benchmarks_errors_Runs_h
#define limpid_testing_benchmarks_errors_Runs_h

#include "Measure.h"

namespace limpid::benchmark
{
/// A whole run of a solver, before and after.
struct WholeRun
{
  std::string name;
  std::string group; ///< what it varies
  Settings settings;
  int threads = 0;
  int coarsening = 1; ///< nodes of the grid that is worked on are so many times farther apart

  int iterations = 0;           ///< that were needed
  double seconds = 0;           ///< setup included
  Json history = Json::array(); ///< iteration, level, seconds, S and F as the solver reports them
};

/// One run with the settings, threads and resolution of `run`, which gets its time, iterations and
/// history. Returns the extinction that it ends with at all nodes of the scene [1/length].
std::vector<float> Execute(const SceneForSolver& scene, WholeRun& run);
}

#endif
