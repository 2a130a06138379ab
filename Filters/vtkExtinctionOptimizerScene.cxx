// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// From the properties of vtkExtinctionOptimizer to the scene and the settings of the core.

#include "vtkExtinctionOptimizerInternals.h"

#include "Choices.h"
#include "Refuse.h"
#include "SceneConversion.h"
#include "ScenePlacement.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"

#include "optimize/Solver.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace
{
limpid::Vec3 ToVec3(const double* vector)
{
  return { vector[0], vector[1], vector[2] };
}
}

void vtkExtinctionOptimizer::Internals::RequireAvailableChoices() const
{
  limpid::RequireChoice("ExtinctionSource", this->Self->ExtinctionSource, 2);
  limpid::RequireChoice("LightType", this->Self->LightType, 2);
  limpid::RequireChoice("Mode", this->Self->Mode, 2);
  limpid::RequireChoice("Solver", this->Self->Solver, 2);
  limpid::RequireChoice("Derivative", this->Self->Derivative, 2);
  limpid::RequireChoice("Backend", this->Self->Backend, 3);
  if (!(this->Self->ScalarOpacityUnitDistance >= 0) ||
    !std::isfinite(this->Self->ScalarOpacityUnitDistance))
  {
    limpid::Refuse("ScalarOpacityUnitDistance is ", this->Self->ScalarOpacityUnitDistance,
      " (opacity is light lost on a distance). Set a length above zero, or zero for the mean "
      "length of a cell.");
  }
  if (this->Self->OptimizeViewpoint)
  {
    limpid::Refuse(
      "OptimizeViewpoint is on (this version optimises the extinction for a given camera "
      "only). Turn it off.");
  }
}

vtkDataArray* vtkExtinctionOptimizer::Internals::FindArray(
  int index, const char* role, const char* fallback, vtkImageData* input, bool& onCells) const
{
  int association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
  vtkDataArray* array = this->Self->GetInputArrayToProcess(index, input, association);
  vtkInformation* chosen = this->Self->GetInputArrayInformation(index);
  const char* name =
    chosen->Has(vtkDataObject::FIELD_NAME()) ? chosen->Get(vtkDataObject::FIELD_NAME()) : nullptr;
  // A script's array property has no name, or its own index, when the input had not been executed
  // before; only ParaView's server manager does that.
  const bool named = name && *name && name != std::to_string(index);
  if (!array && !named)
  {
    array =
      fallback ? input->GetPointData()->GetArray(fallback) : input->GetPointData()->GetScalars();
  }
  if (!array)
  {
    const char* wanted = named ? name : (fallback ? fallback : "(the active scalars)");
    limpid::Refuse("The ", role, " array \"", wanted,
      "\" is not among the input's numeric arrays (the scene cannot be made without it). Choose "
      "one of these: of the points: ",
      limpid::ArrayNames(input->GetPointData()),
      "; of the cells: ", limpid::ArrayNames(input->GetCellData()), ".");
  }
  onCells = association == vtkDataObject::FIELD_ASSOCIATION_CELLS ||
    (association == vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS &&
      input->GetPointData()->GetArray(array->GetName()) != array);
  return array;
}

limpid::FieldSource vtkExtinctionOptimizer::Internals::ImportanceSource(vtkImageData* input) const
{
  limpid::FieldSource source;
  source.array = this->FindArray(1, "importance", "Importance", input, source.onCells);
  source.component = this->Self->ImportanceComponent;
  limpid::RequireComponent("ImportanceComponent", source.array, source.component);
  if (this->Self->UseImportanceFunction)
  {
    if (!this->Self->ImportanceFunction || this->Self->ImportanceFunction->GetSize() == 0)
    {
      limpid::Refuse(
        "UseImportanceFunction is on, but ImportanceFunction has no points (no value would "
        "have an importance). Add points to the function or turn it off.");
    }
    source.mapping = limpid::Evaluate(this->Self->ImportanceFunction);
  }
  return source;
}

limpid::FieldSource vtkExtinctionOptimizer::Internals::ExtinctionOf(
  vtkImageData* input, double unitDistance) const
{
  limpid::FieldSource source;
  if (this->Self->ExtinctionSource == ARRAY)
  {
    source.array = this->FindArray(2, "extinction", "BaseExtinction", input, source.onCells);
    if (source.array->GetNumberOfComponents() != 1)
    {
      limpid::Refuse("The extinction array \"", limpid::NameOf(source.array), "\" has ",
        source.array->GetNumberOfComponents(),
        " components (extinction is one number per point). Choose an array with one component.");
    }
    return source;
  }

  source.array = this->FindArray(0, "scalar", nullptr, input, source.onCells);
  source.component = this->Self->ScalarComponent;
  limpid::RequireComponent("ScalarComponent", source.array, source.component);
  vtkPiecewiseFunction* function = this->Self->ScalarOpacityFunction;
  if (function && function->GetSize() > 0)
  {
    source.mapping = limpid::ExtinctionOfOpacity(limpid::Evaluate(function), unitDistance);
  }
  else
  {
    double low = 0;
    double high = 0;
    limpid::FiniteRange(source.array, source.component, low, high);
    source.mapping = limpid::ExtinctionOfOpacity(limpid::Ramp(low, high), unitDistance);
  }
  return source;
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
    if (!(camera.viewAngle > 0 && camera.viewAngle < 180))
    {
      limpid::Refuse("CameraViewAngle is ", camera.viewAngle,
        " degrees (no distance shows all of the data). Set an angle between 0 and 180 degrees.");
    }
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
  limpid::Settings settings;
  settings.weights.regularization = this->Self->RegularizationWeight;
  settings.weights.view = this->Self->ViewWeight;
  settings.weights.light = this->Self->LightWeight;
  settings.mode = static_cast<limpid::Mode>(this->Self->Mode);
  settings.solver = static_cast<limpid::SolverKind>(this->Self->Solver);
  settings.maximumIterations = this->Self->MaximumIterations;
  std::copy_n(this->Self->IterationsPerLevel, 3, settings.iterationsPerLevel.begin());
  settings.learningRate = this->Self->LearningRate;
  settings.tolerance = this->Self->Tolerance;
  settings.maximumSeconds = this->Self->MaximumSeconds;
  settings.derivative = static_cast<limpid::Derivative>(this->Self->Derivative);
  settings.rayDensity = this->Self->RayDensity;
  settings.skipUnneeded = this->Self->SkipUnneeded != 0;
  settings.restrictToView = this->Self->RestrictToView != 0;
  settings.backend = static_cast<limpid::BackendKind>(this->Self->Backend);
  return settings;
}
