// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Terms.h"

namespace limpid
{
Terms::Terms(const Problem& problem)
{
  const Settings& settings = problem.settings;
  if (settings.weights.view > 0)
  {
    this->camera.emplace(problem.grid, *problem.occupancy, problem.camera, settings.rayDensity);
  }
  if (settings.weights.light > 0)
  {
    this->light.emplace(problem.grid, *problem.occupancy, problem.light, settings.rayDensity);
  }
}

IterationRecord Terms::Measure(const Problem& problem, const std::vector<float>& extinction)
{
  const Weights& weights = problem.settings.weights;
  IterationRecord record;
  record.energy.regularization = problem.Regularization(extinction);
  if (this->camera)
  {
    const Visible seen = this->camera->Forward(extinction.data(), problem.importance);
    record.visibilityScore = seen.visible;
    record.visibleFraction = seen.plain > 0 ? seen.visible / seen.plain : 0.0;
    record.energy.view = -weights.view * seen.visible;
  }
  if (this->light)
  {
    const Visible lit = this->light->Forward(extinction.data(), problem.importance);
    record.energy.light = -weights.light * lit.visible;
  }
  return record;
}
}
