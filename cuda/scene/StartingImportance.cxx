// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "scene/StartingImportance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace limpid
{
namespace
{
double QuantileOf(const std::vector<double>& sorted, double share)
{
  return sorted[static_cast<std::size_t>(share * double(sorted.size() - 1))];
}
}

ImportanceRamp RampOf(const std::vector<double>& sorted, const std::array<double, 2>& range)
{
  if (sorted.empty())
  {
    return {};
  }
  ImportanceRamp ramp{ QuantileOf(sorted, ImportanceBegins), QuantileOf(sorted, ImportanceIsFull),
    range };
  if (!ramp.IsKnown())
  {
    // Many of the largest values are equal, as in a mask: the ramp begins at the next smaller value
    // or ends at the largest.
    const auto first = std::lower_bound(sorted.begin(), sorted.end(), ramp.end);
    ramp = first != sorted.begin() ? ImportanceRamp{ *(first - 1), ramp.end, range }
                                   : ImportanceRamp{ ramp.begin, sorted.back(), range };
  }
  return ramp;
}

double SpeckShare(const ImportanceRamp& ramp, const std::vector<ValueWithNeighbours>& values)
{
  const auto importance = [&ramp](double value)
  { return std::min(std::max((value - ramp.begin) / (ramp.end - ramp.begin), 0.0), 1.0); };
  double all = 0;
  double removed = 0;
  for (const ValueWithNeighbours& sample : values)
  {
    const double own = importance(sample.value);
    all += own;
    removed += std::max(own - importance(sample.eighth), 0.0);
  }
  return all > 0 ? removed / all : 0;
}

ImportanceRamp CleanRamp(const ImportanceRamp& first, const std::vector<double>& sorted,
  const std::vector<ValueWithNeighbours>& values)
{
  ImportanceRamp cleanest = first;
  double least = first.IsKnown() ? SpeckShare(first, values) : 0;
  constexpr int steps = 8;
  for (int step = 1; step <= steps && least > mostSpecks; ++step)
  {
    const double fewer = std::pow(0.5, 0.5 * step);
    const ImportanceRamp ramp{ QuantileOf(sorted, 1 - fewer * (1 - ImportanceBegins)),
      QuantileOf(sorted, 1 - fewer * (1 - ImportanceIsFull)), first.range };
    const double specks = ramp.IsKnown() ? SpeckShare(ramp, values) : 1;
    if (specks < least)
    {
      cleanest = ramp;
      least = specks;
    }
  }
  return cleanest;
}
}
