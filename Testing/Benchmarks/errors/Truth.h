// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The converged values that errors of a scene are against, by the march of Testing/Reference.

#ifndef limpid_testing_benchmarks_errors_Truth_h
#define limpid_testing_benchmarks_errors_Truth_h

#include "Measure.h"

#include <array>

namespace limpid::benchmark
{
/// How much is measured, by the size of a scene and the user's patience.
struct Effort
{
  double marchRays;             ///< per voxel and axis, of the reference
  double worthRays;             ///< ... of what runs reach; no neighbour of the sweeps' rays
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
}

#endif
