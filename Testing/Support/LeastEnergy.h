// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_test_LeastEnergy_h
#define limpid_test_LeastEnergy_h

#include "backend/HostDevice.h"
#include "optimize/ExtinctionBounds.h"
#include "optimize/PreparedScene.h"
#include "optimize/SolverBackend.h"

#include <memory>

namespace limpid
{
/// Returns a lower bound of the energy of Eq. (21) over all extinctions within the bounds: F >= -q
/// W - r W_L with the ceilings W of the camera and W_L of the light, as the other terms are not
/// negative [length^2].
inline double LeastEnergyOf(
  const SceneFields& scene, const Camera& camera, const Light& light, const Settings& settings)
{
  PreparedScene prepared(scene);
  const Problem problem = prepared.ProblemFor(camera, light, settings);
  const std::unique_ptr<SolverBackend> backend = MakeSolverBackend(HostDevice::Shared());
  const NodeValues least = prepared.LeastExtinction(settings);
  const auto ceilingOf = [&](const std::unique_ptr<SourceSweeps>& sweeps)
  { return sweeps->CeilingOf(least.Data(), MostOf(problem)).visibility; };

  const Weights& weights = settings.weights;
  double bound = -weights.view * ceilingOf(backend->SweepsFromCameras(problem));
  if (weights.light > 0)
  {
    bound -= weights.light * ceilingOf(backend->SweepsFrom(problem, problem.Light()));
  }
  return bound;
}
}

#endif
