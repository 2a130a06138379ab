// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Policy against Adam: how good the results are, and whether the reported scores are true.

#ifndef limpid_testing_benchmarks_Quality_h
#define limpid_testing_benchmarks_Quality_h

#include "Options.h"
#include "Scene.h"

#include <ostream>
#include <string>
#include <vector>

namespace limpid::benchmark
{
/// A score as the solver reports it beside that of the independent march.
struct CheckedScore
{
  double reported = 0; ///< [length^2]
  double march = 0;    ///< [length^2]
};

/// One run of a solver to its end.
struct RunResult
{
  CheckedScore score;
  double energy = 0;   ///< F, world units
  double fraction = 0; ///< visible fraction as reported [0, 1]
  int iterations = 0;
  double seconds = 0;
  IterationRecord first; ///< after one iteration
};

struct QualityResult
{
  std::string scene;
  CheckedScore base;
  double baseFraction = 0; ///< as reported [0, 1]
  RunResult policy;
  RunResult adam;
};

QualityResult MeasureQuality(const Scene& scene, const Options& options);
void WriteQuality(
  std::ostream& stream, const std::vector<QualityResult>& results, const Options& options);
}

#endif
