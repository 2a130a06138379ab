// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_SceneCeiling_h
#define limpid_optimize_SceneCeiling_h

#include "optimize/PreparedScene.h"
#include "optimize/SolverBackend.h"
#include "scene/OpaqueGeometry.h"

namespace limpid
{
/// What no extinction within the bounds of the settings can exceed: one sweep for each camera and,
/// if it has a weight, one for the light. The importance that counts is the one as given, as in
/// scores; that of the lower bound is the optimiser's. Ranks that share the scene call this
/// together. `opaque`: where the rays of the camera end; null: nowhere.
Ceiling CeilingOfScores(PreparedScene& scene, const ChosenBackend& backend, const Camera& camera,
  const Light& light, const Settings& settings, const OpaqueGeometry* opaque = nullptr);

/// What the energy of Eq. (21) of no extinction within the bounds is below: F >= -q W - r W_L with
/// the ceilings W of the camera and W_L of the light, as the other terms are not negative
/// [length^2].
double LeastEnergyOf(PreparedScene& scene, const ChosenBackend& backend, const Camera& camera,
  const Light& light, const Settings& settings);
}

#endif
