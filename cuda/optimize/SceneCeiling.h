// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_SceneCeiling_h
#define limpid_optimize_SceneCeiling_h

#include "optimize/PreparedScene.h"
#include "optimize/SolverBackend.h"
#include "scene/OpaqueGeometry.h"

namespace limpid
{
/// Returns an upper bound of the scores of all extinctions within the bounds of the settings.
/// Costs one sweep per camera and, if the light has a weight, one for the light. As for scores,
/// the importance as given counts; the lower bound uses the optimiser's importance. Collective in
/// distributed runs. `opaque`: geometry that ends the rays of the camera; null if there is none.
Ceiling CeilingOfScores(PreparedScene& scene, const ChosenBackend& backend, const Camera& camera,
  const Light& light, const Settings& settings, const OpaqueGeometry* opaque = nullptr);
}

#endif
