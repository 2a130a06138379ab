// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_math_BroydenSteps_h
#define limpid_math_BroydenSteps_h

#include <cstddef>
#include <vector>

namespace limpid
{
/**
 * Steps towards a root of a function of several variables, each of which mainly raises its own
 * value. The derivative is learned on the way (Broyden 1965), with damping (Levenberg 1944).
 * Variables have a lower bound: there, a value above 0 is as good as 0.
 */
class BroydenSteps
{
public:
  /// What a step must not exceed.
  struct Limits
  {
    double least;   ///< lower bound of all variables
    double longest; ///< of each component of a step
  };

  /// At first the derivative is taken to be the identity.
  explicit BroydenSteps(std::size_t variables);

  /// Returns the step from `place`, not below the lower bound, where the function has these values.
  std::vector<double> StepFrom(
    const std::vector<double>& place, const std::vector<double>& values, const Limits& limits);

private:
  using Matrix = std::vector<std::vector<double>>; ///< rows

  void Learn(const std::vector<double>& place, const std::vector<double>& values);
  double SlopeOf(std::size_t value, std::size_t variable) const;
  std::vector<double> FreeStep(const std::vector<std::size_t>& free,
    const std::vector<double>& values, const std::vector<double>& step) const;

  Matrix Derivative;
  std::vector<double> LastPlace; ///< empty: there is none
  std::vector<double> LastValues;
};
}

#endif
