// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidDisplays.h"

#include "LimpidProperties.h"
#include "pqApplicationCore.h"
#include "pqDataRepresentation.h"
#include "pqObjectBuilder.h"
#include "pqOutputPort.h"
#include "pqPipelineSource.h"
#include "pqServerManagerModel.h"
#include "pqUndoStack.h"
#include "pqView.h"
#include "vtkNew.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTrace.h"
#include "vtkSMViewProxy.h"
#include "vtkSmartPointer.h"

#include <cstring>
#include <set>

namespace
{
using Names = std::set<std::string>;

// Properties that each display keeps.
const Names NOT_COPIED{ "Input", "Visibility", "Representation" };

// Functions that displays of one array share.
const Names SHARED{ "LookupTable", "ScalarOpacityFunction", "TransferFunction2D" };

// Copies values, first those that others depend on.
void CopyValues(vtkSMProxy* display, vtkSMProxy* other)
{
  CopyValue(display->GetProperty("Representation"), other->GetProperty("Representation"));
  ForEachProperty(display,
    [other](const std::string& name, vtkSMProperty* property)
    {
      vtkSMProperty* from = other->GetProperty(name.c_str());
      if (from && SHARED.count(name) != 0)
      {
        property->Copy(from);
      }
      else if (NOT_COPIED.count(name) == 0)
      {
        CopyValue(property, from);
      }
    });
}

bool IsOld(vtkSMProxy* display)
{
  const char* const name = "UniformGridRepresentation"; // LimpidRepresentations.xml extends it
  vtkSMProxy* present =
    display->GetSessionProxyManager()->GetPrototypeProxy("representations", name);
  return std::strcmp(display->GetXMLName(), name) == 0 && present &&
    present->GetProperty("ImportanceArray") && !display->GetProperty("ImportanceArray");
}

void Renew(pqDataRepresentation* display)
{
  const pqOutputPort* port = display->getOutputPortFromInput();
  const pqView* view = display->getView();
  if (!port || !view)
  {
    return;
  }
  auto* source = vtkSMSourceProxy::SafeDownCast(port->getSource()->getProxy());
  const vtkSmartPointer<vtkSMProxy> old = display->getProxy();
  pqApplicationCore::instance()->getObjectBuilder()->destroy(
    static_cast<pqRepresentation*>(display));
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  if (vtkSMProxy* anew = controller->Show(source, port->getPortNumber(), view->getViewProxy()))
  {
    CopyValues(anew, old);
    vtkSMPropertyHelper(anew, "Visibility").Set(vtkSMPropertyHelper(old, "Visibility").GetAsInt());
    anew->UpdateVTKObjects();
  }
}
}

void CopyDisplay(vtkSMProxy* display, vtkSMProxy* other)
{
  {
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", display);
    CopyValues(display, other);
    display->GetProperty("UseImportanceFunction")->Modified(); // marks it as set
    display->UpdateVTKObjects();
  }
  SetPoints(display, "ImportanceFunction", PointsOf(other, "ImportanceFunction"));
}

void RenewDisplays()
{
  SCOPED_UNDO_EXCLUDE();
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  for (pqDataRepresentation* display : model->findItems<pqDataRepresentation*>())
  {
    if (IsOld(display->getProxy()))
    {
      Renew(display);
    }
  }
}
