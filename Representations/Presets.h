// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Presets of an Optimized Volume: values of its properties under one name.

#ifndef limpid_Presets_h
#define limpid_Presets_h

#include <map>
#include <string>
#include <vector>

class vtkSMProxy;

namespace limpid
{
struct Preset
{
  std::string name;
  std::map<std::string, double> values; ///< of properties with one number, by their names
};

/**
 * The presets of a volume (an OptimizedVolumeRepresentation), from the hints of its property
 * "Preset":
 *
 *   <Preset name="Paper">
 *     <Value property="ProtectImportance" value="0"/>
 *   </Preset>
 *
 * A property that any preset names belongs to all of them: where a preset does not name it, it has
 * its default. Properties that the volume lacks are left out.
 */
std::vector<Preset> ReadPresets(vtkSMProxy* volume);

/// The first preset whose values a volume has, or null.
const Preset* FindPreset(const std::vector<Preset>& presets, vtkSMProxy* volume);

/// The preset of that name, or null.
const Preset* FindPreset(const std::vector<Preset>& presets, const std::string& name);

/// The names of all presets, for a message.
std::string NamesOf(const std::vector<Preset>& presets);

/// Gives a volume the values, and pushes them.
void Apply(const Preset& preset, vtkSMProxy* volume);
}

#endif
