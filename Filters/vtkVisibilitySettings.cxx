// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkVisibilitySettings.h"

#include "PropertyPrinter.h"

#include "vtkObjectFactory.h"
#include "vtkPiecewiseFunction.h"

#include "optimize/Presets.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <limits>
#include <locale>
#include <sstream>

vtkStandardNewMacro(vtkVisibilitySettings);
vtkCxxSetObjectMacro(vtkVisibilitySettings, ImportanceFunction, vtkPiecewiseFunction);

double limpid::Clamped(
  vtkObject* owner, const char* property, double value, double least, double most)
{
  if (!std::isfinite(value) || (value >= least && value <= most))
  {
    return value;
  }
  const double nearest = value < least ? least : most;
  std::ostringstream range;
  range << least;
  if (most < VTK_INT_MAX)
  {
    range << " to " << most;
  }
  else
  {
    range << " or more";
  }
  vtkWarningWithObjectMacro(owner, << property << " is " << value
                                   << " (this is outside the valid range). It was clamped to "
                                   << nearest << "; set it to " << range.str() << ".");
  return nearest;
}

vtkVisibilitySettings::vtkVisibilitySettings()
{
  this->SetPreset(limpid::defaultPreset.name);
}

vtkVisibilitySettings::~vtkVisibilitySettings()
{
  this->SetImportanceFunction(nullptr);
}

void vtkVisibilitySettings::SetIterationsPerLevel(int quarter, int half, int full)
{
  const int given[3] = { quarter, half, full };
  int iterations[3];
  std::transform(given, given + 3, iterations,
    [this](int count) {
      return static_cast<int>(limpid::Clamped(this, "IterationsPerLevel", count, 0, VTK_INT_MAX));
    });
  if (!std::equal(iterations, iterations + 3, this->IterationsPerLevel))
  {
    std::copy(iterations, iterations + 3, this->IterationsPerLevel);
    this->Modified();
  }
}

void vtkVisibilitySettings::SetRegularizationWeight(double given)
{
  const double weight = limpid::Clamped(this, "RegularizationWeight", given, 0, VTK_DOUBLE_MAX);
  if (weight != this->RegularizationWeight)
  {
    this->RegularizationWeight = weight;
    this->ClearingThreshold = 0;
    this->Modified();
  }
}

bool vtkVisibilitySettings::SetPreset(const char* name)
{
  try
  {
    const std::string wanted = name ? name : "";
    const limpid::SettingsPreset& preset = limpid::PresetNamed(wanted);
    this->SetRegularizationWeight(preset.weights.regularization);
    this->SetClearingThreshold(preset.clearingThreshold);
    this->SetViewWeight(preset.weights.view);
    this->SetLightWeight(preset.weights.light);
    this->SetProtectImportance(preset.protectImportance);
    this->SetEmphasis(preset.emphasis);
    this->SetImportanceSmoothing(static_cast<int>(preset.importanceSmoothing));
    this->SetSmoothness(preset.smoothness);
    this->SetTemporalCoherence(preset.temporalCoherence);
    return true;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return false;
  }
}

int vtkVisibilitySettings::GetNumberOfPresets()
{
  return static_cast<int>(std::size(limpid::settingsPresets));
}

const char* vtkVisibilitySettings::GetPresetName(int index)
{
  const bool isThere = index >= 0 && index < vtkVisibilitySettings::GetNumberOfPresets();
  return isThere ? limpid::settingsPresets[index].name : nullptr;
}

void vtkVisibilitySettings::AddStructure(
  const char* label, const char* name, const char* importance, const char* target)
{
  const auto text = [](const char* given) { return std::string(given ? given : ""); };
  this->StructureTexts.push_back({ text(label), text(name), text(importance), text(target) });
  this->StructuresTime.Modified();
  this->Modified();
}

void vtkVisibilitySettings::AddStructure(
  vtkIdType label, const char* name, double importance, double target)
{
  const auto text = [](double number)
  {
    std::ostringstream stream;
    stream.imbue(std::locale::classic());
    stream.precision(std::numeric_limits<double>::max_digits10);
    stream << number;
    return stream.str();
  };
  this->AddStructure(std::to_string(label).c_str(), name, text(importance).c_str(),
    target < 0 ? "" : text(target).c_str());
}

void vtkVisibilitySettings::RemoveAllStructures()
{
  if (!this->StructureTexts.empty())
  {
    this->StructureTexts.clear();
    this->StructuresTime.Modified();
    this->Modified();
  }
}

int vtkVisibilitySettings::GetNumberOfStructures()
{
  return static_cast<int>(this->StructureTexts.size());
}

const char* vtkVisibilitySettings::GetStructureText(int row, int column)
{
  const bool isThere = row >= 0 && row < this->GetNumberOfStructures() && column >= 0 && column < 4;
  return isThere
    ? this->StructureTexts[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)].c_str()
    : nullptr;
}

vtkMTimeType vtkVisibilitySettings::GetMTime()
{
  const vtkMTimeType time = this->Superclass::GetMTime();
  return this->ImportanceFunction ? std::max(time, this->ImportanceFunction->GetMTime()) : time;
}

void vtkVisibilitySettings::PrintSelf(ostream& os, vtkIndent indent)
{
  const limpid::PropertyPrinter print{ os, indent };

  this->Superclass::PrintSelf(os, indent);
#define LIMPID_PRINT(name) print(#name, this->name);
  LIMPID_EVERY_VISIBILITY_SETTING(LIMPID_PRINT);
#undef LIMPID_PRINT
  print("NumberOfStructures", this->GetNumberOfStructures());
}
