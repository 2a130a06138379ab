// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidSetup.h"

#include "ImportancePoints.h"
#include "LimpidDataArray.h"
#include "LimpidOptimizedVolumes.h"
#include "pqApplicationCore.h"
#include "pqDataRepresentation.h"
#include "pqObjectBuilder.h"
#include "pqOutputPort.h"
#include "pqPipelineSource.h"
#include "pqServerManagerModel.h"
#include "pqView.h"
#include "vtkRenderer.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMPropertyIterator.h"
#include "vtkSMProxyProperty.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMRepresentationProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMStringVectorProperty.h"
#include "vtkSMTrace.h"
#include "vtkScalarsToColors.h"

#include <functional>
#include <set>
#include <string>

namespace
{
using Names = std::set<std::string>;

// What is a filter's own even where a display has the name: how long it may take.
const Names NOT_TAKEN{ "MaximumIterations" };

// What is a display's own.
const Names NOT_COPIED{ "Input", "Visibility", "Representation" };

// Functions that displays of one array share.
const Names SHARED{ "LookupTable", "ScalarOpacityFunction", "TransferFunction2D" };

using Action = std::function<void(const std::string&, vtkSMProperty*)>;

void ForEachProperty(vtkSMProxy* proxy, const Action& act)
{
  const auto iterator = vtkSmartPointer<vtkSMPropertyIterator>::Take(proxy->NewPropertyIterator());
  for (iterator->Begin(); !iterator->IsAtEnd(); iterator->Next())
  {
    if (!iterator->GetProperty()->GetInformationOnly())
    {
      act(iterator->GetKey(), iterator->GetProperty());
    }
  }
}

void CopyValue(vtkSMProperty* property, vtkSMProperty* from)
{
  if (property && from && !vtkSMProxyProperty::SafeDownCast(property))
  {
    property->Copy(from);
  }
}

void SetPoints(vtkSMProxy* owner, const char* name, const std::vector<double>& points)
{
  vtkSMProxy* function = vtkSMPropertyHelper(owner, name).GetAsProxy();
  if (!function || points.empty())
  {
    return;
  }
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", function);
  vtkSMPropertyHelper(function, "Points").Set(points.data(), static_cast<unsigned>(points.size()));
  function->UpdateVTKObjects();
}

std::vector<double> PointsOf(vtkSMProxy* owner, const char* name)
{
  vtkSMProxy* function = vtkSMPropertyHelper(owner, name).GetAsProxy();
  return function ? vtkSMPropertyHelper(function, "Points").GetDoubleArray()
                  : std::vector<double>();
}

// What they choose of their inputs' arrays: in a filter it also says which of its arrays that is.
void TakeArray(vtkSMProxy* filter, const char* name, int association, const std::string& array)
{
  vtkSMPropertyHelper(filter, name).SetInputArrayToProcess(association, array.c_str());
}

// Numbers of an optimised volume under the same names. The light only if it is the volume's own.
void TakeSettings(vtkSMProxy* filter, vtkSMProxy* display)
{
  const bool hasLight = vtkSMPropertyHelper(display, "LightSource").GetAsInt() == 1;
  ForEachProperty(filter,
    [&](const std::string& name, vtkSMProperty* property)
    {
      const bool isOfLight = name == "LightType" || name == "LightPosition";
      const bool isNumber = !vtkSMStringVectorProperty::SafeDownCast(property);
      if (isNumber && NOT_TAKEN.count(name) == 0 && (hasLight || !isOfLight))
      {
        CopyValue(property, display->GetProperty(name.c_str()));
      }
    });
}

// The array that colors and opacities are for, and its component.
void TakeScalars(vtkSMProxy* filter, vtkSMProxy* display)
{
  vtkSMPropertyHelper colored(display, "ColorArrayName");
  const char* name = colored.GetInputArrayNameToProcess();
  vtkSMProxy* colors = vtkSMPropertyHelper(display, "LookupTable").GetAsProxy();
  if (!name || !*name || !colors)
  {
    return;
  }
  TakeArray(filter, "ScalarArray", colored.GetInputArrayAssociation(), name);
  const bool isComponent =
    vtkSMPropertyHelper(colors, "VectorMode").GetAsInt() == vtkScalarsToColors::COMPONENT;
  vtkSMPropertyHelper(filter, "ScalarComponent")
    .Set(isComponent ? vtkSMPropertyHelper(colors, "VectorComponent").GetAsInt() : -1);
  CopyValue(filter->GetProperty("ScalarOpacityUnitDistance"),
    display->GetProperty("ScalarOpacityUnitDistance"));
}

void TakeCamera(vtkSMProxy* filter, vtkSMRenderViewProxy* view)
{
  view->SynchronizeCameraProperties();
  ForEachProperty(filter,
    [view](const std::string& name, vtkSMProperty* property)
    {
      if (name.rfind("Camera", 0) == 0)
      {
        CopyValue(property, view->GetProperty(name.c_str()));
      }
    });
  vtkSMPropertyHelper(filter, "CameraAspectRatio", /*quiet=*/true)
    .Set(view->GetRenderer()->GetTiledAspectRatio());
}

// The points of the importance function for an array that nobody has said anything about.
std::vector<double> SuggestImportance(vtkSMProxy* filter)
{
  return limpid::ImportancePoints(ImportanceArrayOf(filter).SuggestedImportance());
}
}

void TakeOverDisplay(vtkSMProxy* filter, vtkSMProxy* display, vtkSMRenderViewProxy* view)
{
  const bool isOptimized = IsOptimizedVolume(display);
  std::vector<double> importance;
  {
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", filter);
    TakeScalars(filter, display);
    TakeCamera(filter, view);
    if (isOptimized)
    {
      TakeSettings(filter, display);
      const LimpidDataArray array = ImportanceArrayOf(display);
      TakeArray(filter, "ImportanceArray", array.Association, array.Name);
      vtkSMPropertyHelper extinction(display, "ExtinctionArray");
      TakeArray(filter, "ExtinctionArray", extinction.GetInputArrayAssociation(),
        extinction.GetInputArrayNameToProcess());
      importance = PointsOf(display, "ImportanceFunction");
    }
    else
    {
      importance = SuggestImportance(filter);
      vtkSMPropertyHelper(filter, "UseImportanceFunction").Set(importance.empty() ? 0 : 1);
    }
    filter->UpdateVTKObjects();
  }
  SetPoints(filter, "ImportanceFunction", importance);
  SetPoints(filter, "ScalarOpacityFunction", PointsOf(display, "ScalarOpacityFunction"));
}

namespace
{
// Last the functions: a change of other properties may move their points.
void CopyDisplay(vtkSMProxy* display, vtkSMProxy* other)
{
  {
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", display);
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
    display->GetProperty("UseImportanceFunction")->Modified(); // it was chosen, whatever it is
    display->UpdateVTKObjects();
  }
  SetPoints(display, "ImportanceFunction", PointsOf(other, "ImportanceFunction"));
}

bool IsLoadingState(vtkSMProxy* proxy)
{
  return proxy->GetSessionProxyManager()->GetInLoadXMLState();
}

bool IsOfLimpid(vtkSMProxy* filter)
{
  const std::string name = filter->GetXMLName();
  return name == "ExtinctionOptimizer" || name == "ViewpointSearch";
}
}

LimpidSetup::LimpidSetup(QObject* parentObject)
  : QObject(parentObject)
{
}

void LimpidSetup::onStartup()
{
  pqApplicationCore* core = pqApplicationCore::instance();
  this->connect(
    core->getObjectBuilder(), &pqObjectBuilder::filterCreated, this, &LimpidSetup::setUpFilter);
  pqServerManagerModel* model = core->getServerManagerModel();
  this->connect(model, &pqServerManagerModel::viewAdded, this, &LimpidSetup::addView);
  for (pqView* view : model->findItems<pqView*>())
  {
    this->addView(view);
  }
}

void LimpidSetup::setUpFilter(pqPipelineSource* filter)
{
  if (!IsOfLimpid(filter->getProxy()))
  {
    return;
  }
  vtkSMPropertyHelper input(filter->getProxy(), "Input");
  auto* source = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
  vtkSMRenderViewProxy* view = ActiveRenderView();
  vtkSMProxy* display = source && view
    ? view->FindRepresentation(source, static_cast<int>(input.GetOutputPort()))
    : nullptr;
  if (display && display->GetProperty("ScalarOpacityUnitDistance") &&
    vtkSMPropertyHelper(display, "Visibility").GetAsInt() != 0)
  {
    TakeOverDisplay(filter->getProxy(), display, view);
  }
}

void LimpidSetup::addView(pqView* view)
{
  this->connect(view, &pqView::representationAdded, this, &LimpidSetup::setUpDisplay);
}

void LimpidSetup::setUpDisplay(pqRepresentation* representation)
{
  auto* display = qobject_cast<pqDataRepresentation*>(representation);
  pqOutputPort* port = display ? display->getOutputPortFromInput() : nullptr;
  if (!port || IsLoadingState(display->getProxy()) ||
    !display->getProxy()->GetProperty("ImportanceArray"))
  {
    return;
  }
  vtkSMProxy* last = nullptr;
  for (pqDataRepresentation* other : port->getRepresentations(nullptr))
  {
    const bool isOther = other != display && other->getProxy() != display->getProxy();
    last = isOther && IsOptimizedVolume(other->getProxy()) ? other->getProxy() : last;
  }
  if (last)
  {
    CopyDisplay(display->getProxy(), last);
  }
}
