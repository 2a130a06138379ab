// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/SceneCeiling.h"

#include "optimize/ExtinctionBounds.h"
#include "optimize/ProblemInFront.h"

namespace limpid
{
Ceiling CeilingOfScores(PreparedScene& scene, const ChosenBackend& backend, const Camera& camera,
  const Light& light, const Settings& settings, const OpaqueGeometry* opaque)
{
  const Problem scored = scene.ProblemForScores(camera, light, settings);
  const ProblemInFront seen(scored, scene.ArrayGrid(), opaque);
  const NodeValues least = scene.LeastExtinction(settings);
  const MostExtinction<float> most = MostOf(scored);
  Ceiling ceiling = backend->SweepsFromCameras(seen.Get())->CeilingOf(least.Data(), most);
  if (scored.settings.weights.light > 0)
  {
    ceiling.lightVisibility =
      backend->SweepsFrom(scored, scored.Light())->CeilingOf(least.Data(), most).visibility;
  }
  return ceiling;
}
}
