// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/TargetSearch.h"

#include "math/PercentText.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
constexpr double tolerance = 0.001;  ///< a share that much below its target meets it
constexpr double aimedAbove = 0.002; ///< what is aimed at above a target
constexpr double leastGain = 0.0005; ///< of the shortfall, for the search to go on
constexpr int mostProtectedRuns = 10;

/// Number of runs without a gain, after which a search ends. Without protection structures hide
/// each other more, and the first steps are worse.
constexpr int MostRunsInVain(bool protects)
{
  return protects ? 3 : 6;
}

double LogitOf(double share)
{
  const double kept = std::clamp(share, 1e-4, 1 - 1e-4); // one step cannot be too large
  return std::log(kept / (1 - kept));
}
}

TargetState StateOf(const Structure& structure, const StructureShares& shares)
{
  if (!structure.target || !(shares.important > 0))
  {
    return TargetState::None;
  }
  if (shares.visible >= *structure.target - tolerance)
  {
    return TargetState::Met;
  }
  return *structure.target > shares.attainable ? TargetState::Refused : TargetState::Missed;
}

std::string NamesIn(
  TargetState state, const Structures& structures, const std::vector<StructureShares>& shares)
{
  std::string names;
  for (std::size_t i = 0; i < shares.size(); ++i)
  {
    const Structure& structure = structures.At(static_cast<StructureRow>(i + 1));
    if (StateOf(structure, shares[i]) == state)
    {
      names += (names.empty() ? "\"" : ", \"") + structure.NameOrLabel() + "\"";
    }
  }
  return names;
}

const char* const protectionIsLost =
  "ProtectImportance is not used (less would be visible of structures with targets). Lower the "
  "targets to keep important structures whole.";

std::string TextOf(const Structure& structure, const StructureShares& shares)
{
  std::string text = structure.NameOrLabel() + " " + PercentText(shares.visible);
  if (StateOf(structure, shares) == TargetState::Met)
  {
    return text + " (>= " + PercentText(*structure.target) + ")";
  }
  text += " of at most " + PercentText(shares.attainable);
  return structure.target ? text + " (target " + PercentText(*structure.target) + ")" : text;
}

std::string TextOfTargets(const Structures& structures, const std::vector<StructureShares>& shares)
{
  std::string text;
  for (std::size_t i = 0; i < shares.size(); ++i)
  {
    const Structure& structure = structures.At(static_cast<StructureRow>(i + 1));
    if (StateOf(structure, shares[i]) != TargetState::None)
    {
      text += (text.empty() ? "" : ", ") + TextOf(structure, shares[i]);
    }
  }
  return text;
}

TargetSearch::TargetSearch(const Structures& wanted, const Settings& settings)
  : Wanted(wanted)
  , Given(settings)
  , Now(wanted)
{
  for (std::size_t i = 0; i < wanted.Count(); ++i)
  {
    const Structure& structure = wanted.At(static_cast<StructureRow>(i + 1));
    if (structure.target)
    {
      this->Aims.push_back({ i, *structure.target, structure.importance, structure.importance });
    }
  }
}

Settings TargetSearch::TriedSettings() const
{
  Settings settings = this->Given;
  settings.weights.view *= this->Excess;
  settings.weights.light *= this->Excess;
  // The following are relative to those weights.
  settings.clearingThreshold /= this->Excess;
  settings.smoothness /= this->Excess;
  settings.temporalCoherence /= this->Excess;
  settings.referencePull /= this->Excess;
  settings.protectImportance *= this->Protects ? 1 : 0;
  return settings;
}

double TargetSearch::ShortfallOf(const std::vector<StructureShares>& shares) const
{
  double shortfall = 0;
  for (const Aim& aim : this->Aims)
  {
    shortfall = std::max(shortfall, aim.target - shares[aim.index].visible);
  }
  return shortfall;
}

TargetSearch TargetSearch::Again(const Settings& settings) const
{
  TargetSearch other(this->Wanted, settings);
  for (Aim& aim : other.Aims)
  {
    aim.importance =
      this->Excess * this->Now.ImportanceOf(static_cast<StructureRow>(aim.index + 1));
  }
  other.Protects = this->Protects;
  other.Apply();
  return other;
}

/// Takes the shares of the first run, of which no target above its ceiling is aimed at.
void TargetSearch::Begin(const std::vector<StructureShares>& shares)
{
  for (const StructureShares& found : shares)
  {
    this->Ceilings.push_back(found.attainable);
  }
  const auto isRefused = [&shares](const Aim& aim)
  { return aim.target > shares[aim.index].attainable; };
  this->Aims.erase(
    std::remove_if(this->Aims.begin(), this->Aims.end(), isRefused), this->Aims.end());
  this->Steps = std::make_unique<BroydenSteps>(this->Aims.size());
}

void TargetSearch::RaiseCeilings(std::vector<StructureShares>& shares) const
{
  for (std::size_t i = 0; i < std::min(shares.size(), this->Ceilings.size()); ++i)
  {
    shares[i].attainable = std::max(shares[i].attainable, this->Ceilings[i]);
  }
}

bool TargetSearch::Next(std::vector<StructureShares>& shares)
{
  ++this->Runs;
  if (!this->Steps)
  {
    this->Begin(shares);
  }
  this->RaiseCeilings(shares);
  const double shortfall = this->ShortfallOf(shares);
  if (this->Repeats || shortfall <= tolerance)
  {
    return false;
  }
  if (shortfall < this->LeastShortfall - leastGain)
  {
    this->LeastShortfall = shortfall;
    this->BestRun = this->Runs;
    this->BestProtects = this->Protects;
    for (Aim& aim : this->Aims)
    {
      aim.best = aim.importance;
    }
  }
  const bool isInVain =
    this->Runs - std::max(this->BestRun, this->StageStart) >= MostRunsInVain(this->Protects);
  if (this->Protects && this->Given.protectImportance > 0 &&
    (isInVain || this->Runs >= mostProtectedRuns))
  {
    this->Protects = false;
    this->StageStart = this->Runs;
    for (Aim& aim : this->Aims)
    {
      aim.importance = this->Wanted.ImportanceOf(static_cast<StructureRow>(aim.index + 1));
    }
    this->Steps = std::make_unique<BroydenSteps>(this->Aims.size());
    this->Apply();
    return true;
  }
  if (!isInVain && this->Runs < mostRuns - 1)
  {
    this->Ascend(shares);
    return true;
  }
  this->Repeats = true;
  this->GoToBest();
  return this->BestRun < this->Runs;
}

void TargetSearch::GoToBest()
{
  this->Protects = this->BestProtects;
  for (Aim& aim : this->Aims)
  {
    aim.importance = aim.best;
  }
  this->Apply();
}

/// Raises the importance of structures below their targets, and lowers that of those above, so that
/// they leave light to the others.
void TargetSearch::Ascend(const std::vector<StructureShares>& shares)
{
  constexpr double leastImportance = 0.01; // importances are multiplied
  const BroydenSteps::Limits limits{ std::log(leastImportance), 1.6 };
  std::vector<double> logs;
  std::vector<double> excesses;
  for (const Aim& aim : this->Aims)
  {
    logs.push_back(std::log(std::max(aim.importance, leastImportance)));
    excesses.push_back(LogitOf(shares[aim.index].visible) - LogitOf(aim.target + aimedAbove));
  }
  const std::vector<double> steps = this->Steps->StepFrom(logs, excesses, limits);
  for (std::size_t i = 0; i < this->Aims.size(); ++i)
  {
    this->Aims[i].importance = std::exp(logs[i] + steps[i]);
  }
  this->Apply();
}

void TargetSearch::Apply()
{
  this->Excess = 1;
  std::vector<Structure> all;
  for (std::size_t i = 0; i < this->Wanted.Count(); ++i)
  {
    all.push_back(this->Wanted.At(static_cast<StructureRow>(i + 1)));
  }
  for (const Aim& aim : this->Aims)
  {
    all[aim.index].importance = aim.importance;
    this->Excess = std::max(this->Excess, aim.importance);
  }
  for (Structure& structure : all)
  {
    structure.importance /= this->Excess;
  }
  this->Now = Structures(std::move(all));
}
}
