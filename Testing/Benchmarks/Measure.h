// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What limpid_bench can measure. Times are seconds, memory is bytes.

#ifndef limpid_testing_benchmarks_Measure_h
#define limpid_testing_benchmarks_Measure_h

#include "Program.h"
#include "SceneForSolver.h"

namespace limpid::benchmark
{
/// Which extinction is found, how fast, in how much memory, and how the paper's scheme fares.
void MeasureSolvers(const Options& options, Json& results, const std::function<void()>& save);

/// How time and memory grow with voxels, how they shrink with threads, and what skipping saves.
void MeasureScaling(const Options& options, Json& results, const std::function<void()>& save);

/// Streams through memory, passes of an iteration, sweeps and rows by Google Benchmark.
void MeasureKernels(const Options& options, Json& results, const std::function<void()>& save);

/// Time and errors of one setting after the other.
Json MeasureErrors(const SceneOfFile& scene, const Options& options);

/// The paper's Fig. 10: resolution of the world against that of the rays. Pictures lie beside the
/// option "output".
Json MeasureResolutions(const SceneOfFile& scene, const Options& options);

/// How long pictures take, stage by stage.
Json MeasureRendering(const SceneOfFile& scene, const Options& options);

/// How long a search for viewpoints takes, and how far its scores are from the truth.
Json MeasureViewpoints(const SceneOfFile& scene, const Options& options);

/// Default runs with and without leaving out what is not needed, in turns: their parts.
Json TimeRuns(const SceneOfFile& scene, int repeats);

void Say(const std::string& text);
}

#endif
