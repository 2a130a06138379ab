// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/SceneCeiling.h"

#include "optimize/ExtinctionBounds.h"
#include "optimize/ProblemInFront.h"

namespace limpid
{
namespace
{
/// Returns the ceiling for the cameras of `seen` and the light of `lit` within the bounds of
/// `bounded`.
Ceiling CeilingOf(
  const Problem& seen, const Problem& lit, const Problem& bounded, const ChosenBackend& backend)
{
  const NodeValues least = bounded.LeastExtinction();
  const MostExtinction<float> most = MostOf(bounded);
  Ceiling ceiling = backend->SweepsFromCameras(seen)->CeilingOf(least.Data(), most);
  if (lit.settings.weights.light > 0)
  {
    ceiling.lightVisibility =
      backend->SweepsFrom(lit, lit.light)->CeilingOf(least.Data(), most).visibility;
  }
  return ceiling;
}
}

Ceiling CeilingOfScores(PreparedScene& scene, const ChosenBackend& backend, const Camera& camera,
  const Light& light, const Settings& settings, const OpaqueGeometry* opaque)
{
  const Problem bounded = scene.ProblemFor(camera, light, settings);
  const Problem scored = scene.ProblemForScores(camera, light, settings);
  return CeilingOf(ProblemInFront(scored, opaque).Get(), scored, bounded, backend);
}

double LeastEnergyOf(PreparedScene& scene, const ChosenBackend& backend, const Camera& camera,
  const Light& light, const Settings& settings)
{
  const Problem problem = scene.ProblemFor(camera, light, settings);
  const Ceiling ceiling = CeilingOf(problem, problem, problem, backend);
  const Weights& weights = settings.weights;
  return -weights.view * ceiling.visibility - weights.light * ceiling.lightVisibility;
}
}
