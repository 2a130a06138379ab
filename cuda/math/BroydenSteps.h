// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_math_BroydenSteps_h
#define limpid_math_BroydenSteps_h

#include <cstddef>
#include <vector>

namespace limpid
{
/// Steps towards a root of a function of several variables, whose derivative is learned on the way
/// (Broyden 1965), with damping (Levenberg 1944).
class BroydenSteps
{
public:
  /// At first the derivative is taken to be the identity.
  explicit BroydenSteps(std::size_t variables);

  /// Returns the step from `place`, where the function has these values. No component is longer
  /// than `longest`.
  std::vector<double> StepFrom(
    const std::vector<double>& place, const std::vector<double>& values, double longest);

private:
  using Matrix = std::vector<std::vector<double>>; ///< rows

  void Learn(const std::vector<double>& place, const std::vector<double>& values);

  Matrix Derivative;
  std::vector<double> LastPlace; ///< empty: there is none
  std::vector<double> LastValues;
};
}

#endif
