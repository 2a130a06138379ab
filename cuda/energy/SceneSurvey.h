// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_SceneSurvey_h
#define limpid_energy_SceneSurvey_h

#include "scene/Grid.h"
#include "scene/NodeValues.h"
#include "sweep/Occupancy.h"

#include <memory>

namespace limpid
{
/// What the values of a field are.
struct FieldRange
{
  float largest = 0; ///< 0 if none is above
  bool valid = true; ///< whether all are in [0, most], see SurveyScene
};

/// What the fields of a scene alone decide.
struct SceneSurvey
{
  FieldRange extinction;
  FieldRange importance;
  NodeValues nodeImportance;                  ///< see NodeImportanceOfFilled
  std::shared_ptr<const Occupancy> occupancy; ///< of base extinction and node importance; skips
};

/// Finds all of it in one pass over the fields, which takes longer to read them than to work on
/// them. `mostExtinction`, `mostImportance`: what values are valid. If there are others, only the
/// ranges mean something.
SceneSurvey SurveyScene(const Grid& grid, const float* baseExtinction, float mostExtinction,
  const float* importance, float mostImportance);
}

#endif
