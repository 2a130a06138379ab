// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ViewTargets.h"

#include "optimize/SceneStructures.h"

#include <utility>

namespace limpid
{
namespace
{
// Returns what to say about targets that are not met; may be empty.
std::string WarningOf(const TargetSearch& search, const std::vector<StructureShares>& shares)
{
  std::vector<std::string> sentences;
  if (!search.KeepsProtection())
  {
    sentences.emplace_back(protectionIsLost);
  }
  const std::string refused = NamesIn(TargetState::Refused, search.Tried(), shares);
  if (!refused.empty())
  {
    sentences.push_back("No opacity shows as much of " + refused +
      " from here as the targets ask (it hides itself). Find a better view, or lower the targets.");
  }
  const std::string missed = NamesIn(TargetState::Missed, search.Tried(), shares);
  if (!missed.empty())
  {
    sentences.push_back("Less is visible of " + missed +
      " than the targets ask (what one structure gains another loses). Lower one of the targets, "
      "or the importance of other structures.");
  }
  std::string text;
  for (const std::string& sentence : sentences)
  {
    text += (text.empty() ? "" : " ") + sentence;
  }
  return text;
}
}

void ViewTargets::TakeStructures(const VolumeData& data)
{
  *this = ViewTargets();
  const Structures* given = data.Labelled();
  if (given && given->HasTargets())
  {
    this->Search.emplace(*given, Settings());
  }
}

Settings ViewTargets::TakeSettings(const Settings& given)
{
  if (!this->Search || !InfoOf(given.method).iterates)
  {
    return given;
  }
  this->Search.emplace(this->Search->Again(given));
  this->Given = given;
  this->IsOpen = true;
  this->Unmet.clear();
  return this->Search->TriedSettings();
}

Settings ViewTargets::SettingsFor(const Settings& given)
{
  return this->Search && this->Given == given ? this->Search->TriedSettings()
                                              : this->TakeSettings(given);
}

bool ViewTargets::Judge(std::vector<StructureShares> shares)
{
  this->IsOpen = !shares.empty() && this->Search->Next(shares);
  if (!this->IsOpen)
  {
    this->Unmet = WarningOf(*this->Search, shares);
  }
  return this->IsOpen;
}

void ViewTargets::RaiseCeilings(std::vector<StructureShares>& shares) const
{
  if (this->Search)
  {
    this->Search->RaiseCeilings(shares);
  }
}

SceneFields ViewTargets::Scene(const VolumeData& data)
{
  SceneFields scene = data.Scene();
  this->Importance.resize(std::size_t(scene.ValueCount()));
  FillImportance(
    this->Search->Tried(), data.SceneRows(), scene.ValueCount(), this->Importance.data());
  scene.importance = scene.despeckled = this->Importance.data();
  return scene;
}
}
