// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/PreviewPass.h"

namespace limpid
{
namespace
{
/// One sweep for a term of weight `weight`; `found` is written where anything may change.
void Sweep(const Problem& problem, EyeSweeps& eye, double weight, std::vector<float>& found)
{
  if (found.empty())
  {
    found.assign(problem.baseExtinction, problem.baseExtinction + problem.grid.NodeCount());
  }
  eye.Pass(weight, found);
}
}

void PreviewPass::Make(const Camera& camera, const Light& light, const Settings& settings)
{
  this->Seen.reset();
  this->Task = this->Scene->ProblemFor(camera, light, settings);
  this->Computer.Choose(settings, this->Task.grid);
  this->Before.reset();
  this->After.reset();
  const Weights& weights = settings.weights;
  const bool toSee = this->Scene->SomethingToSee();
  const bool forCamera = toSee && weights.view > 0;
  const bool separate = settings.mode == Mode::Separate;
  const bool forLight = toSee && weights.light > 0 && (separate || !forCamera);
  if (forCamera)
  {
    Sweep(this->Task, this->CameraSweeps(), weights.view, this->ForCamera);
  }
  std::vector<float>& lit = separate ? this->ForLight : this->ForCamera;
  if (forLight)
  {
    Sweep(this->Task, *this->Computer->Look(this->Task, this->Task.light), weights.light, lit);
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

EyeSweeps& PreviewPass::CameraSweeps()
{
  if (!this->Seen)
  {
    this->Seen = this->Computer->Look(this->Task, this->Task.camera);
  }
  return *this->Seen;
}

Score PreviewPass::ScoreOf(const float* extinction)
{
  const Visible seen = this->CameraSweeps().Score(extinction);
  return { seen.visible, seen.unattenuated > 0 ? seen.visible / seen.unattenuated : 0.0 };
}
}
