// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Presets_h
#define limpid_optimize_Presets_h

#include "optimize/Settings.h"

#include <string>

namespace limpid
{
/// Settings for a purpose, under one name.
struct SettingsPreset
{
  const char* name;
  Weights weights;
  double clearingThreshold;
  double protectImportance;
  double emphasis;
  ImportanceSmoothing importanceSmoothing;
  double smoothness;
  double temporalCoherence; ///< where views follow each other; a single run has nothing to follow
};

/// All presets. The first is what filters, mapper, display and Python package start with.
inline constexpr SettingsPreset settingsPresets[] = {
  { "Default", { 1e-3, 10, 1 }, 3e-3, 1, 0, ImportanceSmoothing::Median, 0.2, 0.2 },
  { "Keep Context", { 1e-3, 10, 1 }, 0.3, 1, 0, ImportanceSmoothing::Median, 0.2, 0.2 },
  { "Strong Reveal", { 1e-3, 10, 1 }, 3e-4, 0.1, 0, ImportanceSmoothing::Median, 0.2, 0.2 },
  { "Paper", { 1e-3, 10, 1 }, 0, 0, 1, ImportanceSmoothing::Off, 0, 0 },
};

inline constexpr const SettingsPreset& defaultPreset = settingsPresets[0];

/// The preset of that name, in capital letters or not. Throws limpid::Error if there is none.
const SettingsPreset& PresetNamed(const std::string& name);

/// Gives settings the values of a preset.
void Take(const SettingsPreset& preset, Settings& settings);
}

#endif
