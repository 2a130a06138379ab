// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkExtinctionOptimizerInternals.h"

#include "OptimizedImage.h"
#include "Refuse.h"
#include "SceneConversion.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"
#include "vtkVersionMacros.h"

#include "optimize/Solver.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace
{
// vtkAlgorithm::CheckAbort came between VTK's releases 9.2 and 9.3; ParaView 5.11 has it.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20230111)
bool IsAborted(vtkAlgorithm* algorithm)
{
  const bool aborted = algorithm->CheckAbort();
  // The executive would empty the output, but we leave a valid one: the input as it came.
  algorithm->SetAbortOutput(false);
  return aborted;
}
#else
bool IsAborted(vtkAlgorithm* algorithm)
{
  return algorithm->GetAbortExecute() != 0;
}
#endif

double MeanCellLength(const limpid::Grid& grid)
{
  double cells = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    cells *= std::max(grid.nodes[axis] - 1, 1);
  }
  const double length = 2 * grid.Radius() / std::cbrt(cells);
  return length > 0 ? length : grid.spacing[0]; // a single point has no length
}

std::array<int, 3> NodesOf(const limpid::Grid& grid)
{
  return { { grid.nodes.x, grid.nodes.y, grid.nodes.z } };
}
}

void vtkExtinctionOptimizer::Internals::Optimize(
  vtkInformationVector** inputVector, vtkImageData* output, vtkTable* convergence)
{
  vtkImageData* input = vtkImageData::GetData(inputVector[0]);
  RequireWholeImage(input, inputVector[0]->GetInformationObject(0));
  this->RequireAvailableChoices();

  limpid::SceneFields scene;
  scene.grid = limpid::GridOfImage(input);
  const double unitDistance = this->Self->ScalarOpacityUnitDistance == 0
    ? MeanCellLength(scene.grid)
    : this->Self->ScalarOpacityUnitDistance;
  const limpid::Camera camera = this->MakeCamera(scene.grid);
  const limpid::Light light = this->MakeLight(camera);
  const limpid::SceneArrays arrays = limpid::ConvertScene(
    input, this->ExtinctionOf(input, unitDistance), this->ImportanceSource(input));
  if (!arrays.Warning().empty())
  {
    vtkWarningWithObjectMacro(this->Self, << arrays.Warning());
  }
  scene.baseExtinction = arrays.baseExtinction->GetPointer(0);
  scene.importance = arrays.importance->GetPointer(0);

  output->ShallowCopy(input);
  if (!scene.grid.HasVolume())
  {
    vtkWarningWithObjectMacro(this->Self,
      "The image has " << scene.grid.nodes.x << " x " << scene.grid.nodes.y << " x "
                       << scene.grid.nodes.z
                       << " points (without a volume nothing can hide anything): the extinction "
                          "stays as it is. Give an image with at least two points per axis.");
    limpid::AddUnsolvedFields(arrays, unitDistance, output);
    limpid::AddPlacement(camera, light, unitDistance, output->GetFieldData());
    return;
  }

  limpid::Solver solver(scene, camera, light, this->MakeSettings());
  this->StartFromLastResult(scene.grid, solver);
  if (!this->Run(solver))
  {
    return; // aborted: the input as it came
  }
  limpid::AddFields(solver, arrays, unitDistance, output);
  limpid::AddSummary(solver, output->GetFieldData());
  limpid::AddPlacement(camera, light, unitDistance, output->GetFieldData());
  limpid::FillConvergence(solver, convergence);
  this->LastNodes = NodesOf(scene.grid);
  this->KeepResult(output);
}

void vtkExtinctionOptimizer::Internals::RequireWholeImage(vtkImageData* input, vtkInformation* info)
{
  if (!input || input->GetNumberOfPoints() == 0)
  {
    limpid::Refuse(
      "The input has no points (there is nothing to optimise). Give it an image with data.");
  }
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  const int* whole = info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT());
  const bool isWhole = !whole || std::equal(whole, whole + 6, input->GetExtent());
  if (controller && controller->GetNumberOfProcesses() > 1 && !isWhole)
  {
    const int* extent = input->GetExtent();
    limpid::Refuse("This process has only the extent ", extent[0], "..", extent[1], " ", extent[2],
      "..", extent[3], " ", extent[4], "..", extent[5], " of ", whole[0], "..", whole[1], " ",
      whole[2], "..", whole[3], " ", whole[4], "..", whole[5],
      " (what hides a structure may lie in the rest, so the result would be wrong). Run with one "
      "process, or read from a source that can give the whole image to each process.");
  }
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
  bool aborted = IsAborted(self);
  if (!aborted)
  {
    solver.Run(
      [self, &aborted](double share, const std::string& text)
      {
        self->SetProgressText(text.c_str());
        self->UpdateProgress(share);
        aborted = IsAborted(self);
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
