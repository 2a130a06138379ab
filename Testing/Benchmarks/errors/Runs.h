// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Whole runs of the solvers with one setting or another: time, memory, what they reach.

#ifndef limpid_testing_benchmarks_errors_Runs_h
#define limpid_testing_benchmarks_errors_Runs_h

#include "../Scene.h"
#include "Effort.h"
#include "Results.h"

#include <vector>

namespace limpid::benchmark
{
class Truth;

/// One run with the settings, threads and resolution of `run`, which gets its time, iterations and
/// history. Returns the extinction that it ends with at all nodes of the scene [1/length].
std::vector<float> Execute(const Scene& scene, WholeRun& run);

/// The extinction that the default run ends with [1/length].
std::vector<float> DefaultResult(const Scene& scene);

/// Runs all settings that are compared, first the default: once for memory and worth, then again in
/// turns for time.
std::vector<WholeRun> MeasureRuns(const Truth& truth, const Options& options, const Effort& effort);
}

#endif
