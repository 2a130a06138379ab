// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "scene/StartingImportance.h"

#include <algorithm>
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
    // Many are alike up there, as in a mask: from the next smaller value on, or to the largest.
    const auto first = std::lower_bound(sorted.begin(), sorted.end(), ramp.end);
    ramp = first != sorted.begin() ? ImportanceRamp{ *(first - 1), ramp.end, range }
                                   : ImportanceRamp{ ramp.begin, sorted.back(), range };
  }
  return ramp;
}
}
