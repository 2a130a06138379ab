// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_TargetSearch_h
#define limpid_optimize_TargetSearch_h

#include "energy/StructureLedger.h"
#include "math/BroydenSteps.h"
#include "optimize/Settings.h"
#include "scene/Structures.h"

#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace limpid
{
/// What has become of the target share of a structure.
enum class TargetState
{
  None,   ///< it has no target, or there is nothing to see of it
  Met,    ///< it is visible as much as wanted, but for what a text with a digit does not tell
  Missed, ///< its ceiling allows the target, other targets or the grid do not
  Refused ///< no opacity can meet the target from this camera
};

TargetState StateOf(const Structure& structure, const StructureShares& shares);

/// Returns the names of the structures whose target is in a state, in quotes; may be empty.
std::string NamesIn(
  TargetState state, const Structures& structures, const std::vector<StructureShares>& shares);

/// Says that structures have lost their protection.
extern const char* const protectionIsLost;

/// Returns what is visible of a structure, and what of it could be: "tumour 95.2 % (>= 95.0 %)",
/// "vessels 58.0 % of at most 61.0 % (target 60.0 %)", without a target "liver 18.7 % of at most
/// 18.9 %".
std::string TextOf(const Structure& structure, const StructureShares& shares);

/// Returns one line about all targets, see TextOf. `shares`: of all structures, in the order of
/// their rows.
std::string TextOfTargets(const Structures& structures, const std::vector<StructureShares>& shares);

/**
 * Finds importances of structures with which they are visible as much as their targets ask
 * (Documentation/Method.md, section on structures). Logarithms of importances are moved by
 * Broyden's method until the logits of shares are those of the targets, or above them where an
 * importance cannot become smaller. An importance above 1 stands for larger weights of the energy
 * and smaller importances of all other structures. If that does not meet the targets, important
 * structures are no longer protected.
 */
class TargetSearch
{
public:
  static constexpr int mostRuns = 20;

  /// `settings`: those given.
  TargetSearch(const Structures& wanted, const Settings& settings);

  /// Returns a search with other settings or from another camera, which begins with the importances
  /// tried last.
  TargetSearch Again(const Settings& settings) const;

  /// The structures with the importances to try. At first those given.
  const Structures& Tried() const { return this->Now; }

  /// Returns the settings to try them with. At first those given.
  Settings TriedSettings() const;

  /// Whether structures are protected as the settings ask.
  bool KeepsProtection() const { return this->Protects; }

  /// Raises ceilings to those of the first run: more important structures are protected more, and
  /// hide more of themselves. `shares`: from the camera of the search.
  void RaiseCeilings(std::vector<StructureShares>& shares) const;

  /// Takes the shares that were found with Tried(), and raises their ceilings. Returns whether to
  /// try others; if not, Tried() is the best that was found.
  bool Next(std::vector<StructureShares>& shares);

private:
  /// A structure with a target.
  struct Aim
  {
    std::size_t index; ///< of the structure
    double target;
    double importance; ///< to try; may exceed 1
    double best;       ///< the best that was tried
  };

  double ShortfallOf(const std::vector<StructureShares>& shares) const;
  void Begin(const std::vector<StructureShares>& shares);
  void Ascend(const std::vector<StructureShares>& shares);
  void GoToBest();
  void Apply();

  Structures Wanted;
  Settings Given;
  Structures Now;
  double Excess = 1; ///< the largest importance to try, at least 1
  std::vector<Aim> Aims;
  std::vector<double> Ceilings;        ///< of all structures, of the first run
  std::unique_ptr<BroydenSteps> Steps; ///< null before the first
  int Runs = 0;
  int BestRun = 0;
  int StageStart = 0; ///< last run before the structures lost their protection
  bool Protects = true;
  bool BestProtects = true;
  double LeastShortfall = std::numeric_limits<double>::max();
  bool Repeats = false; ///< whether the best is tried again, as the last run
};
}

#endif
