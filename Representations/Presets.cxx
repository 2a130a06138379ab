// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Presets.h"

#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSessionProxyManager.h"

#include "optimize/Presets.h"

#include <vtksys/SystemTools.hxx>

#include <algorithm>

namespace limpid
{
namespace
{
double Value(vtkSMProxy* proxy, const std::string& property)
{
  return vtkSMPropertyHelper(proxy, property.c_str()).GetAsDouble();
}

std::vector<std::pair<std::string, double>> ValuesOf(const SettingsPreset& preset)
{
  return { { "RegularizationWeight", preset.weights.regularization },
    { "ClearingThreshold", preset.clearingThreshold }, { "ViewWeight", preset.weights.view },
    { "LightWeight", preset.weights.light }, { "ProtectImportance", preset.protectImportance },
    { "Emphasis", preset.emphasis },
    { "ImportanceSmoothing", static_cast<double>(preset.importanceSmoothing) },
    { "Smoothness", preset.smoothness }, { "TemporalCoherence", preset.temporalCoherence } };
}
}

std::vector<Preset> PresetsFor(vtkSMProxy* proxy)
{
  vtkSMProxy* prototype =
    proxy->GetSessionProxyManager()->GetPrototypeProxy(proxy->GetXMLGroup(), proxy->GetXMLName());
  std::vector<Preset> presets;
  for (const SettingsPreset& settings : settingsPresets)
  {
    Preset preset{ settings.name, {} };
    for (const auto& [name, value] : ValuesOf(settings))
    {
      if (proxy->GetProperty(name.c_str()))
      {
        // Filters keep these off by default, hence in every preset.
        const bool isOptional = name == "TemporalCoherence" || name == "Smoothness";
        const bool isLeftOut = isOptional && Value(prototype, name) == 0;
        preset.values.emplace_back(name, isLeftOut ? 0.0 : value);
      }
    }
    presets.push_back(preset);
  }
  return presets;
}

const Preset* FindPreset(const std::vector<Preset>& presets, vtkSMProxy* proxy)
{
  const auto isThere = [proxy](const Preset& preset)
  {
    return std::all_of(preset.values.begin(), preset.values.end(),
      [proxy](const auto& entry) { return Value(proxy, entry.first) == entry.second; });
  };
  const auto found = std::find_if(presets.begin(), presets.end(), isThere);
  return found == presets.end() ? nullptr : &*found;
}

const Preset* FindPreset(const std::vector<Preset>& presets, const std::string& name)
{
  const auto found = std::find_if(presets.begin(), presets.end(),
    [&name](const Preset& preset)
    { return vtksys::SystemTools::Strucmp(preset.name.c_str(), name.c_str()) == 0; });
  return found == presets.end() ? nullptr : &*found;
}

std::string NamesOf(const std::vector<Preset>& presets)
{
  std::string names;
  for (const Preset& preset : presets)
  {
    names += (names.empty() ? "" : ", ") + preset.name;
  }
  return names;
}

void Apply(const Preset& preset, vtkSMProxy* proxy)
{
  for (const auto& [property, value] : preset.values)
  {
    vtkSMPropertyHelper(proxy, property.c_str()).Set(value);
  }
  proxy->UpdateVTKObjects();
}
}
