// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What is taken for important where nobody has said it.

#ifndef limpid_StartingImportance_h
#define limpid_StartingImportance_h

#include <array>

namespace limpid
{
class SharedArray;

/// Importance rises from 0 to 1 between two values of an array.
struct ImportanceRamp
{
  double begin = 0;
  double end = 0;                   ///< where it is 1
  std::array<double, 2> range = {}; ///< of all values of the array

  /// Not where all values are alike, or none is a number: nothing stands out of them.
  bool IsKnown() const { return this->begin < this->end; }
};

/// The largest few per cent of an array's values, of which there are usually few that matter most:
/// bones, vessels, cores; of magnitudes, if there are several components.
ImportanceRamp StartingImportance(const SharedArray& array);
}

#endif
