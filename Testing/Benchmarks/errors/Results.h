// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What limpid_bench_error measures: time and errors of every setting, scene by scene. Errors are
// against the march of Testing/Reference unless said otherwise.

#ifndef limpid_testing_benchmarks_errors_Results_h
#define limpid_testing_benchmarks_errors_Results_h

#include "optimize/Settings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace limpid::benchmark
{
/// Relative errors of S, Eq. (32), of two extinctions: the base and what the default run makes of
/// it.
struct ScoreErrors
{
  double base = 0;
  double optimized = 0;

  double Largest() const { return std::max(std::abs(this->base), std::abs(this->optimized)); }
};

/// Root mean squares over voxels, base and optimised extinction together, of errors of T [0, 1].
struct TransmittanceErrors
{
  double view = 0;
  double light = 0;
};

/// The sweeps of an iteration.
struct SweepAccuracy
{
  double rayDensity = 1;
  ScoreErrors score;
  TransmittanceErrors transmittance;
  double slope = 0;    ///< relative, of directional derivatives of S with Derivative::Volume
  double raySlope = 0; ///< ... with Derivative::Ray
};

/// The transmittance of nodes that pictures and the filter's arrays are made of.
struct ShadowAccuracy
{
  double rayDensity = 3;
  TransmittanceErrors transmittance;
  double seconds = 0; ///< of one sweep, mean of camera and light
};

/// Iterations at full resolution, camera and light.
struct IterationTime
{
  SolverKind solver = SolverKind::Policy;
  double rayDensity = 1;
  bool skip = true;
  int threads = 0;
  double seconds = 0; ///< median, without the first iteration
  int timed = 0;      ///< how many it is the median of
};

/// The paper's perspective grids at one resolution.
struct GridResult
{
  double samplesPerVoxel = 0;
  double cells = 0; ///< of camera and light together
  ScoreErrors score;
  TransmittanceErrors transmittance;
  double slope = 0;
  double seconds = 0; ///< of an Adam iteration, median
  int timed = 0;
  double bytes = 0; ///< peak beyond the input
};

/// S by a simple scorer that marches every ray with a rule of quadrature.
struct QuadratureResult
{
  std::string rule;
  int steps = 1; ///< per layer between slices
  ScoreErrors score;
  double seconds = 0;
};

struct HistoryPoint
{
  int iteration = 0;
  int level = 0;
  double seconds = 0; ///< since the start, setup included
  double score = 0;   ///< S as the solver reports it [length^2]
  double energy = 0;  ///< F as the solver reports it
};

/// What an extinction is worth by the march.
struct Worth
{
  double score = 0;      ///< S [length^2]
  double lightScore = 0; ///< the same integral seen from the light [length^2]
  double energy = 0;     ///< F of Eq. (21), world units
};

/// A whole run of a solver.
struct WholeRun
{
  std::string name;
  std::string group; ///< what it varies
  Settings settings;
  int threads = 0;
  int coarsening = 1; ///< nodes of the grid that is worked on are so many times farther apart
  int iterations = 0; ///< that were needed
  double seconds = 0; ///< median, setup included
  double spread = 0;  ///< of seconds
  int repeats = 0;
  double bytes = 0; ///< peak beyond the input
  Worth worth;
  std::vector<HistoryPoint> history;
};

struct ReferenceFacts
{
  double raysPerVoxel = 0;      ///< of S
  double worthRaysPerVoxel = 0; ///< of what runs reach
  double base = 0;              ///< S of the base extinction [length^2]
  double optimized = 0;         ///< ... of the default run's
  double uncertainty = 0;       ///< relative: S with two thirds of the rays is so far off
  double seconds = 0;           ///< that it took
  std::size_t voxels = 0;       ///< at which transmittances are compared
};

/// Whether the default is where no other setting is both faster and better.
struct FrontFacts
{
  std::string measure; ///< what is plotted against time
  std::string among;   ///< which settings
  double seconds = 0;  ///< of the default
  double error = 0;    ///< of the default
  std::string rival; ///< the fastest setting that is at least as good; the default itself: none is
  double factor = 1; ///< seconds of the default over those of the rival
  std::vector<std::string> front; ///< names on the front, fastest first
};

/// The paper's grids against the cheapest setting with no larger error of S.
struct EqualError
{
  double samplesPerVoxel = 0; ///< 0: between two measured resolutions
  double error = 0;           ///< of the grids
  double gridSeconds = 0;     ///< Adam iteration on them
  double adamDensity = 0;     ///< rays of the cheapest Adam iteration
  double adamSeconds = 0;
  double policyDensity = 0;
  double policySeconds = 0;
};

struct SceneResult
{
  std::string name;
  std::array<int, 3> nodes{};
  double voxels = 0;
  double seconds = 0; ///< that measuring it took
  ReferenceFacts reference;
  std::vector<SweepAccuracy> sweeps;
  std::vector<ShadowAccuracy> shadows;
  std::vector<IterationTime> iterations;
  std::vector<GridResult> grids;
  std::vector<QuadratureResult> quadratures;
  std::vector<WholeRun> runs; ///< first the default
  std::vector<FrontFacts> fronts;
  std::vector<EqualError> equal;
};
}

#endif
