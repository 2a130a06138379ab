// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How exact Limpid's sweeps are, and how long an iteration of them takes.

#ifndef limpid_testing_benchmarks_errors_Sweeps_h
#define limpid_testing_benchmarks_errors_Sweeps_h

#include "Effort.h"
#include "Results.h"
#include "Truth.h"

#include <vector>

namespace limpid::benchmark
{
/// What an iteration knows, at some numbers of rays: S, T at voxels and the derivative.
std::vector<SweepAccuracy> MeasureSweeps(const Truth& truth, const Effort& effort);

/// The transmittance of nodes for pictures.
std::vector<ShadowAccuracy> MeasureShadows(const Truth& truth, const Effort& effort);

/// Iterations of both solvers at full resolution, in turns.
std::vector<IterationTime> TimeIterations(const Scene& scene, const Effort& effort);
}

#endif
