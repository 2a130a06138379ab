// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "RestoredFunction.h"

#include "vtkSMParaViewPipelineController.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMProxyListDomain.h"
#include "vtkSMProxyProperty.h"
#include "vtkSMSessionProxyManager.h"

#include <string>

namespace limpid
{
namespace
{
const char* const FUNCTION = "ImportanceFunction";

vtkSMProxy* DefaultOf(vtkSMProperty* property)
{
  auto* domain = property->FindDomain<vtkSMProxyListDomain>();
  return domain && domain->GetNumberOfProxies() > 0 ? domain->GetProxy(0) : nullptr;
}
}

void RestoreImportanceFunction(vtkSMProxy* volume, vtkSMProxy* display, MissingFunction missing)
{
  vtkSMProperty* property = volume->GetProperty(FUNCTION);
  vtkSMPropertyHelper helper(property);
  if (helper.GetNumberOfElements() > 0 && helper.GetAsProxy())
  {
    return;
  }
  const std::string group = vtkSMParaViewPipelineController::GetHelperProxyGroupName(display);
  vtkSMProxy* function = volume->GetSessionProxyManager()->GetProxy(group.c_str(), FUNCTION);
  if (!function && missing == MissingFunction::TakesDefault)
  {
    function = DefaultOf(property);
  }
  if (function)
  {
    function->UpdateVTKObjects();
    helper.Set(function);
    volume->UpdateVTKObjects();
  }
}
}
