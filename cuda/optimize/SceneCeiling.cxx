// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/SceneCeiling.h"

#include "optimize/ExtinctionBounds.h"

namespace limpid
{
namespace
{
/// Returns the ceiling for the sources of `seen` within the bounds of `bounded`.
Ceiling CeilingOf(const Problem& seen, const Problem& bounded, const ChosenBackend& backend)
{
  const NodeValues least = bounded.LeastExtinction();
  const MostExtinction<float> most = MostOf(bounded);
  Ceiling ceiling = backend->SweepsFromCameras(seen)->CeilingOf(least.Data(), most);
  if (seen.settings.weights.light > 0)
  {
    ceiling.lightVisibility =
      backend->SweepsFrom(seen, seen.light)->CeilingOf(least.Data(), most).visibility;
  }
  return ceiling;
}
}

Ceiling CeilingOfScores(PreparedScene& scene, const ChosenBackend& backend, const Camera& camera,
  const Light& light, const Settings& settings)
{
  const Problem bounded = scene.ProblemFor(camera, light, settings);
  return CeilingOf(scene.ProblemForScores(camera, light, settings), bounded, backend);
}

double LeastEnergyOf(PreparedScene& scene, const ChosenBackend& backend, const Camera& camera,
  const Light& light, const Settings& settings)
{
  const Problem problem = scene.ProblemFor(camera, light, settings);
  const Ceiling ceiling = CeilingOf(problem, problem, backend);
  const Weights& weights = settings.weights;
  return -weights.view * ceiling.visibility - weights.light * ceiling.lightVisibility;
}
}
