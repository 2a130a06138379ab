// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "OptimizedImage.h"

#include "AllCores.h"
#include "FieldValues.h"
#include "Memory.h"
#include "SceneConversion.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include "optimize/Solver.h"
#include "viewpoint/Concurrent.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
void AddCopy(const char* name, const float* values, vtkIdType count, vtkImageData* output)
{
  const vtkSmartPointer<vtkFloatArray> field = NewArray<vtkFloatArray>(name, count);
  float* copy = field->GetPointer(0);
  ForOnAllCores(count,
    [=](vtkIdType begin, vtkIdType end) { std::copy(values + begin, values + end, copy + begin); });
  output->GetPointData()->AddArray(field);
}

void AddConstant(const char* name, float value, vtkImageData* output)
{
  const vtkSmartPointer<vtkFloatArray> field =
    NewArray<vtkFloatArray>(name, output->GetNumberOfPoints());
  field->FillValue(value);
  output->GetPointData()->AddArray(field);
}

// Opacity of one unit distance, for volume renderers that want opacities.
void AddOpacity(const float* extinction, double unitDistance, vtkImageData* output)
{
  const vtkSmartPointer<vtkFloatArray> field =
    NewArray<vtkFloatArray>("Opacity", output->GetNumberOfPoints());
  float* opacity = field->GetPointer(0);
  const auto distance = static_cast<float>(unitDistance);
  ForOnAllCores(field->GetNumberOfTuples(),
    [=](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        opacity[i] = -std::expm1(-extinction[i] * distance);
      }
    });
  output->GetPointData()->AddArray(field);
}

// Of the importance, what cannot be seen: g less the share of its matter that was kept and whose
// light reaches the camera (energy/Score.h).
void AddMissedImportance(const SceneArrays& arrays, const float* extinction,
  const float* transmittance, vtkImageData* output)
{
  const vtkSmartPointer<vtkFloatArray> field =
    NewArray<vtkFloatArray>("MissedImportance", output->GetNumberOfPoints());
  float* missed = field->GetPointer(0);
  const float* base = arrays.baseExtinction->GetPointer(0);
  const float* importance = arrays.importance->GetPointer(0);
  ForOnAllCores(field->GetNumberOfTuples(),
    [=](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const float kept = extinction[i] < base[i] ? extinction[i] / base[i] : 1.0f;
        missed[i] = base[i] > 0 ? importance[i] * (1 - kept * transmittance[i]) : 0.0f;
      }
    });
  output->GetPointData()->AddArray(field);
}

// A column of a table with one row per iteration.
template <class ArrayType, class Member>
void AddColumn(const char* name, const Solver& solver, const Member& member, vtkTable* table)
{
  vtkNew<ArrayType> column;
  column->SetName(name);
  for (const IterationRecord& record : solver.History())
  {
    column->InsertNextValue(member(record));
  }
  table->AddColumn(column);
}

/// Of iterations that tell them.
void AddScores(const Solver& solver, vtkTable* table)
{
  using Record = IterationRecord;
  AddColumn<vtkDoubleArray>(
    "VisibilityScore", solver, [](const Record& record) { return record.score.visibility; }, table);
  AddColumn<vtkDoubleArray>(
    "VisibleFraction", solver, [](const Record& record) { return record.score.fraction; }, table);
  AddColumn<vtkDoubleArray>(
    "SacrificedFraction", solver, [](const Record& record) { return record.score.sacrificed; },
    table);
  // The same in all rows, to be drawn beside the others.
  const Ceiling ceiling = solver.FindCeiling();
  AddColumn<vtkDoubleArray>(
    "AttainableScore", solver, [&](const Record&) { return ceiling.visibility; }, table);
  AddColumn<vtkDoubleArray>(
    "AttainableFraction", solver, [&](const Record&) { return ceiling.fraction; }, table);
}
}

void AddFields(
  const Solver& solver, const SceneArrays& arrays, double unitDistance, vtkImageData* output)
{
  const vtkIdType count = output->GetNumberOfPoints();
  const float* extinction = solver.Extinction().data();
  AddCopy("Extinction", extinction, count, output);
  if (!solver.LightExtinction().empty())
  {
    AddCopy("LightExtinction", solver.LightExtinction().data(), count, output);
  }
  AddOpacity(extinction, unitDistance, output);
  output->GetPointData()->AddArray(arrays.baseExtinction);
  output->GetPointData()->AddArray(arrays.importance);

  const vtkSmartPointer<vtkFloatArray> transmittance =
    NewArray<vtkFloatArray>("Transmittance", count);
  solver.Transmittance(transmittance->GetPointer(0));
  output->GetPointData()->AddArray(transmittance);
  AddMissedImportance(arrays, extinction, transmittance->GetPointer(0), output);
  const vtkSmartPointer<vtkFloatArray> lightTransmittance =
    NewArray<vtkFloatArray>("LightTransmittance", count);
  solver.LightTransmittance(lightTransmittance->GetPointer(0));
  output->GetPointData()->AddArray(lightTransmittance);
}

void AddUnsolvedFields(const SceneArrays& arrays, double unitDistance, vtkImageData* output)
{
  const float* extinction = arrays.baseExtinction->GetPointer(0);
  AddCopy("Extinction", extinction, output->GetNumberOfPoints(), output);
  AddOpacity(extinction, unitDistance, output);
  output->GetPointData()->AddArray(arrays.baseExtinction);
  output->GetPointData()->AddArray(arrays.importance);
  AddConstant("Transmittance", 1, output);
  AddConstant("LightTransmittance", 1, output);
  AddConstant("MissedImportance", 0, output);
}

void AddSummary(const Solver& solver, vtkFieldData* output)
{
  AddValue<vtkDoubleArray>("VisibilityScore", solver.BestScore().visibility, output);
  AddValue<vtkDoubleArray>("BaseVisibilityScore", solver.BaseScore().visibility, output);
  AddValue<vtkDoubleArray>("VisibleFraction", solver.BestScore().fraction, output);
  AddValue<vtkDoubleArray>("BaseVisibleFraction", solver.BaseScore().fraction, output);
  AddValue<vtkDoubleArray>("SacrificedFraction", solver.BestScore().sacrificed, output);
  const Ceiling ceiling = solver.FindCeiling();
  AddValue<vtkDoubleArray>("AttainableFraction", ceiling.fraction, output);
  AddValue<vtkDoubleArray>("AttainableScore", ceiling.visibility, output);
  AddValue<vtkDoubleArray>("AttainableLightScore", ceiling.lightVisibility, output);
  AddValue<vtkDoubleArray>("Energy", solver.BestEnergy().Total(), output);
  AddValue<vtkIntArray>("Iterations", solver.Iterations(), output);
  AddValue<vtkIntArray>("Settled", solver.Settled() ? 1 : 0, output);
  AddValue<vtkDoubleArray>("Seconds", solver.Seconds(), output);
  AddValue<vtkStringArray>("Backend", solver.BackendName(), output);
}

void AddViewpoint(const ConcurrentResult& result, vtkFieldData* output)
{
  if (result.startScore)
  {
    AddValue<vtkDoubleArray>("StartVisibilityScore", result.startScore->visibility, output);
    AddValue<vtkDoubleArray>("StartVisibleFraction", result.startScore->fraction, output);
  }
  if (result.highestCeiling > 0)
  {
    AddValue<vtkDoubleArray>("HighestAttainableFraction", result.highestCeiling, output);
    AddValue<vtkStringArray>("Proof", result.Proof(), output);
  }
}

void AddPlacement(
  const Camera& camera, const Light& light, double unitDistance, vtkFieldData* output)
{
  AddVector("CameraPosition", camera.position, output);
  AddVector("CameraFocalPoint", camera.focalPoint, output);
  AddVector("CameraViewUp", camera.viewUp, output);
  AddVector("LightPosition", light.position, output);
  AddValue<vtkDoubleArray>("ScalarOpacityUnitDistance", unitDistance, output);
}

void FillConvergence(const Solver& solver, vtkTable* table)
{
  using Record = IterationRecord;
  AddColumn<vtkIntArray>(
    "Iteration", solver, [](const Record& record) { return record.iteration; }, table);
  AddColumn<vtkIntArray>(
    "Level", solver, [](const Record& record) { return record.level; }, table);
  AddColumn<vtkDoubleArray>(
    "Energy", solver, [](const Record& record) { return record.energy.Total(); }, table);
  AddColumn<vtkDoubleArray>(
    "RegularizationEnergy", solver,
    [](const Record& record) { return record.energy.regularization; }, table);
  AddColumn<vtkDoubleArray>(
    "ViewEnergy", solver, [](const Record& record) { return record.energy.view; }, table);
  AddColumn<vtkDoubleArray>(
    "LightEnergy", solver, [](const Record& record) { return record.energy.light; }, table);
  AddScores(solver, table);
  AddColumn<vtkDoubleArray>(
    "Seconds", solver, [](const Record& record) { return record.seconds; }, table);
}
}
