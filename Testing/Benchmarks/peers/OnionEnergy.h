// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_benchmarks_peers_OnionEnergy_h
#define limpid_testing_benchmarks_peers_OnionEnergy_h

#include "BoxScene.h"

#include "optimize/Terms.h"

#include <map>
#include <string>
#include <vector>

namespace limpid::benchmark
{
/// The terms of Eq. (21) with their weights, and the time that they took.
struct Evaluation
{
  Energy energy;      ///< [length^2]
  double seconds = 0; ///< wall time
};

/// The energy of Eq. (21) and its derivative at one extinction of the onion scene
/// (BoxScene::FillOnion): 0.8 times the base extinction, so that no term is zero.
class OnionEnergy
{
public:
  /// `nodes` along each axis.
  OnionEnergy(int nodes, const Settings& settings);

  /// Makes what does not depend on the extinction: rays, spans, importance of nodes. Returns the
  /// seconds that it took. Comes before all that follow, except the reference's.
  double Plan();

  Evaluation Value();
  Evaluation ValueAndGradient();

  /// Derivatives of F, by the gradient, along directions that are shares of the base extinction: of
  /// what is important, of what is not, and a wave through all of it [length^2].
  std::map<std::string, double> Slopes() const;

  /// The energy by the reference: double precision, no code of the core.
  Evaluation March(double raysPerVoxel) const;

  /// Central differences of the reference's energy along the same directions [length^2].
  std::map<std::string, double> Differences(double raysPerVoxel) const;

  /// Writes base extinction, importance and gradient, one after the other: float32, first axis
  /// fastest.
  void Save(const std::string& path) const;

private:
  void RequirePlan() const;
  Energy Truth(const std::vector<double>& extinction, double raysPerVoxel) const;
  std::map<std::string, std::vector<double>> Directions() const;

  BoxScene Scene;
  std::vector<float> Extinction; ///< where the energy is asked for [1/length]
  std::vector<float> NodeImportance;
  std::vector<float> Gradient; ///< of F at the nodes, per volume [1]
  Problem Task;
  Terms Both;
};
}

#endif
