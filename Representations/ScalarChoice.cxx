// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ScalarChoice.h"

#include "vtkCellData.h"
#include "vtkColorTransferFunction.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"

#include <cstring>

namespace limpid
{
namespace
{
bool HasName(vtkDataArray* array, const char* name)
{
  return array->GetName() && name && std::strcmp(array->GetName(), name) == 0;
}

// Returns null if there are only arrays to be avoided.
vtkDataArray* Choose(vtkDataSetAttributes* attributes, const char* avoided)
{
  vtkDataArray* active = attributes->GetScalars();
  if (active && active->GetName() && !HasName(active, avoided))
  {
    return active;
  }
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = attributes->GetArray(i); // null: not numeric
    if (array && array->GetName() && !HasName(array, avoided) &&
      !HasName(array, vtkDataSetAttributes::GhostArrayName()))
    {
      return array;
    }
  }
  return nullptr;
}
}

ScalarChoice FindScalars(vtkImageData* image, const char* name, bool onCells)
{
  vtkDataSetAttributes* attributes = image->GetPointData();
  if (onCells)
  {
    attributes = image->GetCellData();
  }
  return { attributes->GetArray(name), onCells };
}

ScalarChoice ChooseScalars(vtkImageData* image, const char* last)
{
  for (const char* avoided : { last, "" })
  {
    if (vtkDataArray* array = Choose(image->GetPointData(), avoided))
    {
      return { array, false };
    }
    if (vtkDataArray* array = Choose(image->GetCellData(), avoided))
    {
      return { array, true };
    }
  }
  return {};
}

void SpreadOverRange(
  std::array<double, 2> range, vtkColorTransferFunction* colors, vtkPiecewiseFunction* opacity)
{
  if (!(range[0] < range[1]))
  {
    range[1] = range[0] + 1;
  }
  colors->RemoveAllPoints();
  colors->SetColorSpaceToDiverging();
  colors->AddRGBPoint(range[0], 0.231, 0.298, 0.753);
  colors->AddRGBPoint(0.5 * (range[0] + range[1]), 0.865, 0.865, 0.865);
  colors->AddRGBPoint(range[1], 0.706, 0.016, 0.149);
  opacity->RemoveAllPoints();
  opacity->AddPoint(range[0], 0);
  opacity->AddPoint(range[1], 1);
}
}
