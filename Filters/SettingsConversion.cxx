// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SettingsConversion.h"

#include "Vectors.h"

#include "vtkPiecewiseFunction.h"
#include "vtkVisibilitySettings.h"

#include "math/Require.h"
#include "optimize/SettingsTable.h"
#include "optimize/Solver.h"
#include "scene/ViewSet.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace limpid
{
namespace
{
/// Converts the value of a property to that of a member.
template <class From, class To>
void Convert(From value, To& member)
{
  member = static_cast<To>(value);
}

template <class From, class To, std::size_t Count>
void Convert(From* values, std::array<To, Count>& member)
{
  std::copy_n(values, Count, member.begin());
}
}

Settings SettingsOf(vtkVisibilitySettings* settings)
{
  Settings result;
#define LIMPID_CONVERT(name, inPython, member) Convert(settings->Get##name(), result.member);
  LIMPID_EVERY_CORE_SETTING(LIMPID_CONVERT);
#undef LIMPID_CONVERT
  return result;
}

ViewSet ViewSetOf(vtkVisibilitySettings* settings)
{
  ViewSet views;
  const bool several = settings->GetMethod() == static_cast<int>(Method::Optimized);
  views.kind = several ? static_cast<ViewKind>(settings->GetViews()) : ViewKind::Single;
  views.count = settings->GetNumberOfViews();
  views.eyeAngle = settings->GetEyeAngle();
  return views;
}

Light LightOf(vtkVisibilitySettings* settings, const Vec3& focalPoint)
{
  Light light;
  light.type = static_cast<LightType>(settings->GetLightType());
  light.position = ToVec3(settings->GetLightPosition());
  light.focalPoint = focalPoint;
  return light;
}

ScalarMapping ImportanceMapping(vtkVisibilitySettings* settings)
{
  if (!settings->GetUseImportanceFunction())
  {
    return KeepValue();
  }
  vtkPiecewiseFunction* function = settings->GetImportanceFunction();
  LIMPID_REQUIRE(function && function->GetSize() > 0,
    "UseImportanceFunction is on, but ImportanceFunction has no points (importance would be "
    "undefined). Add points to the function or turn it off.");
  return Evaluate(function);
}
}
