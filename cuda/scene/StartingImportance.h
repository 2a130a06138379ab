// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What is taken for important where nobody has said it.

#ifndef limpid_scene_StartingImportance_h
#define limpid_scene_StartingImportance_h

#include <array>
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

/// The largest few per cent of values, of which there are usually few that matter most: bones,
/// vessels, cores. `sorted`: finite samples of the values, ascending; `range`: of all values.
ImportanceRamp RampOf(const std::vector<double>& sorted, const std::array<double, 2>& range);
}

#endif
