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
/// Returns the number of samples without those of a large fill value, which stands for missing
/// values: the largest, if it is out of all proportion to the others.
std::size_t CountWithoutFill(const std::vector<double>& sorted)
{
  constexpr double leastFill = 1e15; // smaller ones are not told from data; netCDF's is 9.97e36
  constexpr double mostRanges = 1e6;
  const double fill = sorted.back();
  const auto others = std::lower_bound(sorted.begin(), sorted.end(), fill);
  if (others == sorted.begin() || fill < leastFill)
  {
    return sorted.size();
  }
  const double range = *(others - 1) - sorted.front(); // 0 beside a mask
  const bool isFill = range > 0 && (fill - *(others - 1)) / mostRanges > range;
  return isFill ? static_cast<std::size_t>(others - sorted.begin()) : sorted.size();
}

/// The samples of a ramp, ascending.
class Samples
{
public:
  explicit Samples(const std::vector<double>& sorted)
    : First(sorted.begin())
    , Last(sorted.begin() + static_cast<std::ptrdiff_t>(CountWithoutFill(sorted)) - 1)
  {
  }

  double Quantile(double share) const
  {
    return this->First[static_cast<std::ptrdiff_t>(share * double(this->Last - this->First))];
  }

  double Largest() const { return *this->Last; }

  /// Returns the largest sample below a value; the smallest sample if there is none.
  double Below(double value) const
  {
    const auto found = std::lower_bound(this->First, this->Last, value);
    return found == this->First ? *found : *(found - 1);
  }

private:
  std::vector<double>::const_iterator First;
  std::vector<double>::const_iterator Last;
};
}

ImportanceRamp RampOf(const std::vector<double>& sorted, const std::array<double, 2>& range)
{
  if (sorted.empty())
  {
    return {};
  }
  const Samples samples(sorted);
  ImportanceRamp ramp{ samples.Quantile(ImportanceBegins), samples.Quantile(ImportanceIsFull),
    range };
  if (!ramp.IsKnown())
  {
    // Many of the largest values are equal, as in a mask: the ramp begins at the next smaller value
    // or ends at the largest.
    const double below = samples.Below(ramp.end);
    ramp = below < ramp.end ? ImportanceRamp{ below, ramp.end, range }
                            : ImportanceRamp{ ramp.begin, samples.Largest(), range };
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
  if (!first.IsKnown())
  {
    return first;
  }
  const Samples samples(sorted);
  ImportanceRamp cleanest = first;
  double least = SpeckShare(first, values);
  constexpr int steps = 8;
  for (int step = 1; step <= steps && least > mostSpecks; ++step)
  {
    const double fewer = std::pow(0.5, 0.5 * step);
    const ImportanceRamp ramp{ samples.Quantile(1 - fewer * (1 - ImportanceBegins)),
      samples.Quantile(1 - fewer * (1 - ImportanceIsFull)), first.range };
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
