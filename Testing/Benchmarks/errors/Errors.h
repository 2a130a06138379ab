// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The parts of limpid_bench errors: time and errors of one setting after the other.

#ifndef limpid_testing_benchmarks_errors_Errors_h
#define limpid_testing_benchmarks_errors_Errors_h

#include "Measure.h"

#include <array>

namespace limpid::benchmark
{
/// How much is measured, by the size of a scene and the user's patience.
struct Effort
{
  double marchRays;             ///< per voxel and axis, of the reference
  double worthRays;             ///< rays per voxel and axis for the energies that runs reach; must
                                ///< differ from those of the sweeps
  int repeats;                  ///< of whole runs
  double secondsPerSetting = 3; ///< no further repeat after [s]
  double warmLimit = 2;         ///< a first run that takes longer counts [s]
  std::vector<double> rayDensities{ 0.25, 0.5, 1, 2, 3 };
  std::vector<int> quadratureSteps{ 1, 2, 4 };
  double quadratureRays; ///< per voxel and axis, enough for their spacing hardly to matter
  double gridSeconds;    ///< for the paper's grids [s]
  std::vector<double> gridSamples{ 0.5, 0.7, 1, 1.4, 2, 2.8, 4, 5.6, 8 }; ///< per voxel and axis

  Effort(const Options& options, double voxels);
};

/// Indices of a node.
inline Int3 NodeAt(const Grid& grid, std::size_t node)
{
  const std::size_t row = node / std::size_t(grid.nodes.x);
  return { static_cast<int>(node % std::size_t(grid.nodes.x)),
    static_cast<int>(row % std::size_t(grid.nodes.y)),
    static_cast<int>(row / std::size_t(grid.nodes.y)) };
}

/// Transmittance at some voxels, of the base extinction and of the optimised one.
using SampledTransmittance = std::array<std::vector<double>, 2>;

/// S, S seen from the light and F of an extinction by the march, as JSON.
Json WorthOf(const SceneOfFile& scene, const std::vector<float>& extinction, const Weights& weights,
  double raysPerVoxel);

class Truth
{
public:
  /// `optimized`: the default run's extinction; stays with the caller.
  Truth(const SceneOfFile& scene, const std::vector<float>& optimized, const Effort& effort);

  const SceneOfFile& Source() const { return this->Origin; }
  const Json& Facts() const { return this->Reference; }

  /// The base extinction (0) or the optimised one (1).
  const std::vector<float>& Extinction(int which) const
  {
    return which == 0 ? this->Origin.extinction : this->Optimized;
  }

  const std::vector<std::size_t>& Voxels() const { return this->Sampled; }

  /// Values of a field at these voxels.
  std::vector<double> AtVoxels(const std::vector<float>& field) const;

  /// Adds relative errors of S, Eq. (32).
  void AddErrors(Json& json, double base, double optimized) const;

  /// Adds root mean squares over voxels, both extinctions together, of errors of T [0, 1].
  void AddErrors(
    Json& json, const SampledTransmittance& view, const SampledTransmittance& light) const;

  /// Relative error of the slopes of S that a gradient of the base extinction gives [1/length per
  /// volume] along three directions: the length of their difference from the march's over the
  /// length of these.
  double SlopeError(const std::vector<float>& gradient) const;

private:
  void SampleVoxels();
  void MarchScores(const Effort& effort);
  void MarchSlopes();

  const SceneOfFile& Origin;
  const std::vector<float>& Optimized;
  Json Reference;
  std::vector<std::size_t> Sampled;
  SampledTransmittance View;
  SampledTransmittance Light;
  std::array<double, 3> Slopes{};
};

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
