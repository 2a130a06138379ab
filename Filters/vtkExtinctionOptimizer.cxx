// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkExtinctionOptimizer.h"

#include "vtkExtinctionOptimizerInternals.h"

#include "vtkExtentTranslator.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <exception>

vtkStandardNewMacro(vtkExtinctionOptimizer);

namespace
{
// The part of an image that this process is to hold, of what every process has computed whole.
void KeepRequestedPiece(vtkInformation* outInfo, vtkImageData* output)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  const int pieces = outInfo->Get(Pipeline::UPDATE_NUMBER_OF_PIECES());
  if (pieces > 1)
  {
    vtkNew<vtkExtentTranslator> translator;
    int extent[6];
    translator->PieceToExtentThreadSafe(outInfo->Get(Pipeline::UPDATE_PIECE_NUMBER()), pieces,
      outInfo->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()), output->GetExtent(), extent,
      vtkExtentTranslator::BLOCK_MODE, 0);
    output->Crop(extent);
  }
}
}

vtkExtinctionOptimizer::vtkExtinctionOptimizer()
  : State(new Internals(this))
{
  this->SetNumberOfOutputPorts(2);
}

vtkExtinctionOptimizer::~vtkExtinctionOptimizer() = default;

vtkTable* vtkExtinctionOptimizer::GetConvergence()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(1));
}

int vtkExtinctionOptimizer::FillOutputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkTable");
    return 1;
  }
  return this->Superclass::FillOutputPortInformation(port, info);
}

int vtkExtinctionOptimizer::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* output = vtkImageData::GetData(outputVector, 0);
  vtkTable* convergence = vtkTable::GetData(outputVector, 1);
  try
  {
    this->State->Optimize(inputVector, output, convergence);
    KeepRequestedPiece(outputVector->GetInformationObject(0), output);
    return 1;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    output->Initialize(); // never a half-optimised field
    convergence->Initialize();
    return 0;
  }
}

void vtkExtinctionOptimizer::PrintSelf(ostream& os, vtkIndent indent)
{
  const auto print = [&os, indent](const char* name, const auto& value)
  { os << indent << name << ": " << value << "\n"; };
  const auto printVector = [&os, indent](const char* name, const auto& vector)
  { os << indent << name << ": " << vector[0] << " " << vector[1] << " " << vector[2] << "\n"; };

  this->Superclass::PrintSelf(os, indent);
  print("AutomaticPlacement", this->AutomaticPlacement);
  printVector("CameraPosition", this->CameraPosition);
  printVector("CameraFocalPoint", this->CameraFocalPoint);
  printVector("CameraViewUp", this->CameraViewUp);
  print("CameraViewAngle", this->CameraViewAngle);
  print("CameraParallelProjection", this->CameraParallelProjection);
  print("CameraParallelScale", this->CameraParallelScale);
  print("CameraAspectRatio", this->CameraAspectRatio);
  print("LightType", this->LightType);
  printVector("LightPosition", this->LightPosition);
  print("Mode", this->Mode);
  print("Solver", this->Solver);
  print("MaximumIterations", this->MaximumIterations);
  printVector("IterationsPerLevel", this->IterationsPerLevel);
  print("LearningRate", this->LearningRate);
  print("Tolerance", this->Tolerance);
  print("MaximumSeconds", this->MaximumSeconds);
  print("Derivative", this->Derivative);
  print("SkipUnneeded", this->SkipUnneeded);
  print("RestrictToView", this->RestrictToView);
  print("OptimizeViewpoint", this->OptimizeViewpoint);
  print("ViewpointGuide", this->ViewpointGuide);
  print("WarmStart", this->WarmStart);
}
