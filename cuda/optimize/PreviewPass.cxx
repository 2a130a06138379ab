// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/PreviewPass.h"

#include "optimize/PolicySweep.h"

namespace limpid
{
namespace
{
/// One sweep for a term of weight `weight`; `found` is written where anything may change.
void Sweep(const Problem& problem, VisibilityTerm& term, double weight, std::vector<float>& found)
{
  if (found.empty())
  {
    found.assign(problem.baseExtinction, problem.baseExtinction + problem.grid.NodeCount());
  }
  PolicyTask task = TaskOf(problem, weight, 0.0);
  task.fields.extinction = problem.baseExtinction; // not read
  task.fields.next = found.data();
  task.trust = Trust::Clear;
  for (std::size_t index = 0; index < term.PyramidCount(); ++index)
  {
    SweepPolicy(term.PyramidAt(index), task, term.ImagesAt(index));
  }
}
}

void PreviewPass::Make(const Camera& camera, const Light& light, const Settings& settings)
{
  this->Task = this->Scene->ProblemFor(camera, light, settings);
  this->Seen.reset();
  this->Before.reset();
  this->After.reset();
  const Weights& weights = settings.weights;
  const bool toSee = this->Scene->SomethingToSee();
  const bool forCamera = toSee && weights.view > 0;
  const bool separate = settings.mode == Mode::Separate;
  const bool forLight = toSee && weights.light > 0 && (separate || !forCamera);
  if (forCamera)
  {
    Sweep(this->Task, this->CameraTerm(), weights.view, this->ForCamera);
  }
  std::vector<float>& lit = separate ? this->ForLight : this->ForCamera;
  if (forLight)
  {
    const Problem& task = this->Task;
    VisibilityTerm term(task.grid, *task.occupancy, task.light, settings.rayDensity);
    Sweep(task, term, weights.light, lit);
  }
  if (!forLight)
  {
    this->ForLight = {};
  }
  if (!forCamera && !(forLight && !separate))
  {
    this->ForCamera = {};
  }
}

void PreviewPass::Forget()
{
  this->ForCamera = {};
  this->ForLight = {};
  this->Seen.reset();
}

Score PreviewPass::BaseScore()
{
  if (!this->Before)
  {
    this->Before = this->ScoreOf(this->Base());
  }
  return *this->Before;
}

Score PreviewPass::BestScore()
{
  if (!this->After)
  {
    this->After = this->ScoreOf(this->Extinction());
  }
  return *this->After;
}

VisibilityTerm& PreviewPass::CameraTerm()
{
  if (!this->Seen)
  {
    const Problem& task = this->Task;
    this->Seen.emplace(task.grid, *task.occupancy, task.camera, task.settings.rayDensity);
  }
  return *this->Seen;
}

Score PreviewPass::ScoreOf(const float* extinction)
{
  const Visible seen = this->CameraTerm().Forward(extinction, this->Task.importance);
  return { seen.visible, seen.plain > 0 ? seen.visible / seen.plain : 0.0 };
}
}
