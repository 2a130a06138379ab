// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Choices.h"

#include "ScalarMapping.h"

#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include "math/Require.h"

namespace limpid
{
namespace
{
std::string NamesIn(vtkFieldData* attributes)
{
  std::string names;
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    const char* name = attributes->GetArrayName(i);
    names += (names.empty() ? "" : ", ") + std::string(name ? name : "(no name)");
  }
  return names.empty() ? "none" : names;
}
}

void RequireAngle(const char* property, double degrees)
{
  LIMPID_REQUIRE(degrees >= 0 && degrees <= 180,
    property
      << " is " << degrees
      << " degrees (directions are 0 to 180 degrees apart). Set an angle from 0 to 180 degrees.");
}

void RequireElevations(const double range[2])
{
  LIMPID_REQUIRE(range[0] >= -90 && range[0] <= range[1] && range[1] <= 90,
    "ElevationRange is " << range[0] << " to " << range[1]
                         << " degrees (no direction lies in this range). Set two angles from -90 "
                            "to 90, the smaller one first.");
}

void RequireComponent(const char* property, vtkDataArray* array, int component)
{
  LIMPID_REQUIRE(component >= MagnitudeComponent && component < array->GetNumberOfComponents(),
    property << " is " << component << " (the array \"" << NameOf(array) << "\" has "
             << array->GetNumberOfComponents()
             << " components). Set a component from 0 on, or -1 for the magnitude.");
}

std::string NameOf(vtkDataArray* array)
{
  return array->GetName() ? array->GetName() : "(no name)";
}

std::string ArrayNames(vtkDataSet* data)
{
  return "of the points: " + NamesIn(data->GetPointData()) +
    "; of the cells: " + NamesIn(data->GetCellData());
}

std::string RefusalOf(vtkDataObject* input, const std::string& worker, const std::string& subject)
{
  if (!input || vtkImageData::SafeDownCast(input))
  {
    return {};
  }
  const std::string what = subject + " is a " + input->GetClassName() + " (" + worker +
    " a single image with uniform spacing). ";
  if (vtkCompositeDataSet::SafeDownCast(input))
  {
    return what +
      "Choose one of its blocks with the filter Extract Block, or make an image of all of them "
      "with Merge Blocks and Resample To Image.";
  }
  return what +
    (vtkDataSet::SafeDownCast(input)
        ? "Make it one with the filter Resample To Image."
        : "Connect an image, or data that the filter Resample To Image can convert.");
}
}
