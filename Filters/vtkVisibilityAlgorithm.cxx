// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkVisibilityAlgorithm.h"

#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPiecewiseFunction.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

vtkCxxSetObjectMacro(vtkVisibilityAlgorithm, ImportanceFunction, vtkPiecewiseFunction);
vtkCxxSetObjectMacro(vtkVisibilityAlgorithm, ScalarOpacityFunction, vtkPiecewiseFunction);

vtkVisibilityAlgorithm::vtkVisibilityAlgorithm()
{
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  this->SetInputArrayToProcess(
    1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, "Importance");
  this->SetInputArrayToProcess(
    2, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, "BaseExtinction");
}

vtkVisibilityAlgorithm::~vtkVisibilityAlgorithm()
{
  this->SetImportanceFunction(nullptr);
  this->SetScalarOpacityFunction(nullptr);
}

vtkMTimeType vtkVisibilityAlgorithm::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  for (vtkPiecewiseFunction* function : { this->ImportanceFunction, this->ScalarOpacityFunction })
  {
    if (function)
    {
      time = std::max(time, function->GetMTime());
    }
  }
  return time;
}

int vtkVisibilityAlgorithm::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  // Any point may hide any other: the whole image, in one piece, whatever was asked for.
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* info = inputVector[0]->GetInformationObject(0);
  info->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
  info->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
  info->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  if (info->Has(Pipeline::WHOLE_EXTENT()))
  {
    info->Set(Pipeline::UPDATE_EXTENT(), info->Get(Pipeline::WHOLE_EXTENT()), 6);
  }
  return 1;
}

void vtkVisibilityAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  const auto print = [&os, indent](const char* name, const auto& value)
  { os << indent << name << ": " << value << "\n"; };

  this->Superclass::PrintSelf(os, indent);
  print("ScalarComponent", this->ScalarComponent);
  print("ImportanceComponent", this->ImportanceComponent);
  print("UseImportanceFunction", this->UseImportanceFunction);
  print("ImportanceFunction", static_cast<void*>(this->ImportanceFunction));
  print("ExtinctionSource", this->ExtinctionSource);
  print("ScalarOpacityFunction", static_cast<void*>(this->ScalarOpacityFunction));
  print("ScalarOpacityUnitDistance", this->ScalarOpacityUnitDistance);
  print("RegularizationWeight", this->RegularizationWeight);
  print("ViewWeight", this->ViewWeight);
  print("LightWeight", this->LightWeight);
  print("RayDensity", this->RayDensity);
  print("Backend", this->Backend);
}
