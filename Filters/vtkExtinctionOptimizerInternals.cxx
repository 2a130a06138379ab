// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkExtinctionOptimizerInternals.h"

#include "OptimizedImage.h"

#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkTable.h"

#include "optimize/Solver.h"

#include <string>

namespace
{
std::array<int, 3> NodesOf(const limpid::Grid& grid)
{
  return { { grid.nodes.x, grid.nodes.y, grid.nodes.z } };
}
}

void vtkExtinctionOptimizer::Internals::Optimize(
  vtkInformationVector** inputVector, vtkImageData* output, vtkTable* convergence)
{
  vtkImageData* input = this->Reader.RequireWholeImage(inputVector);
  this->RequireAvailableChoices();
  const limpid::ImageScene scene = this->Reader.Read(input, this->Self->ExtinctionSource);
  const limpid::Camera camera = this->MakeCamera(scene.grid);
  const limpid::Light light = this->MakeLight(camera);

  output->ShallowCopy(input);
  if (!scene.grid.HasVolume())
  {
    vtkWarningWithObjectMacro(this->Self,
      "The image has " << scene.grid.nodes.x << " x " << scene.grid.nodes.y << " x "
                       << scene.grid.nodes.z
                       << " points (without a volume nothing can hide anything): the extinction "
                          "stays as it is. Give an image with at least two points per axis.");
    limpid::AddUnsolvedFields(scene.arrays, scene.unitDistance, output);
    limpid::AddPlacement(camera, light, scene.unitDistance, output->GetFieldData());
    return;
  }

  const limpid::ConcurrentResult result = this->Self->OptimizeViewpoint
    ? this->OptimizeBoth(scene.Fields(), camera, light)
    : this->OptimizeExtinction(scene.Fields(), camera, light);
  this->Self->SetProgressText(nullptr);
  if (!result.solver)
  {
    return; // aborted: the input as it came
  }
  limpid::AddFields(*result.solver, scene.arrays, scene.unitDistance, output);
  limpid::AddSummary(*result.solver, output->GetFieldData());
  limpid::AddPlacement(result.camera, light, scene.unitDistance, output->GetFieldData());
  if (this->Self->OptimizeViewpoint)
  {
    limpid::AddStart(result.startScore, output->GetFieldData());
  }
  limpid::FillConvergence(*result.solver, convergence);
  this->LastNodes = NodesOf(scene.grid);
  this->KeepResult(output);
}

// Without a solver if it was aborted.
limpid::ConcurrentResult vtkExtinctionOptimizer::Internals::OptimizeExtinction(
  const limpid::SceneFields& scene, const limpid::Camera& camera, const limpid::Light& light) const
{
  limpid::ConcurrentResult result;
  result.camera = camera;
  auto solver = std::make_unique<limpid::Solver>(scene, camera, light, this->MakeSettings());
  this->StartFromLastResult(scene.grid, *solver);
  bool aborted = this->Reader.IsAborted();
  if (!aborted)
  {
    solver->Run(this->ReportTo(aborted));
  }
  result.solver = aborted ? nullptr : std::move(solver);
  return result;
}

limpid::ConcurrentResult vtkExtinctionOptimizer::Internals::OptimizeBoth(
  const limpid::SceneFields& scene, const limpid::Camera& camera, const limpid::Light& light) const
{
  bool aborted = this->Reader.IsAborted();
  limpid::ConcurrentResult result;
  if (!aborted)
  {
    result = limpid::OptimizeConcurrently(scene, camera, light, this->MakeSettings(),
      static_cast<limpid::Guide>(this->Self->ViewpointGuide), this->ReportTo(aborted));
  }
  result.solver = aborted ? nullptr : std::move(result.solver);
  return result;
}

// Tells the user how far it is, and the solver, by `aborted`, when the user has had enough.
limpid::Progress vtkExtinctionOptimizer::Internals::ReportTo(bool& aborted) const
{
  return [this, &aborted](double share, const std::string& text)
  {
    this->Self->SetProgressText(text.c_str());
    this->Self->UpdateProgress(share);
    aborted = this->Reader.IsAborted();
    return !aborted;
  };
}

void vtkExtinctionOptimizer::Internals::StartFromLastResult(
  const limpid::Grid& grid, limpid::Solver& solver) const
{
  if (this->Self->WarmStart && this->Self->Mode == JOINT && this->LastExtinction &&
    this->LastNodes == NodesOf(grid))
  {
    solver.SetInitialExtinction(this->LastExtinction->GetPointer(0));
  }
}

void vtkExtinctionOptimizer::Internals::KeepResult(vtkImageData* output)
{
  this->LastExtinction = this->Self->WarmStart
    ? vtkFloatArray::SafeDownCast(output->GetPointData()->GetArray("Extinction"))
    : nullptr;
}
