// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "DisplayColoring.h"

#include "vtkDataSetAttributes.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkSMArrayListDomain.h"
#include "vtkSMCoreUtilities.h"
#include "vtkSMPVRepresentationProxy.h"
#include "vtkSMProperty.h"
#include "vtkSMSessionProxyManager.h"

namespace limpid
{
namespace
{
// Returns the name of the active scalars of the points; empty if there are none.
std::string ActiveScalars(vtkPVDataInformation* data)
{
  vtkPVDataSetAttributesInformation* points = data ? data->GetPointDataInformation() : nullptr;
  vtkPVArrayInformation* active =
    points ? points->GetAttributeInformation(vtkDataSetAttributes::SCALARS) : nullptr;
  return active && active->GetName() ? active->GetName() : "";
}

// Chooses an array among those that a display can be coloured by, see ColorByAnArray.
ColorArray ChooseColorArray(
  vtkSMArrayListDomain* arrays, const ColorArray& first, const std::string& last)
{
  const std::string active = ActiveScalars(arrays->GetInputDataInformation("Input"));
  ColorArray choice;
  int best = 0;
  for (unsigned int i = 0; i < arrays->GetNumberOfStrings(); ++i)
  {
    const std::string name = arrays->GetString(i);
    const int association = arrays->GetFieldAssociation(i);
    if (name == first.name && association == first.association)
    {
      return first;
    }
    const bool onPoints = association == vtkDataObject::POINT;
    const int rank =
      1 + (onPoints ? 1 : 0) + (onPoints && name == active ? 1 : 0) + (name != last ? 3 : 0);
    if (rank > best)
    {
      best = rank;
      choice = { name, association };
    }
  }
  return choice;
}

bool HasColorMap(vtkSMProxy* display, const std::string& array)
{
  const std::string name = vtkSMCoreUtilities::SanitizeName(array) + ".PVLookupTable";
  return display->GetSessionProxyManager()->GetProxy("lookup_tables", name.c_str()) != nullptr;
}
}

void ColorByAnArray(
  vtkSMPVRepresentationProxy* display, const ColorArray& first, const std::string& last)
{
  vtkSMProperty* coloring = display->GetProperty("ColorArrayName");
  auto* arrays = coloring ? coloring->FindDomain<vtkSMArrayListDomain>() : nullptr;
  if (!arrays || display->GetUsingScalarColoring())
  {
    return;
  }
  const ColorArray choice = ChooseColorArray(arrays, first, last);
  const bool hasColorMap = !choice.name.empty() && HasColorMap(display, choice.name);
  if (!choice.name.empty() && display->SetScalarColoring(choice.name.c_str(), choice.association) &&
    !hasColorMap)
  {
    display->RescaleTransferFunctionToDataRange(true);
  }
}
}
