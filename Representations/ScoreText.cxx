// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ScoreText.h"

#include "vtkTransmittanceVolumeMapper.h"

#include "vtkTable.h"
#include "vtkVariant.h"

#include "math/PercentText.h"
#include "optimize/TargetSearch.h"

#include <algorithm>
#include <vector>

namespace limpid
{
namespace
{
bool IsOptimizing(vtkTransmittanceVolumeMapper* mapper)
{
  return mapper->GetMethod() != vtkTransmittanceVolumeMapper::ORDINARY &&
    mapper->GetOptimization() != vtkTransmittanceVolumeMapper::OFF;
}

// What was removed from the array before cannot be seen.
std::string Where(vtkTransmittanceVolumeMapper* mapper)
{
  const std::string array = mapper->GetExtinctionArray();
  const bool inArray = mapper->GetExtinctionSource() == vtkTransmittanceVolumeMapper::ARRAY;
  return inArray ? " in " + (array.empty() ? "Extinction" : array) : "";
}

std::string StateOfIterations(vtkTransmittanceVolumeMapper* mapper)
{
  if (mapper->GetPauseOptimization())
  {
    return "paused";
  }
  if (mapper->GetMethod() != vtkTransmittanceVolumeMapper::OPTIMIZED)
  {
    return mapper->GetMethodName();
  }
  if (!mapper->GetConverged())
  {
    return "optimizing ...";
  }
  const int iterations = mapper->GetIterations();
  return (mapper->GetSettled() ? "converged, " : "stopped at ") + std::to_string(iterations) +
    (iterations == 1 ? " iteration" : " iterations");
}

// Returns what is visible of a structure, as a line.
std::string StructureLine(vtkTable* structures, vtkIdType row)
{
  const auto number = [&](const char* column)
  { return structures->GetValueByName(row, column).ToDouble(); };
  Structure structure;
  structure.name = structures->GetValueByName(row, "Name").ToString();
  if (const double target = number("Target"); target >= 0)
  {
    structure.target = target;
  }
  StructureShares shares;
  shares.visible = number("Visible");
  shares.attainable = number("Attainable");
  shares.important = shares.attainable; // whether there is anything to see
  return "\n" + TextOf(structure, shares);
}

// Returns the rows of the structures that the text names: those with a target, or else the most
// important ones. None if that would only repeat the score.
std::vector<vtkIdType> ToldRows(vtkTable* structures)
{
  constexpr std::size_t mostWithoutTarget = 3;
  std::vector<vtkIdType> important;
  std::vector<vtkIdType> targets;
  const auto importance = [structures](vtkIdType row)
  { return structures->GetValueByName(row, "Importance").ToDouble(); };
  for (vtkIdType row = 0; row < structures->GetNumberOfRows(); ++row)
  {
    if (importance(row) > 0)
    {
      important.push_back(row);
    }
    if (structures->GetValueByName(row, "Target").ToDouble() >= 0)
    {
      targets.push_back(row);
    }
  }
  if (!targets.empty() || important.size() < 2)
  {
    return targets;
  }
  std::stable_sort(important.begin(), important.end(),
    [&](vtkIdType one, vtkIdType other) { return importance(one) > importance(other); });
  important.resize(std::min(important.size(), mostWithoutTarget));
  return important;
}

// Returns what is visible of the structures that matter most, a line each. Empty while unknown.
std::string StructureLines(vtkTransmittanceVolumeMapper* mapper)
{
  vtkTable* structures = mapper->GetKnownStructureTable();
  const std::vector<vtkIdType> rows = ToldRows(structures);
  std::string text;
  if (structures->GetColumnByName("Visible"))
  {
    for (const vtkIdType row : rows)
    {
      text += StructureLine(structures, row);
    }
  }
  return text;
}
}

std::string ScoreText(vtkTransmittanceVolumeMapper* mapper, bool isInView, const std::string& name)
{
  if (isInView && !mapper->GetMeasured())
  {
    return {};
  }
  // Important structures are never quite invisible, so zero means that nothing in view is
  // important.
  const double before = mapper->GetBaseVisibleFraction();
  const double now = mapper->GetVisibleFraction();
  if (!isInView || !(before > 0 || now > 0))
  {
    return (name.empty() ? "Nothing" : name + ": nothing") + " important is in view";
  }
  const double most = mapper->GetAttainableFraction();
  std::string text =
    name.empty() ? "Visible " + PercentText(now) : name + ": " + PercentText(now) + " visible";
  text +=
    most > 0 ? " of at most " + PercentText(most) + " from here" : " of the important structures";
  text += Where(mapper);
  if (IsOptimizing(mapper))
  {
    text += " (was " + PercentText(before) + ")\n";
    constexpr double worthTelling = 0.0005; // smaller shares would read 0.0 %
    const double removed = mapper->GetSacrificedFraction();
    text += removed >= worthTelling ? PercentText(removed) + " removed, " : "";
    text += StateOfIterations(mapper);
    const std::string resolution = mapper->GetOptimizedAt();
    text += resolution.empty() ? "" : " at " + resolution;
  }
  return text + StructureLines(mapper);
}

bool NeedsShares(vtkTransmittanceVolumeMapper* mapper)
{
  return !mapper->GetStructuresMeasured() && !ToldRows(mapper->GetKnownStructureTable()).empty();
}

std::string MissedText(vtkTransmittanceVolumeMapper* mapper)
{
  const bool painted = mapper->GetShowMissed() && !mapper->DrawsOnSeveralRanks();
  return painted ? "This color: removed or hidden" : "";
}
}
