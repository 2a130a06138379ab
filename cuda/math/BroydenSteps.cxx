// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "math/BroydenSteps.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace limpid
{
namespace
{
/// Solves matrix x = right for a positive definite matrix, by elimination.
std::vector<double> Solved(std::vector<std::vector<double>> matrix, std::vector<double> right)
{
  const std::size_t count = right.size();
  for (std::size_t pivot = 0; pivot < count; ++pivot)
  {
    for (std::size_t row = pivot + 1; row < count; ++row)
    {
      const double factor = matrix[row][pivot] / matrix[pivot][pivot];
      for (std::size_t column = pivot; column < count; ++column)
      {
        matrix[row][column] -= factor * matrix[pivot][column];
      }
      right[row] -= factor * right[pivot];
    }
  }
  for (std::size_t row = count; row-- > 0;)
  {
    for (std::size_t column = row + 1; column < count; ++column)
    {
      right[row] -= matrix[row][column] * right[column];
    }
    right[row] /= matrix[row][row];
  }
  return right;
}
}

BroydenSteps::BroydenSteps(std::size_t variables)
  : Derivative(variables, std::vector<double>(variables, 0.0))
{
  for (std::size_t i = 0; i < variables; ++i)
  {
    this->Derivative[i][i] = 1;
  }
}

void BroydenSteps::Learn(const std::vector<double>& place, const std::vector<double>& values)
{
  const std::size_t count = place.size();
  double square = 0;
  for (std::size_t i = 0; i < count && !this->LastPlace.empty(); ++i)
  {
    square += (place[i] - this->LastPlace[i]) * (place[i] - this->LastPlace[i]);
  }
  constexpr double leastSquare = 1e-6; // below, differences are noise
  for (std::size_t i = 0; i < count && square > leastSquare; ++i)
  {
    double unexpected = values[i] - this->LastValues[i];
    for (std::size_t j = 0; j < count; ++j)
    {
      unexpected -= this->Derivative[i][j] * (place[j] - this->LastPlace[j]);
    }
    for (std::size_t j = 0; j < count; ++j)
    {
      this->Derivative[i][j] += unexpected * (place[j] - this->LastPlace[j]) / square;
    }
  }
  this->LastPlace = place;
  this->LastValues = values;
}

/// Returns an element of the derivative. Where a variable has had no effect on its own value, as
/// far as was learned, a longer step may have one.
double BroydenSteps::SlopeOf(std::size_t value, std::size_t variable) const
{
  constexpr double leastOwn = 0.1;
  const double slope = this->Derivative[value][variable];
  return value == variable ? std::max(slope, leastOwn) : slope;
}

/// Returns the components of the step for the free variables, by the values of these alone. `step`:
/// that of the other variables, and 0 for the free ones.
std::vector<double> BroydenSteps::FreeStep(const std::vector<std::size_t>& free,
  const std::vector<double>& values, const std::vector<double>& step) const
{
  constexpr double damping = 0.02; // of the mean square of a variable's effects
  Matrix slopes;
  std::vector<double> rest; // values after the step of the others
  double squares = 0;
  for (const std::size_t i : free)
  {
    slopes.emplace_back();
    rest.push_back(values[i]);
    for (std::size_t j = 0; j < step.size(); ++j)
    {
      rest.back() += this->SlopeOf(i, j) * step[j];
    }
    for (const std::size_t j : free)
    {
      const double slope = this->SlopeOf(i, j);
      slopes.back().push_back(slope);
      squares += slope * slope;
    }
  }
  const std::size_t count = free.size();
  Matrix matrix(count, std::vector<double>(count, 0.0));
  std::vector<double> right(count, 0.0);
  for (std::size_t i = 0; i < count; ++i)
  {
    matrix[i][i] = damping * squares / double(count);
    for (std::size_t k = 0; k < count; ++k)
    {
      for (std::size_t j = 0; j < count; ++j)
      {
        matrix[i][j] += slopes[k][i] * slopes[k][j];
      }
      right[i] -= slopes[k][i] * rest[k];
    }
  }
  return Solved(std::move(matrix), std::move(right));
}

/// A variable that reaches a limit stays there, and its value no longer counts: the others cannot
/// do its part. Without this, one that has no effect would leave no step to the others.
std::vector<double> BroydenSteps::StepFrom(
  const std::vector<double>& place, const std::vector<double>& values, const Limits& limits)
{
  this->Learn(place, values);
  std::vector<double> step(place.size(), 0.0);
  std::vector<std::size_t> free;
  for (std::size_t i = 0; i < place.size(); ++i)
  {
    if (values[i] < 0 || place[i] > limits.least)
    {
      free.push_back(i);
    }
  }
  for (bool isLimited = true; isLimited;)
  {
    for (const std::size_t i : free)
    {
      step[i] = 0;
    }
    const std::vector<double> found = this->FreeStep(free, values, step);
    std::vector<std::size_t> within;
    for (std::size_t i = 0; i < free.size(); ++i)
    {
      const double least = std::max(-limits.longest, limits.least - place[free[i]]);
      step[free[i]] = std::clamp(found[i], least, limits.longest);
      if (step[free[i]] == found[i])
      {
        within.push_back(free[i]);
      }
    }
    isLimited = within.size() < free.size();
    free = std::move(within);
  }
  return step;
}
}
