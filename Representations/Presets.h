// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The presets of the core as values of a proxy's properties.

#ifndef limpid_Presets_h
#define limpid_Presets_h

#include <string>
#include <utility>
#include <vector>

class vtkSMProxy;

namespace limpid
{
struct Preset
{
  std::string name;

  /// Values of properties with one number, by their names, in the order in which they are to be
  /// set.
  std::vector<std::pair<std::string, double>> values;
};

/// The presets for a display or filter, without the properties that it lacks.
std::vector<Preset> PresetsFor(vtkSMProxy* proxy);

/// The first preset whose values a proxy has, or null.
const Preset* FindPreset(const std::vector<Preset>& presets, vtkSMProxy* proxy);

/// The preset of that name, in capital letters or not, or null.
const Preset* FindPreset(const std::vector<Preset>& presets, const std::string& name);

/// The names of all presets, for a message.
std::string NamesOf(const std::vector<Preset>& presets);

/// Gives a proxy the values, and pushes them.
void Apply(const Preset& preset, vtkSMProxy* proxy);
}

#endif
