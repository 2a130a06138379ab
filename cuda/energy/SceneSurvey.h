// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_SceneSurvey_h
#define limpid_energy_SceneSurvey_h

#include "scene/Grid.h"
#include "scene/NodeValues.h"
#include "scene/Occupancy.h"

#include <memory>

namespace limpid
{
/// The range of a field's values.
struct FieldRange
{
  float largest = 0; ///< at least 0
  bool valid = true; ///< whether all values are in [0, most], see SurveyScene
};

/// Data of a scene that depend on its fields only.
struct SceneSurvey
{
  FieldRange extinction;
  FieldRange importance;
  NodeValues nodeImportance;                  ///< see NodeImportanceOfFilled
  std::shared_ptr<const Occupancy> occupancy; ///< of base and node importance; skips empty voxels
};

/// Computes all of it in one pass over the fields, as reading them takes longer than the
/// computation. `mostExtinction`, `mostImportance`: largest valid values. If a value is invalid,
/// only the ranges are meaningful.
SceneSurvey SurveyScene(const Grid& grid, const float* baseExtinction, float mostExtinction,
  const float* importance, float mostImportance);
}

#endif
