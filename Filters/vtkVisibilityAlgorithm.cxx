// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkVisibilityAlgorithm.h"

#include "PropertyPrinter.h"
#include "WholeRequest.h"

#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPiecewiseFunction.h"

#include <algorithm>

vtkCxxSetObjectMacro(vtkVisibilityAlgorithm, ScalarOpacityFunction, vtkPiecewiseFunction);

vtkVisibilityAlgorithm::vtkVisibilityAlgorithm()
  : Settings(vtkSmartPointer<vtkVisibilitySettings>::New())
{
  this->Settings->SetTemporalCoherence(0); // results do not depend on earlier runs
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  this->SetInputArrayToProcess(
    2, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, "BaseExtinction");
}

vtkVisibilityAlgorithm::~vtkVisibilityAlgorithm()
{
  this->SetScalarOpacityFunction(nullptr);
}

bool vtkVisibilityAlgorithm::SetPreset(const char* name)
{
  const bool isThere = this->Settings->SetPreset(name);
  if (isThere)
  {
    this->Settings->SetTemporalCoherence(0);
  }
  return isThere;
}

void vtkVisibilityAlgorithm::SetVisibilitySettings(vtkVisibilitySettings* settings)
{
  if (settings && settings != this->Settings)
  {
    this->Settings = settings;
    this->Modified();
  }
}

vtkMTimeType vtkVisibilityAlgorithm::GetMTime()
{
  const vtkMTimeType time = std::max(this->Superclass::GetMTime(), this->Settings->GetMTime());
  vtkPiecewiseFunction* function = this->ScalarOpacityFunction;
  return function ? std::max(time, function->GetMTime()) : time;
}

int vtkVisibilityAlgorithm::FillInputPortInformation(int, vtkInformation* info)
{
  // Data of other types are passed to the filter, which reports a specific error. Composite data
  // come first in the list, so that the executive does not pass them block by block.
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  return 1;
}

int vtkVisibilityAlgorithm::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  limpid::RequestWhole(inputVector[0]->GetInformationObject(0)); // any point may hide any other
  return 1;
}

void vtkVisibilityAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  const limpid::PropertyPrinter print{ os, indent };

  this->Superclass::PrintSelf(os, indent);
  print("ExtinctionSource", this->ExtinctionSource);
  print("ScalarOpacityFunction", static_cast<void*>(this->ScalarOpacityFunction));
  print("ScalarOpacityUnitDistance", this->ScalarOpacityUnitDistance);
  os << indent << "VisibilitySettings:\n";
  this->Settings->PrintSelf(os, indent.GetNextIndent());
}
