// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ScoreText.h"

#include "vtkTransmittanceVolumeMapper.h"

#include "math/PercentText.h"

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

std::string Progress(vtkTransmittanceVolumeMapper* mapper)
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
    text += Progress(mapper);
  }
  return text;
}

std::string MissedText(vtkTransmittanceVolumeMapper* mapper)
{
  const bool painted = mapper->GetShowMissed() && !mapper->DrawsOnSeveralRanks();
  return painted ? "This color: removed or hidden" : "";
}
}
