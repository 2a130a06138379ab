// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The converged values that errors of a scene are against, by the march of Testing/Reference.

#ifndef limpid_testing_benchmarks_errors_Truth_h
#define limpid_testing_benchmarks_errors_Truth_h

#include "../Scene.h"
#include "Effort.h"
#include "Results.h"

#include <array>
#include <cstddef>
#include <vector>

namespace limpid::benchmark
{
/// Directions in which S is differentiated: the extinction of what is important, of what is not,
/// and all of it with a wave through the box.
constexpr int directionCount = 3;

/// One of them: the change of the base extinction per unit, one value per node [1/length].
std::vector<float> Direction(const Scene& scene, int which);

/// The sum over nodes of gradient times direction times the node's share of the volume.
double AlongDirection(
  const Scene& scene, const std::vector<float>& gradient, const std::vector<float>& direction);

/// By the march.
Worth WorthOf(const Scene& scene, const std::vector<float>& extinction, const Weights& weights,
  double raysPerVoxel);

/// Transmittance at some voxels, of the base extinction and of the optimised one.
using SampledTransmittance = std::array<std::vector<double>, 2>;

/// Root mean square of the difference.
double RmsDifference(const SampledTransmittance& one, const SampledTransmittance& other);

class Truth
{
public:
  /// `optimized`: the default run's extinction; stays with the caller.
  Truth(const Scene& scene, const std::vector<float>& optimized, const Effort& effort);

  const Scene& Source() const { return this->Origin; }
  const ReferenceFacts& Facts() const { return this->Reference; }

  /// The base extinction (0) or the optimised one (1).
  const std::vector<float>& Extinction(int which) const
  {
    return which == 0 ? this->Origin.file.extinction : this->Optimized;
  }

  const std::vector<std::size_t>& Voxels() const { return this->Sampled; }

  ScoreErrors ErrorsOf(double base, double optimized) const
  {
    return { base / this->Reference.base - 1, optimized / this->Reference.optimized - 1 };
  }

  TransmittanceErrors ErrorsOf(
    const SampledTransmittance& view, const SampledTransmittance& light) const
  {
    return { RmsDifference(view, this->View), RmsDifference(light, this->Light) };
  }

  /// Relative error of slopes along all directions: the length of their difference from the march's
  /// over the length of these.
  double ErrorOf(const std::array<double, directionCount>& slopes) const;

private:
  void SampleVoxels();
  void MarchScores(const Effort& effort);
  void MarchSlopes();

  const Scene& Origin;
  const std::vector<float>& Optimized;
  ReferenceFacts Reference;
  std::vector<std::size_t> Sampled;
  SampledTransmittance View;
  SampledTransmittance Light;
  std::array<double, directionCount> Slopes{};
};
}

#endif
