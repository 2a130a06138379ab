// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "StartingImportance.h"

#include "ImportancePoints.h"
#include "ScalarChoice.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace limpid
{
namespace
{
// So many values tell the quantiles to a thousandth.
constexpr vtkIdType MostSamples = 1 << 20;

std::vector<double> SamplesOf(vtkDataArray* array, int component)
{
  const vtkIdType tuples = array->GetNumberOfTuples();
  const vtkIdType step = std::max<vtkIdType>(1, tuples / MostSamples) | 1; // odd: meets all columns
  std::vector<double> samples;
  samples.reserve(static_cast<std::size_t>(tuples / step + 1));
  const int components = array->GetNumberOfComponents();
  for (vtkIdType tuple = 0; tuple < tuples; tuple += step)
  {
    double value = 0;
    if (component >= 0 || components == 1)
    {
      value = array->GetComponent(tuple, std::max(component, 0));
    }
    else
    {
      for (int c = 0; c < components; ++c)
      {
        value = std::hypot(value, array->GetComponent(tuple, c));
      }
    }
    if (std::isfinite(value))
    {
      samples.push_back(value);
    }
  }
  return samples;
}

double QuantileOf(const std::vector<double>& sorted, double share)
{
  return sorted[static_cast<std::size_t>(share * double(sorted.size() - 1))];
}
}

ImportanceRamp StartingImportance(vtkDataArray* array, int component)
{
  std::vector<double> samples = SamplesOf(array, component);
  if (samples.empty())
  {
    return {};
  }
  std::sort(samples.begin(), samples.end());
  const std::array<double, 2> range = FiniteRangeOf(array);
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
