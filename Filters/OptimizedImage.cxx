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

#include "math/Require.h"
#include "optimize/ControlledScene.h"
#include "viewpoint/Concurrent.h"
#include "viewpoint/MeetTargets.h"

#include <algorithm>
#include <cmath>
#include <iterator>

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

// Adds the opacity over one unit distance, for volume renderers that expect opacities.
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

// Adds the importance that cannot be seen: g minus the share of its matter that was kept and whose
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

// Adds a column with one value per iteration.
template <class ArrayType, class Member>
void AddColumn(
  const char* name, const OptimizationSummary& summary, const Member& member, vtkTable* table)
{
  vtkNew<ArrayType> column;
  column->SetName(name);
  for (const IterationRecord& record : summary.history)
  {
    column->InsertNextValue(member(record));
  }
  table->AddColumn(column);
}

/// Adds columns with the scores, for optimizations that record them.
void AddScores(const OptimizationSummary& summary, vtkTable* table)
{
  using Record = IterationRecord;
  AddColumn<vtkDoubleArray>(
    "VisibilityScore", summary, [](const Record& record) { return record.score.visibility; },
    table);
  AddColumn<vtkDoubleArray>(
    "VisibleFraction", summary, [](const Record& record) { return record.score.fraction; }, table);
  AddColumn<vtkDoubleArray>(
    "SacrificedFraction", summary, [](const Record& record) { return record.score.sacrificed; },
    table);
  // Ceilings are the same in all rows, so that plots show them beside the scores.
  const Ceiling& ceiling = summary.ceiling;
  AddColumn<vtkDoubleArray>(
    "AttainableScore", summary, [&](const Record&) { return ceiling.visibility; }, table);
  AddColumn<vtkDoubleArray>(
    "AttainableFraction", summary, [&](const Record&) { return ceiling.fraction; }, table);
}
}

const std::vector<std::string>& ResultArrays::All()
{
  static const std::vector<std::string> all{ "Extinction", "LightExtinction", "Opacity",
    "BaseExtinction", "Importance", "Transmittance", "LightTransmittance", "MissedImportance" };
  return all;
}

ResultArrays::ResultArrays(const std::set<std::string>& names)
  : Names(names)
{
  for (const std::string& name : names)
  {
    const bool isKnown = std::find(All().begin(), All().end(), name) != All().end();
    LIMPID_REQUIRE(isKnown,
      "ResultArrays has \"" << name << "\" (there is no such result). Choose of "
                            << ResultArrays({ All().begin(), All().end() }).Text() << '.');
  }
}

ResultArrays ResultArrays::OfSweeps() const
{
  return this->Among({ "Transmittance", "LightTransmittance", "MissedImportance" });
}

ResultArrays ResultArrays::NotInLayers() const
{
  return this->Among(
    { "Transmittance", "LightTransmittance", "MissedImportance", "BaseExtinction", "Importance" });
}

ResultArrays ResultArrays::Among(const std::set<std::string>& names) const
{
  std::set<std::string> both;
  std::set_intersection(this->Names.begin(), this->Names.end(), names.begin(), names.end(),
    std::inserter(both, both.end()));
  return ResultArrays(both);
}

std::string ResultArrays::Text() const
{
  std::string text;
  for (const std::string& name : this->Names)
  {
    text += (text.empty() ? "\"" : ", \"") + name + '"';
  }
  return text;
}

namespace
{
/// Adds the fields of the scene that are here.
void AddInputs(const SceneArrays& arrays, const ResultArrays& wanted, vtkImageData* output)
{
  if (wanted.Has("BaseExtinction") && arrays.baseExtinction)
  {
    output->GetPointData()->AddArray(arrays.baseExtinction);
  }
  if (wanted.Has("Importance") && arrays.importance)
  {
    output->GetPointData()->AddArray(arrays.importance);
  }
}

/// Adds the arrays that every result has. `light`: null: the light has no extinction of its own.
void AddExtinctions(const float* extinction, const float* light, const SceneArrays& arrays,
  double unitDistance, const ResultArrays& wanted, vtkImageData* output)
{
  const vtkIdType count = output->GetNumberOfPoints();
  if (wanted.Has("Extinction"))
  {
    AddCopy("Extinction", extinction, count, output);
  }
  if (light && wanted.Has("LightExtinction"))
  {
    AddCopy("LightExtinction", light, count, output);
  }
  if (wanted.Has("Opacity"))
  {
    AddOpacity(extinction, unitDistance, output);
  }
  AddInputs(arrays, wanted, output);
}
}

void AddFields(const Solver& solver, const SceneArrays& arrays, double unitDistance,
  const ResultArrays& wanted, vtkImageData* output)
{
  const vtkIdType count = output->GetNumberOfPoints();
  const float* extinction = solver.Extinction().data();
  const std::vector<float>& light = solver.LightExtinction();
  AddExtinctions(
    extinction, light.empty() ? nullptr : light.data(), arrays, unitDistance, wanted, output);
  if (wanted.Has("Transmittance") || wanted.Has("MissedImportance"))
  {
    const vtkSmartPointer<vtkFloatArray> transmittance =
      NewArray<vtkFloatArray>("Transmittance", count);
    solver.Transmittance(transmittance->GetPointer(0));
    if (wanted.Has("Transmittance"))
    {
      output->GetPointData()->AddArray(transmittance);
    }
    if (wanted.Has("MissedImportance"))
    {
      AddMissedImportance(arrays, extinction, transmittance->GetPointer(0), output);
    }
  }
  if (wanted.Has("LightTransmittance"))
  {
    const vtkSmartPointer<vtkFloatArray> transmittance =
      NewArray<vtkFloatArray>("LightTransmittance", count);
    solver.LightTransmittance(transmittance->GetPointer(0));
    output->GetPointData()->AddArray(transmittance);
  }
}

std::optional<ScoresOnData> AddFields(ControlledScene& controlled, std::unique_ptr<Solver>& found,
  const SceneArrays& arrays, double unitDistance, bool separate, const ResultArrays& wanted,
  const Progress& progress, vtkImageData* output)
{
  const vtkIdType count = output->GetNumberOfPoints();
  const auto extinction = NewArray<vtkFloatArray>("Extinction", count);
  const auto light = NewArray<vtkFloatArray>("LightExtinction", separate ? count : 0);
  std::optional<ScoresOnData> scores;
  if (controlled.SweepsData(found->Options()))
  {
    scores = controlled.SweepData(std::move(found), progress, extinction->GetPointer(0));
  }
  else
  {
    controlled.FillExtinction(
      *found, extinction->GetPointer(0), separate ? light->GetPointer(0) : nullptr);
  }
  if (wanted.Has("Opacity"))
  {
    AddOpacity(extinction->GetPointer(0), unitDistance, output);
  }
  for (vtkFloatArray* field : { extinction.Get(), light.Get() })
  {
    if (wanted.Has(field->GetName()) && (separate || field == extinction))
    {
      output->GetPointData()->AddArray(field);
    }
  }
  AddInputs(arrays, wanted, output);
  return scores;
}

void AddUnsolvedFields(const SceneArrays& arrays, double unitDistance, bool separate,
  const ResultArrays& wanted, vtkImageData* output)
{
  const float* extinction = arrays.baseExtinction->GetPointer(0);
  AddExtinctions(extinction, separate ? extinction : nullptr, arrays, unitDistance, wanted, output);
  for (const char* name : { "Transmittance", "LightTransmittance" })
  {
    if (wanted.Has(name))
    {
      AddConstant(name, 1, output);
    }
  }
  if (wanted.Has("MissedImportance"))
  {
    AddConstant("MissedImportance", 0, output);
  }
}

OptimizationSummary SummaryOf(const Solver& solver)
{
  OptimizationSummary summary;
  summary.score = solver.BestScore();
  summary.baseScore = solver.BaseScore();
  summary.ceiling = solver.FindCeiling();
  summary.energy = solver.BestEnergy().Total();
  summary.iterations = solver.Iterations();
  summary.settled = solver.Settled();
  summary.seconds = solver.Seconds();
  summary.backend = solver.BackendName();
  summary.history = solver.History();
  return summary;
}

OptimizationSummary SummaryOf(const Solver& onControlGrid, const Solver& onData)
{
  OptimizationSummary summary = SummaryOf(onData);
  summary.iterations = onControlGrid.Iterations();
  summary.settled = onControlGrid.Settled();
  summary.seconds += onControlGrid.Seconds();
  summary.history = onControlGrid.History();
  return summary;
}

void AddSummary(const OptimizationSummary& summary, vtkFieldData* output)
{
  AddValue<vtkDoubleArray>("VisibilityScore", summary.score.visibility, output);
  AddValue<vtkDoubleArray>("BaseVisibilityScore", summary.baseScore.visibility, output);
  AddValue<vtkDoubleArray>("VisibleFraction", summary.score.fraction, output);
  AddValue<vtkDoubleArray>("BaseVisibleFraction", summary.baseScore.fraction, output);
  AddValue<vtkDoubleArray>("SacrificedFraction", summary.score.sacrificed, output);
  AddValue<vtkDoubleArray>("AttainableFraction", summary.ceiling.fraction, output);
  AddValue<vtkDoubleArray>("AttainableScore", summary.ceiling.visibility, output);
  AddValue<vtkDoubleArray>("AttainableLightScore", summary.ceiling.lightVisibility, output);
  AddValue<vtkDoubleArray>("Energy", summary.energy, output);
  AddValue<vtkIntArray>("ControlFactor", summary.controlFactor, output);
  AddValue<vtkIntArray>("Iterations", summary.iterations, output);
  AddValue<vtkIntArray>("Settled", summary.settled ? 1 : 0, output);
  AddValue<vtkDoubleArray>("Seconds", summary.seconds, output);
  AddValue<vtkStringArray>("Backend", summary.backend, output);
}

void AddTargets(const TargetsFound& found, vtkFieldData* output)
{
  AddValue<vtkStringArray>("Targets", found.text, output);
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

void FillConvergence(const OptimizationSummary& summary, vtkTable* table)
{
  using Record = IterationRecord;
  AddColumn<vtkIntArray>(
    "Iteration", summary, [](const Record& record) { return record.iteration; }, table);
  AddColumn<vtkIntArray>(
    "Level", summary, [](const Record& record) { return record.level; }, table);
  AddColumn<vtkDoubleArray>(
    "Energy", summary, [](const Record& record) { return record.energy.Total(); }, table);
  AddColumn<vtkDoubleArray>(
    "RegularizationEnergy", summary,
    [](const Record& record) { return record.energy.regularization; }, table);
  AddColumn<vtkDoubleArray>(
    "ViewEnergy", summary, [](const Record& record) { return record.energy.view; }, table);
  AddColumn<vtkDoubleArray>(
    "LightEnergy", summary, [](const Record& record) { return record.energy.light; }, table);
  AddScores(summary, table);
  AddColumn<vtkDoubleArray>(
    "Seconds", summary, [](const Record& record) { return record.seconds; }, table);
}
}
