// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_Outcome_h
#define limpid_testing_Outcome_h

#include "BoxScene.h"

#include <vector>

namespace limpid
{
/// All that a run of a solver leaves.
struct Outcome
{
  std::vector<float> extinction;
  std::vector<float> lightExtinction;
  std::vector<float> transmittance;
  std::vector<float> lightTransmittance;
  Score base;
  Score best;
  Energy energy;
  double majorant = 0;
};

inline Outcome Optimize(const BoxScene& scene)
{
  Solver solver = scene.MakeSolver();
  solver.Run();
  Outcome outcome;
  outcome.extinction = solver.Extinction();
  outcome.lightExtinction = solver.LightExtinction();
  outcome.transmittance.resize(scene.extinction.size());
  outcome.lightTransmittance.resize(scene.extinction.size());
  solver.Transmittance(outcome.transmittance.data());
  solver.LightTransmittance(outcome.lightTransmittance.data());
  outcome.base = solver.BaseScore();
  outcome.best = solver.BestScore();
  outcome.energy = solver.BestEnergy();
  outcome.majorant = solver.Majorant();
  return outcome;
}
}

#endif
