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

  /// Values of properties with one number, by name, in the order in which to set them.
  std::vector<std::pair<std::string, double>> values;
};

/// Returns the presets for a display or filter, without properties that it does not have.
std::vector<Preset> PresetsFor(vtkSMProxy* proxy);

/// Returns the first preset whose values equal those of a proxy, or null.
const Preset* FindPreset(const std::vector<Preset>& presets, vtkSMProxy* proxy);

/// Returns the preset of that name (case-insensitive), or null.
const Preset* FindPreset(const std::vector<Preset>& presets, const std::string& name);

/// Returns the names of all presets, for a message.
std::string NamesOf(const std::vector<Preset>& presets);

/// Sets the values on a proxy and pushes them.
void Apply(const Preset& preset, vtkSMProxy* proxy);
}

#endif
