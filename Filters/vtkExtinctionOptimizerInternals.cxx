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

  limpid::Solver solver(scene.Fields(), camera, light, this->MakeSettings());
  this->StartFromLastResult(scene.grid, solver);
  if (!this->Run(solver))
  {
    return; // aborted: the input as it came
  }
  limpid::AddFields(solver, scene.arrays, scene.unitDistance, output);
  limpid::AddSummary(solver, output->GetFieldData());
  limpid::AddPlacement(camera, light, scene.unitDistance, output->GetFieldData());
  limpid::FillConvergence(solver, convergence);
  this->LastNodes = NodesOf(scene.grid);
  this->KeepResult(output);
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

// Returns whether the run came to its end, and not to an abort.
bool vtkExtinctionOptimizer::Internals::Run(limpid::Solver& solver) const
{
  vtkExtinctionOptimizer* self = this->Self;
  bool aborted = this->Reader.IsAborted();
  if (!aborted)
  {
    solver.Run(
      [this, self, &aborted](double share, const std::string& text)
      {
        self->SetProgressText(text.c_str());
        self->UpdateProgress(share);
        aborted = this->Reader.IsAborted();
        return !aborted;
      });
  }
  self->SetProgressText(nullptr);
  return !aborted;
}

void vtkExtinctionOptimizer::Internals::KeepResult(vtkImageData* output)
{
  this->LastExtinction = this->Self->WarmStart
    ? vtkFloatArray::SafeDownCast(output->GetPointData()->GetArray("Extinction"))
    : nullptr;
}
