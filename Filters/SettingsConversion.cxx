// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SettingsConversion.h"

#include "Vectors.h"

#include "vtkPiecewiseFunction.h"
#include "vtkVisibilitySettings.h"

#include "math/Require.h"
#include "optimize/Solver.h"
#include "scene/ViewSet.h"

#include <algorithm>

namespace limpid
{
namespace
{
AmentWeights AmentWeightsOf(vtkVisibilitySettings* settings)
{
  AmentWeights weights;
  weights.exponent = settings->GetAmentExponent();
  weights.regularization = settings->GetAmentRegularization();
  weights.occluders = settings->GetAmentOccluders();
  weights.background = settings->GetAmentBackground();
  weights.lightOccluders = settings->GetAmentLightOccluders();
  weights.lightBackground = settings->GetAmentLightBackground();
  weights.smoothingPasses = settings->GetAmentSmoothing();
  return weights;
}
}

Settings SettingsOf(vtkVisibilitySettings* settings)
{
  Settings result;
  result.method = static_cast<Method>(settings->GetMethod());
  result.ament = AmentWeightsOf(settings);
  result.clearingThreshold = settings->GetClearingThreshold();
  result.weights.regularization = settings->GetRegularizationWeight();
  result.weights.view = settings->GetViewWeight();
  result.weights.light = settings->GetLightWeight();
  result.mode = static_cast<Mode>(settings->GetMode());
  result.solver = static_cast<SolverKind>(settings->GetSolver());
  result.maximumIterations = settings->GetMaximumIterations();
  std::copy_n(settings->GetIterationsPerLevel(), 3, result.iterationsPerLevel.begin());
  result.learningRate = settings->GetLearningRate();
  result.tolerance = settings->GetTolerance();
  result.maximumSeconds = settings->GetMaximumSeconds();
  result.derivative = static_cast<Derivative>(settings->GetDerivative());
  result.rayDensity = settings->GetRayDensity();
  result.skipUnneeded = settings->GetSkipUnneeded() != 0;
  result.restrictToView = settings->GetRestrictToView() != 0;
  result.protectImportance = settings->GetProtectImportance();
  result.emphasis = settings->GetEmphasis();
  result.importanceSmoothing = static_cast<ImportanceSmoothing>(settings->GetImportanceSmoothing());
  result.smoothness = settings->GetSmoothness();
  result.temporalCoherence = settings->GetTemporalCoherence();
  result.backend = static_cast<BackendKind>(settings->GetBackend());
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
