// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Which settings are worth their time, and what the same error costs on the paper's grids.

#ifndef limpid_testing_benchmarks_errors_Fronts_h
#define limpid_testing_benchmarks_errors_Fronts_h

#include "Results.h"

#include <string>
#include <vector>

namespace limpid::benchmark
{
/// A setting in a plot of error against time.
struct TimedError
{
  std::string name;
  double seconds = 0;
  double error = 0;
};

/// Names of the settings that no other is faster than and at least as good, fastest first.
std::vector<std::string> FrontOf(const std::vector<TimedError>& settings);

/// Where the first setting lies. With time and error divided by `factor` it would be on the front.
FrontFacts PlaceOfFirst(const std::vector<TimedError>& settings);

/// An iteration's time at a number of rays, with skips and all threads; 0 if not measured.
double SecondsOf(const SceneResult& scene, SolverKind solver, double rayDensity);

/// What runs reach is as good as the best if it is so near to it: the march is no more exact.
constexpr double bestEnough = 1e-5;

/// How far a run stays behind the best of all runs: in F, or in S alone [share of the best].
double ShortOfBestEnergy(const SceneResult& scene, const WholeRun& run);
double ShortOfBestScore(const SceneResult& scene, const WholeRun& run);

/// The default's place by error of S, T and slopes (time of an iteration) and by what is reached
/// (time of a whole run).
std::vector<FrontFacts> FrontsOf(const SceneResult& scene);

/// At every resolution of the paper's grids, and at round errors between them.
std::vector<EqualError> EqualErrorsOf(const SceneResult& scene);
}

#endif
