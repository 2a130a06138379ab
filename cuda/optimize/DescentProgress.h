// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_DescentProgress_h
#define limpid_optimize_DescentProgress_h

#include "optimize/Problem.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
/// Whether the steps of a descent still gain.
class DescentProgress
{
public:
  static constexpr double leastGain = 0.1; ///< of an energy, per tolerance

  explicit DescentProgress(const Problem& problem)
    : LeastGain(leastGain * problem.settings.tolerance)
    , Patience(problem.IsSmall() ? 6 : 3)
  {
  }

  /// The next step is the first one.
  void Begin() { *this = DescentProgress(this->LeastGain, this->Patience); }

  /// A step from one energy to another.
  void Step(double from, double to)
  {
    const double before = this->Made > 0 ? this->Least : from;
    const bool gains = before - to > this->LeastGain * std::abs(before);
    this->StepsWithoutGain = gains ? 0 : this->StepsWithoutGain + 1;
    this->Least = std::min(to, before);
    ++this->Made;
  }

  int Count() const { return this->Made; }

  /// Energy since the first step, that before it included.
  double Lowest() const { return this->Least; }

  /// Whether the last steps have gained next to nothing.
  bool HasStalled() const { return this->StepsWithoutGain >= this->Patience; }

private:
  DescentProgress(double gain, int patience)
    : LeastGain(gain)
    , Patience(patience)
  {
  }

  double LeastGain; ///< share of the energy
  int Patience;     ///< steps
  int Made = 0;
  int StepsWithoutGain = 0; ///< since the last one that was worth it
  double Least = 0;
};
}

#endif
