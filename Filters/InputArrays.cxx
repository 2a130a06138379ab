// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "InputArrays.h"

#include "Choices.h"
#include "StructureLabels.h"

#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkPointData.h"

#include "math/Require.h"

namespace limpid
{
FieldSource FindField(vtkImageData* image, const std::string& name, int association)
{
  const bool both = association == vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS;
  FieldSource source;
  if (both || association == vtkDataObject::FIELD_ASSOCIATION_POINTS)
  {
    source.array = image->GetPointData()->GetArray(name.c_str());
  }
  if (!source.array && (both || association == vtkDataObject::FIELD_ASSOCIATION_CELLS))
  {
    source.array = image->GetCellData()->GetArray(name.c_str());
    source.onCells = source.array != nullptr;
  }
  return source;
}

std::string ChosenName(vtkAlgorithm* owner, int index)
{
  vtkInformation* chosen = owner->GetInputArrayInformation(index);
  const char* given =
    chosen->Has(vtkDataObject::FIELD_NAME()) ? chosen->Get(vtkDataObject::FIELD_NAME()) : nullptr;
  const std::string name = given ? given : "";
  // If the input had not been executed before, the array property of a script has no name, or its
  // own index as its name. Only ParaView's server manager sets such names.
  return name != std::to_string(index) && name != "(Automatic)" && name != "(None)" ? name : "";
}

std::set<std::string> ChosenNames(vtkAlgorithm* owner)
{
  std::set<std::string> names{ ChosenName(owner, 0) };
  for (int index = 1; index < endOfInputArrays; ++index)
  {
    const std::string name = ChosenName(owner, index);
    if (!name.empty())
    {
      names.insert(name);
    }
  }
  return names;
}

std::vector<FieldSource> ReferenceSources(vtkAlgorithm* owner, vtkImageData* image)
{
  std::vector<FieldSource> sources(givenReferences);
  int index = firstReferenceArray;
  for (FieldSource& source : sources)
  {
    const std::string name = ChosenName(owner, index);
    if (image && !name.empty())
    {
      source = FindField(image, name,
        owner->GetInputArrayInformation(index)->Get(vtkDataObject::FIELD_ASSOCIATION()));
      LIMPID_REQUIRE(source.array,
        "The reference array \""
          << name
          << "\" is not among the input's numeric arrays (there is nothing to stay near). "
             "Choose one of these: "
          << ArrayNames(image) << ".");
    }
    ++index;
  }
  return sources;
}

void CopyFurtherArrays(vtkAlgorithm* from, vtkAlgorithm* to)
{
  for (int index = structureArray; index < endOfInputArrays; ++index)
  {
    vtkInformation* chosen = from->GetInputArrayInformation(index);
    to->SetInputArrayToProcess(index, 0, 0,
      chosen->Has(vtkDataObject::FIELD_ASSOCIATION())
        ? chosen->Get(vtkDataObject::FIELD_ASSOCIATION())
        : vtkDataObject::FIELD_ASSOCIATION_POINTS,
      ChosenName(from, index).c_str());
  }
}
}
