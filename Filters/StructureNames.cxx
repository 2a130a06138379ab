// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "StructureNames.h"

#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

namespace limpid
{
namespace
{
const char* const labelArray = "StructureLabels";
const char* const nameArray = "StructureNames";
}

void SetStructureNames(const StructureNames& names, vtkImageData* image)
{
  if (names.empty())
  {
    return;
  }
  vtkNew<vtkIdTypeArray> labels;
  vtkNew<vtkStringArray> texts;
  labels->SetName(labelArray);
  texts->SetName(nameArray);
  for (const auto& [label, name] : names)
  {
    labels->InsertNextValue(static_cast<vtkIdType>(label));
    texts->InsertNextValue(name);
  }
  image->GetFieldData()->AddArray(labels);
  image->GetFieldData()->AddArray(texts);
}

StructureNames StructureNamesOf(vtkImageData* image)
{
  StructureNames names;
  vtkDataArray* labels = image->GetFieldData()->GetArray(labelArray);
  auto* texts = vtkStringArray::SafeDownCast(image->GetFieldData()->GetAbstractArray(nameArray));
  if (!labels || !texts || labels->GetNumberOfTuples() != texts->GetNumberOfValues())
  {
    return names;
  }
  for (vtkIdType i = 0; i < texts->GetNumberOfValues(); ++i)
  {
    names[static_cast<std::int64_t>(labels->GetComponent(i, 0))] = texts->GetValue(i);
  }
  return names;
}
}
