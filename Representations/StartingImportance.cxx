// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "StartingImportance.h"

#include "ImportancePoints.h"
#include "SharedArray.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace limpid
{
namespace
{
// So many values tell the quantiles to a thousandth.
constexpr long long MostSamples = 1 << 20;

double QuantileOf(const std::vector<double>& sorted, double share)
{
  return sorted[static_cast<std::size_t>(share * double(sorted.size() - 1))];
}
}

ImportanceRamp StartingImportance(const SharedArray& array)
{
  const std::vector<double> samples = array.Samples(MostSamples);
  if (samples.empty())
  {
    return {};
  }
  const std::array<double, 2> range = array.FiniteRange();
  ImportanceRamp ramp{ QuantileOf(samples, ImportanceBegins), QuantileOf(samples, ImportanceIsFull),
    range };
  if (!ramp.IsKnown())
  {
    // Many are alike up there, as in a mask: from the next smaller value on, or to the largest.
    const auto first = std::lower_bound(samples.begin(), samples.end(), ramp.end);
    ramp = first != samples.begin() ? ImportanceRamp{ *(first - 1), ramp.end, range }
                                    : ImportanceRamp{ ramp.begin, samples.back(), range };
  }
  return ramp;
}
}
