// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// From the properties of vtkExtinctionOptimizer to the scene and the settings of the core.

#include "vtkExtinctionOptimizerInternals.h"

#include "Choices.h"
#include "ScenePlacement.h"

#include "math/Require.h"
#include "optimize/Solver.h"

#include <algorithm>

namespace
{
limpid::Vec3 ToVec3(const double* vector)
{
  return { vector[0], vector[1], vector[2] };
}
}

void vtkExtinctionOptimizer::Internals::RequireAvailableChoices() const
{
  this->Reader.RequireChoices();
  limpid::RequireChoice("LightType", this->Self->LightType, 2);
  limpid::RequireChoice("Mode", this->Self->Mode, 2);
  limpid::RequireChoice("Solver", this->Self->Solver, 2);
  limpid::RequireChoice("Derivative", this->Self->Derivative, 2);
  limpid::RequireChoice("ViewpointGuide", this->Self->ViewpointGuide, 2);
}

limpid::Camera vtkExtinctionOptimizer::Internals::MakeCamera(const limpid::Grid& grid) const
{
  limpid::Camera camera;
  camera.position = ToVec3(this->Self->CameraPosition);
  camera.focalPoint = ToVec3(this->Self->CameraFocalPoint);
  camera.viewUp = ToVec3(this->Self->CameraViewUp);
  camera.viewAngle = this->Self->CameraViewAngle;
  camera.parallel = this->Self->CameraParallelProjection != 0;
  camera.parallelScale = this->Self->CameraParallelScale;
  camera.aspect = this->Self->CameraAspectRatio;
  if (this->Self->AutomaticPlacement && limpid::IsUnplaced(camera))
  {
    LIMPID_REQUIRE(camera.viewAngle > 0 && camera.viewAngle < 180,
      "CameraViewAngle is "
        << camera.viewAngle
        << " degrees (no distance shows all of the data). Set an angle between 0 and 180 degrees.");
    limpid::PlaceCamera(grid, camera);
  }
  return camera;
}

limpid::Light vtkExtinctionOptimizer::Internals::MakeLight(const limpid::Camera& camera) const
{
  limpid::Light light;
  light.type = static_cast<limpid::LightType>(this->Self->LightType);
  light.position = ToVec3(this->Self->LightPosition);
  light.focalPoint = camera.focalPoint;
  if (this->Self->AutomaticPlacement && limpid::IsUnplaced(light))
  {
    limpid::PlaceLight(camera, light);
  }
  return light;
}

limpid::Settings vtkExtinctionOptimizer::Internals::MakeSettings() const
{
  limpid::Settings settings = this->Reader.MakeSettings();
  settings.mode = static_cast<limpid::Mode>(this->Self->Mode);
  settings.solver = static_cast<limpid::SolverKind>(this->Self->Solver);
  settings.maximumIterations = this->Self->MaximumIterations;
  std::copy_n(this->Self->IterationsPerLevel, 3, settings.iterationsPerLevel.begin());
  settings.learningRate = this->Self->LearningRate;
  settings.tolerance = this->Self->Tolerance;
  settings.maximumSeconds = this->Self->MaximumSeconds;
  settings.derivative = static_cast<limpid::Derivative>(this->Self->Derivative);
  settings.skipUnneeded = this->Self->SkipUnneeded != 0;
  settings.restrictToView = this->Self->RestrictToView != 0;
  return settings;
}
