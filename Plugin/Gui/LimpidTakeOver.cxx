// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidTakeOver.h"

#include "ImportancePoints.h"
#include "LimpidBestView.h"
#include "LimpidDataArray.h"
#include "LimpidOptimizedVolumes.h"
#include "LimpidProperties.h"
#include "vtkRenderer.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMStringVectorProperty.h"
#include "vtkSMTrace.h"
#include "vtkScalarsToColors.h"

#include "scene/UprightAxis.h"

namespace
{
// Not copied even though displays have it: it limits the time of the filter.
const char* const NOT_TAKEN = "MaximumIterations";

// Sets the association and the name of an array. The index of the selection is kept: it tells the
// filter which of its arrays is meant.
void TakeArray(vtkSMProxy* filter, const char* name, int association, const std::string& array)
{
  vtkSMPropertyHelper(filter, name).SetInputArrayToProcess(association, array.c_str());
}

// Copies numbers of an optimised volume by name; those of the light only if the volume has its own.
void TakeSettings(vtkSMProxy* filter, vtkSMProxy* display)
{
  const bool hasLight = vtkSMPropertyHelper(display, "LightSource").GetAsInt() == 1;
  ForEachProperty(filter,
    [&](const std::string& name, vtkSMProperty* property)
    {
      const bool isOfLight = name == "LightType" || name == "LightPosition";
      const bool isNumber = !vtkSMStringVectorProperty::SafeDownCast(property);
      if (isNumber && name != NOT_TAKEN && (hasLight || !isOfLight))
      {
        CopyValue(property, display->GetProperty(name.c_str()));
      }
    });
}

// Copies the array that colors and opacities refer to, and its component.
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
  if (!filter->GetProperty("CameraPosition"))
  {
    // A search looks from everywhere, so only the up direction is copied.
    const limpid::Vec3 up = limpid::UprightAxis(PresentCamera(view));
    vtkSMPropertyHelper(filter, "CameraViewUp").Set(&up.x, 3);
  }
}

// Returns the points of the suggested importance function for an array without one.
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
      vtkSMPropertyHelper labels(display, "StructureArray");
      TakeArray(filter, "StructureArray", labels.GetInputArrayAssociation(),
        labels.GetInputArrayNameToProcess());
      CopyValue(filter->GetProperty("Structures"), display->GetProperty("Structures"));
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
