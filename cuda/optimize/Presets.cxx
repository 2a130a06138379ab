// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Presets.h"

#include "math/Require.h"

#include <algorithm>
#include <cctype>
#include <iterator>

namespace limpid
{
namespace
{
std::string Lower(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

std::string AllNames()
{
  std::string names;
  for (const SettingsPreset& preset : settingsPresets)
  {
    names += (names.empty() ? "" : ", ") + std::string(preset.name);
  }
  return names;
}
}

const SettingsPreset& PresetNamed(const std::string& name)
{
  const auto* const found = std::find_if(std::begin(settingsPresets), std::end(settingsPresets),
    [wanted = Lower(name)](const SettingsPreset& preset) { return Lower(preset.name) == wanted; });
  LIMPID_REQUIRE(found != std::end(settingsPresets),
    "There is no preset \"" << name << "\" (no setting was changed). Choose one of these: "
                            << AllNames() << ".");
  return *found;
}

void Take(const SettingsPreset& preset, Settings& settings)
{
  settings.weights = preset.weights;
  settings.clearingThreshold = preset.clearingThreshold;
  settings.protectImportance = preset.protectImportance;
  settings.emphasis = preset.emphasis;
  settings.importanceSmoothing = preset.importanceSmoothing;
  settings.smoothness = preset.smoothness;
  settings.temporalCoherence = preset.temporalCoherence;
}
}
