// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "FoundExtinction.h"

#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTrace.h"

namespace limpid
{
namespace
{
// Values of the enumerations in LimpidRepresentations.xml.
constexpr int Array = 1;
constexpr int Ordinary = 1;

// Returns the filter whose image a display shows; null if it shows other data.
vtkSMProxy* OptimizerOf(vtkSMProxy* display)
{
  const vtkSMPropertyHelper input(display, "Input");
  vtkSMProxy* source = input.GetNumberOfElements() > 0 ? input.GetAsProxy() : nullptr;
  const bool isIt = source && source->GetXMLName() && input.GetOutputPort() == 0 &&
    std::string(source->GetXMLName()) == "ExtinctionOptimizer";
  return isIt ? source : nullptr;
}

// Returns where the filter's results are: hyper tree grids have cells only.
int AssociationOf(vtkSMProxy* optimizer)
{
  auto* source = vtkSMSourceProxy::SafeDownCast(optimizer);
  const bool areOnCells =
    source && source->GetDataInformation(0)->GetArrayInformation("Extinction", vtkDataObject::CELL);
  return areOnCells ? vtkDataObject::CELL : vtkDataObject::POINT;
}
}

void ShowFoundExtinction(vtkSMProxy* volume, vtkSMProxy* display)
{
  vtkSMPropertyHelper source(volume, "ExtinctionSource");
  vtkSMPropertyHelper method(volume, "Method");
  vtkSMProxy* optimizer = OptimizerOf(display);
  if (!optimizer || source.GetAsInt() != 0 || method.GetAsInt() != 0)
  {
    return;
  }
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", display);
  source.Set(Array);
  vtkSMPropertyHelper(volume, "ExtinctionArray")
    .SetInputArrayToProcess(AssociationOf(optimizer), "Extinction");
  method.Set(Ordinary);
  volume->UpdateVTKObjects();
}

ColorArray ScalarsOfOptimizer(vtkSMProxy* display)
{
  ColorArray scalars;
  if (vtkSMProxy* optimizer = OptimizerOf(display))
  {
    const vtkSMPropertyHelper chosen(optimizer, "ScalarArray");
    const char* name = chosen.GetInputArrayNameToProcess();
    scalars = { name ? name : "", chosen.GetInputArrayAssociation() };
  }
  return scalars;
}
}
