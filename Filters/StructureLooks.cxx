// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "StructureLooks.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <limits>

namespace limpid
{
namespace
{
const char* const labelArray = "StructureLabels";
const char* const nameArray = "StructureNames";
const char* const colorArray = "StructureColors";
}

std::optional<Color> ColorOf(const Color& numbers, double most)
{
  const bool isColor = std::all_of(numbers.begin(), numbers.end(),
    [most](double number) { return number >= 0 && number <= most; });
  return isColor ? std::optional<Color>({ numbers[0] / most, numbers[1] / most, numbers[2] / most })
                 : std::nullopt;
}

void SetStructureLooks(const StructureLooks& looks, vtkImageData* image)
{
  if (looks.empty())
  {
    return;
  }
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  vtkNew<vtkIdTypeArray> labels;
  vtkNew<vtkStringArray> names;
  vtkNew<vtkDoubleArray> colors;
  labels->SetName(labelArray);
  names->SetName(nameArray);
  colors->SetName(colorArray);
  colors->SetNumberOfComponents(3);
  bool hasColors = false;
  for (const auto& [label, look] : looks)
  {
    labels->InsertNextValue(static_cast<vtkIdType>(label));
    names->InsertNextValue(look.name);
    colors->InsertNextTuple(look.color.value_or(Color{ none, none, none }).data());
    hasColors = hasColors || look.color;
  }
  image->GetFieldData()->AddArray(labels);
  image->GetFieldData()->AddArray(names);
  if (hasColors)
  {
    image->GetFieldData()->AddArray(colors);
  }
}

StructureLooks StructureLooksOf(vtkImageData* image)
{
  StructureLooks looks;
  vtkFieldData* fields = image->GetFieldData();
  vtkDataArray* labels = fields->GetArray(labelArray);
  auto* names = vtkStringArray::SafeDownCast(fields->GetAbstractArray(nameArray));
  vtkDataArray* colors = fields->GetArray(colorArray);
  if (!labels || !names || labels->GetNumberOfTuples() != names->GetNumberOfValues())
  {
    return looks;
  }
  const bool hasColors = colors && colors->GetNumberOfComponents() == 3 &&
    colors->GetNumberOfTuples() == names->GetNumberOfValues();
  for (vtkIdType i = 0; i < names->GetNumberOfValues(); ++i)
  {
    StructureLook& look = looks[static_cast<std::int64_t>(labels->GetComponent(i, 0))];
    look.name = names->GetValue(i);
    if (hasColors)
    {
      Color numbers;
      colors->GetTuple(i, numbers.data());
      look.color = ColorOf(numbers, 1);
    }
  }
  return looks;
}
}
