// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_DescentProgress_h
#define limpid_optimize_DescentProgress_h

#include "optimize/Problem.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
/// Detects when the steps of a descent stop gaining.
class DescentProgress
{
public:
  static constexpr double leastGain = 0.1; ///< smallest gain that counts [energy * tolerance]

  explicit DescentProgress(const Problem& problem)
    : LeastGain(leastGain * problem.settings.tolerance)
    , StallLimit(problem.IsSmall() ? 6 : 3)
  {
  }

  /// Resets before the first step.
  void Begin() { *this = DescentProgress(this->LeastGain, this->StallLimit); }

  /// Records a step from one energy to another.
  void Step(double from, double to)
  {
    const double before = this->Made > 0 ? this->Least : from;
    const bool gains = before - to > this->LeastGain * std::abs(before);
    this->StepsWithoutGain = gains ? 0 : this->StepsWithoutGain + 1;
    this->Least = std::min(to, before);
    ++this->Made;
  }

  int Count() const { return this->Made; }

  /// Lowest energy so far, including the energy before the first step.
  double Lowest() const { return this->Least; }

  /// Whether the last steps gained next to nothing.
  bool HasStalled() const { return this->StepsWithoutGain >= this->StallLimit; }

private:
  DescentProgress(double gain, int patience)
    : LeastGain(gain)
    , StallLimit(patience)
  {
  }

  double LeastGain; ///< smallest gain that counts, as a fraction of the energy
  int StallLimit;   ///< number of steps without gain that are allowed
  int Made = 0;
  int StepsWithoutGain = 0; ///< since the last step with a gain
  double Least = 0;
};
}

#endif
