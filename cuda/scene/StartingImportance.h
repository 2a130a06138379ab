// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What is taken for important where nobody has said it.

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
/// Shares of the values of an array that lie below those at which what may be important begins, and
/// is important in full.
constexpr double ImportanceBegins = 0.95;
constexpr double ImportanceIsFull = 0.99;

/// So many values tell the quantiles to a thousandth.
constexpr long long mostSamplesOfQuantiles = 1 << 20;

/// Importance rises from 0 to 1 between two values of an array.
struct ImportanceRamp
{
  double begin = 0;
  double end = 0;                   ///< where it is 1
  std::array<double, 2> range = {}; ///< of all values of the array

  /// Not where all values are alike, or none is a number: nothing stands out of them.
  bool IsKnown() const { return this->begin < this->end; }
};

/// A value of an image, and the eighth largest of its 26 neighbours: what a value above it is worth
/// to the median that takes specks out of the importance, see Despeckle.
struct ValueAmongOthers
{
  double value;
  double eighth;
};

/// The eighth largest of the values of a node's 26 neighbours in an image of `size` nodes; on the
/// border, its nodes stand for those beyond. What is no finite number is smaller than all numbers,
/// as such points are empty. `valueAt`: of a node (i, j, k).
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
  values[13] = -std::numeric_limits<double>::infinity(); // the node itself
  std::nth_element(values.begin(), values.begin() + 7, values.end(), std::greater<double>());
  return values[7];
}

/// Largest share of the importance that may be in specks, which the median removes. Volumes that
/// are not noisy have at most 0.08.
constexpr double mostSpecks = 0.1;

/// The share of the importance that the median removes; 0 where nothing is important.
double SpecksOf(const ImportanceRamp& ramp, const std::vector<ValueAmongOthers>& values);

/// The largest few per cent of values, of which there are usually few that matter most: bones,
/// vessels, cores. `sorted`: finite samples of the values, ascending; `range`: of all values.
ImportanceRamp RampOf(const std::vector<double>& sorted, const std::array<double, 2>& range);

/**
 * That ramp, or where more than mostSpecks of its importance are noise, the first one above it that
 * has no more; or if all have, the one with the least. Its ends are quantiles, too: up to the
 * largest 0.3 and 0.06 % of the values. `values`: samples that are above the begin of the first
 * ramp.
 */
ImportanceRamp CleanRamp(const ImportanceRamp& first, const std::vector<double>& sorted,
  const std::vector<ValueAmongOthers>& values);
}

#endif
