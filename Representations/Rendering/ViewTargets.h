// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The targets of structures in one view, over several frames.

#ifndef limpid_ViewTargets_h
#define limpid_ViewTargets_h

#include "VolumeData.h"

#include "optimize/TargetSearch.h"

#include <optional>
#include <string>
#include <vector>

namespace limpid
{
/// Which importances of structures an optimisation has, so that targets are met. Without targets
/// they are those given.
class ViewTargets
{
public:
  /// Takes the structures of the data, with the importances given.
  void TakeStructures(const VolumeData& data);

  /// Takes the settings of a view that has changed, and returns those to optimise it with. The
  /// importances found for the last view are the first that are tried.
  Settings TakeSettings(const Settings& given);

  /// Returns the settings to optimise the view with, whose settings may have changed.
  Settings SettingsFor(const Settings& given);

  /// Whether the result of the optimisation has to be judged, once it is complete.
  bool AreOpen() const { return this->IsOpen; }

  /// Takes the shares of a complete result. Returns whether to optimise again, with Scene() and
  /// TriedSettings().
  bool Judge(std::vector<StructureShares> shares);

  /// Returns the scene with the importances to try. Valid until the next call of it.
  SceneFields Scene(const VolumeData& data);
  Settings TriedSettings() const { return this->Search->TriedSettings(); }

  /// Returns the structures with the importances that are tried; null: those given are.
  const Structures* Tried() const { return this->Search ? &this->Search->Tried() : nullptr; }

  /// Raises ceilings as Judge does. `shares`: from the camera of the view.
  void RaiseCeilings(std::vector<StructureShares>& shares) const;

  /// Returns a warning about targets that are not met; may be empty.
  const std::string& Warning() const { return this->Unmet; }

private:
  std::optional<TargetSearch> Search; ///< none: there are no targets
  std::optional<Settings> Given;      ///< of the view; none: it is new
  std::vector<float> Importance;      ///< that is tried, at the nodes; empty: as given
  bool IsOpen = false;
  std::string Unmet;
};
}

#endif
