// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidProperties.h"

#include "vtkSMPropertyHelper.h"
#include "vtkSMPropertyIterator.h"
#include "vtkSMProxy.h"
#include "vtkSMProxyProperty.h"
#include "vtkSMTrace.h"
#include "vtkSmartPointer.h"

void ForEachProperty(
  vtkSMProxy* proxy, const std::function<void(const std::string&, vtkSMProperty*)>& act)
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
