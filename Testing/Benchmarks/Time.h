// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How long the default solver takes, with and without leaving out what is not needed.

#ifndef limpid_testing_benchmarks_Time_h
#define limpid_testing_benchmarks_Time_h

#include "Options.h"
#include "Scene.h"

#include <ostream>
#include <string>
#include <vector>

namespace limpid::benchmark
{
/// One default run, or the medians over several [s].
struct RunTimes
{
  double setup = 0; ///< constructor: checks, spans, plans, score and energy of the base
  double first = 0; ///< first iteration
  double ready = 0; ///< the two together
  double later = 0; ///< median over the iterations after the first
  double whole = 0; ///< setup and all iterations
};

struct TimeResult
{
  std::string scene;
  Int3 nodes{ 0 };
  int iterations = 0;
  RunTimes withSkips;
  RunTimes withoutSkips;
  double spread = 0; ///< of `whole` with skips
};

TimeResult MeasureTime(const Scene& scene, const Options& options);
void WriteTime(
  std::ostream& stream, const std::vector<TimeResult>& results, const Options& options);
}

#endif
