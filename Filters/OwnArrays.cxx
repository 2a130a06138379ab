// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "OwnArrays.h"

#include "vtkAbstractArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVariantKey.h"
#include "vtkVariant.h"

namespace limpid
{
namespace
{
// A key that is not written to files, so that their readers need not know it.
vtkInformationVariantKey* OwnKey()
{
  static vtkInformationVariantKey* const key =
    vtkInformationVariantKey::MakeKey("MADE_BY_LIMPID", "vtkVisibilityAlgorithm");
  return key;
}

bool IsOwn(vtkAbstractArray* array)
{
  return array->HasInformation() && array->GetInformation()->Has(OwnKey());
}
}

void MarkAsGenerated(vtkAbstractArray* array)
{
  OwnKey()->Set(array->GetInformation(), 1);
}

std::vector<vtkAbstractArray*> MarkResults(vtkFieldData* input, vtkFieldData* output)
{
  std::vector<vtkAbstractArray*> replaced;
  for (int i = 0; i < output->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* result = output->GetAbstractArray(i);
    const char* name = result->GetName();
    vtkAbstractArray* before = name ? input->GetAbstractArray(name) : nullptr;
    if (!name || before == result)
    {
      continue; // it was passed through
    }
    if (before && !IsOwn(before))
    {
      replaced.push_back(before);
    }
    MarkAsGenerated(result);
  }
  return replaced;
}
}
