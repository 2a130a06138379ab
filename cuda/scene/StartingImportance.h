// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Assumption about importance if it is not specified.

#ifndef limpid_scene_StartingImportance_h
#define limpid_scene_StartingImportance_h

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

namespace limpid
{
/// Quantiles of the values of an array at which the assumed importance begins to rise and reaches
/// 1.
constexpr double ImportanceBegins = 0.95;
constexpr double ImportanceIsFull = 0.99;

/// With this number of values, quantiles are accurate to a thousandth.
constexpr long long mostSamplesOfQuantiles = 1 << 20;

/// Importance that rises linearly from 0 to 1 between two values of an array.
struct ImportanceRamp
{
  double begin = 0;
  double end = 0;                   ///< value where it reaches 1
  std::array<double, 2> range = {}; ///< of all values of the array

  /// Returns false if all values are alike or none is a number, so that none stands out.
  bool IsKnown() const { return this->begin < this->end; }
};

/// A value of an image, and the eighth largest of its 26 neighbours, to which the median that
/// removes specks from the importance reduces a larger value, see Despeckle.
struct ValueWithNeighbours
{
  double value;
  double eighth;
};

/// Returns the eighth largest of the values of a node's 26 neighbours in an image of `size` nodes.
/// Outside of the image, the nearest border nodes are used. Values that are not finite
/// count as smaller than all numbers, as such points are empty. `valueAt`: returns the value of a
/// node (i, j, k).
template <class ValueAt>
double EighthLargestNeighbour(
  const std::array<int, 3>& size, const std::array<int, 3>& node, const ValueAt& valueAt)
{
  std::array<double, 27> values;
  for (int number = 0; number < 27; ++number)
  {
    const int offset[3] = { number % 3 - 1, number / 3 % 3 - 1, number / 9 - 1 };
    std::array<int, 3> other;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      other[axis] = std::min(std::max(node[axis] + offset[axis], 0), size[axis] - 1);
    }
    const double value = valueAt(other[0], other[1], other[2]);
    values[std::size_t(number)] =
      std::isfinite(value) ? value : -std::numeric_limits<double>::infinity();
  }
  values[13] = -std::numeric_limits<double>::infinity(); // excludes the node itself
  std::nth_element(values.begin(), values.begin() + 7, values.end(), std::greater<double>());
  return values[7];
}

/// Largest acceptable share of importance in specks, which the median removes. For volumes without
/// much noise it is at most 0.08.
constexpr double mostSpecks = 0.1;

/// Returns the share of the importance that the median removes; 0 if nothing is important.
double SpeckShare(const ImportanceRamp& ramp, const std::vector<ValueWithNeighbours>& values);

/// Returns the ramp over the largest few per cent of the values. Usually few values matter most:
/// those of bones, vessels, cores. `sorted`: finite samples of the values, ascending; `range`: of
/// all values. A large fill value, which stands for missing values, does not count.
ImportanceRamp RampOf(const std::vector<double>& sorted, const std::array<double, 2>& range);

/**
 * Returns the first ramp, or, if more than mostSpecks of its importance is noise, the next higher
 * one for which it is not; if there is none, the one with the least noise. Its ends are also
 * quantiles, up to the largest 0.3 and 0.06 % of the values. `values`: samples above the begin of
 * the first ramp.
 */
ImportanceRamp CleanRamp(const ImportanceRamp& first, const std::vector<double>& sorted,
  const std::vector<ValueWithNeighbours>& values);
}

#endif
