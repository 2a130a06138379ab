// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The parts of limpid_bench errors: time and errors of one setting after the other.

#ifndef limpid_testing_benchmarks_errors_Errors_h
#define limpid_testing_benchmarks_errors_Errors_h

#include "Measure.h"
#include "Truth.h"

namespace limpid::benchmark
{
/// What an iteration knows, at some numbers of rays: S, T at voxels and the derivative.
Json MeasureSweeps(const Truth& truth, const Effort& effort);

/// The transmittance of nodes for pictures.
Json MeasureShadows(const Truth& truth, const Effort& effort);

/// Iterations of both solvers at full resolution, in turns.
Json TimeIterations(const SceneOfFile& scene, const Effort& effort);

/// S by a simple scorer that marches every ray with one of four rules of quadrature.
Json MeasureQuadratures(const Truth& truth, const Effort& effort);

/// The paper's perspective grids, from coarse ones to the finest that fit into the memory and the
/// time that the options allow.
Json MeasureGrids(const Truth& truth, const Effort& effort, const Options& options);

/// Whole runs with all settings that are compared, first the default: once for memory and worth,
/// then again in turns for time.
Json MeasureRuns(const Truth& truth, const Effort& effort, const Options& options);
}

#endif
