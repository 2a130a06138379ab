// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Presets_h
#define limpid_optimize_Presets_h

#include "optimize/Settings.h"

#include <string>

namespace limpid
{
/// Named settings for one purpose.
struct SettingsPreset
{
  const char* name;
  Weights weights;
  double clearingThreshold;
  double protectImportance;
  double emphasis;
  ImportanceSmoothing importanceSmoothing;
  double smoothness;
  double temporalCoherence; ///< for sequences of views; no effect on a single run
};

/// All presets. The first one is the default of filters, mapper, display and Python package.
inline constexpr SettingsPreset settingsPresets[] = {
  { "Default", { 1e-3, 10, 1 }, 3e-3, 1, 0, ImportanceSmoothing::Median, 0.2, 0.2 },
  { "Keep Context", { 1e-3, 10, 1 }, 0.3, 1, 0, ImportanceSmoothing::Median, 0.2, 0.2 },
  { "Strong Reveal", { 1e-3, 10, 1 }, 3e-4, 0.1, 0, ImportanceSmoothing::Median, 0.2, 0.2 },
  { "Paper", { 1e-3, 10, 1 }, 0, 0, 1, ImportanceSmoothing::Off, 0, 0 },
};

inline constexpr const SettingsPreset& defaultPreset = settingsPresets[0];

/// Returns the preset of a name, ignoring case. Throws limpid::Error if there is none.
const SettingsPreset& PresetNamed(const std::string& name);

/// Copies the values of a preset to settings.
void Take(const SettingsPreset& preset, Settings& settings);
}

#endif
