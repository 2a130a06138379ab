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

IterationRecord Terms::Measure(const Problem& problem, const float* extinction)
{
  Seen seen;
  if (this->camera)
  {
    seen.byCamera = this->camera->Forward(extinction, problem.importance);
  }
  if (this->light)
  {
    seen.byLight = this->light->Forward(extinction, problem.importance);
  }
  return RecordOf(problem, problem.Regularization(extinction), seen);
}

IterationRecord Terms::AddGradient(
  const Problem& problem, const std::vector<float>& extinction, std::vector<float>& gradient)
{
  const Settings& settings = problem.settings;
  const TermFields fields{ extinction.data(), problem.importance, problem.nodeImportance };
  Seen seen;
  if (this->camera)
  {
    seen.byCamera = this->camera->AddGradient(
      fields, settings.derivative, static_cast<float>(settings.weights.view), gradient.data());
  }
  if (this->light)
  {
    seen.byLight = this->light->AddGradient(
      fields, settings.derivative, static_cast<float>(settings.weights.light), gradient.data());
  }
  return RecordOf(problem, problem.Regularization(extinction.data()), seen);
}

IterationRecord RecordOf(const Problem& problem, double regularization, const Seen& seen)
{
  const Weights& weights = problem.settings.weights;
  IterationRecord record;
  record.energy.regularization = regularization;  // Eq. (22)
  record.visibilityScore = seen.byCamera.visible; // Eq. (32)
  record.visibleFraction =
    seen.byCamera.unattenuated > 0 ? seen.byCamera.visible / seen.byCamera.unattenuated : 0.0;
  record.energy.view = -weights.view * seen.byCamera.visible;  // Eq. (23)
  record.energy.light = -weights.light * seen.byLight.visible; // Eq. (24)
  return record;
}
}
