// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/PreviewPass.h"

namespace limpid
{
namespace
{
void Assign(const Problem& problem, std::vector<float>& base)
{
  base.assign(problem.baseExtinction, problem.baseExtinction + problem.grid.NodeCount());
}

/// Sweeps once for a term of weight `weight`; writes `found` where values may change.
void Sweep(const Problem& problem, SourceSweeps& sweeps, double weight, std::vector<float>& found)
{
  if (found.empty())
  {
    Assign(problem, found);
  }
  sweeps.SweepPolicyOnce(weight, found);
}
}

template <class Work>
void PreviewPass::OnBackend(const Work& work)
{
  this->Backend.Do(work,
    [this]
    {
      this->FromCamera.reset();
      this->ForScores.reset();
    });
}

void PreviewPass::Make(
  const Camera& camera, const Light& light, const Settings& settings, const CarriedChange& previous)
{
  const Settings& last = this->Given.settings;
  if (settings.importanceSmoothing != last.importanceSmoothing || settings.method != last.method)
  {
    this->Forget(); // a pass writes only where its own importance may change values
  }
  this->FromCamera.reset();
  this->ForScores.reset();
  this->Given = this->Scene->ProblemFor(camera, light, settings);
  this->Pulls = this->Scene->PullsFor(previous, this->Given, camera, light);
  this->Judged = // more rays would take too long
    this->Scene->ProblemForScoresOfIterates(camera, light, settings);
  this->Backend.Choose(settings, *this->Scene);
  this->Before.reset();
  this->After.reset();
  this->OnBackend([&]
    { InfoOf(settings.method).iterates ? this->MakeByPolicy(settings) : this->MakeByMethod(); });
}

void PreviewPass::MakeByMethod()
{
  this->ForLight = {};
  this->ForCamera = {};
  if (!this->Scene->SomethingToSee())
  {
    return;
  }
  const auto make = [this](bool forLight, std::vector<float>& found)
  {
    Assign(this->Given, found);
    this->Given.forLight = forLight;
    this->Backend->FindByMethod(this->Given, found);
  };
  make(false, this->ForCamera);
  if (HasLightExtinction(this->Given.settings))
  {
    make(true, this->ForLight);
  }
}

void PreviewPass::MakeByPolicy(const Settings& settings)
{
  const Weights& weights = settings.weights;
  const bool toSee = this->Scene->SomethingToSee();
  const bool forCamera = toSee && weights.view > 0;
  const bool separate = settings.mode == Mode::Separate;
  const bool forLight = toSee && weights.light > 0 && (separate || !forCamera);
  if (forCamera)
  {
    this->Given.DrawTo(this->Pulls, false);
    Sweep(this->Given, this->CameraSweeps(), weights.view, this->ForCamera);
  }
  std::vector<float>& lit = separate ? this->ForLight : this->ForCamera;
  if (forLight)
  {
    this->Given.DrawTo(this->Pulls, separate);
    Sweep(this->Given, *this->Backend->SweepsFrom(this->Given, this->Given.Light()), weights.light,
      lit);
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
  this->Given.furtherPulls.clear();
  this->Pulls.clear();
  this->ForCamera = {};
  this->ForLight = {};
  this->FromCamera.reset();
  this->ForScores.reset();
}

Score PreviewPass::BaseScore()
{
  if (!this->Before)
  {
    this->OnBackend([&] { this->Before = this->ScoreOf(this->Base()); });
  }
  return *this->Before;
}

Score PreviewPass::BestScore()
{
  if (!this->After)
  {
    this->OnBackend([&] { this->After = this->ScoreOf(this->Extinction()); });
  }
  return *this->After;
}

SourceSweeps& PreviewPass::CameraSweeps()
{
  if (!this->FromCamera)
  {
    this->FromCamera = this->Backend->SweepsFromCameras(this->Given);
  }
  return *this->FromCamera;
}

Score PreviewPass::ScoreOf(const float* extinction)
{
  if (this->Judged.importance == this->Given.importance)
  {
    return this->CameraSweeps().ScoreOf(extinction);
  }
  if (!this->ForScores)
  {
    this->ForScores = this->Backend->SweepsFromCameras(this->Judged);
  }
  return this->ForScores->ScoreOf(extinction);
}
}
