// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "math/BroydenSteps.h"

#include <algorithm>
#include <cmath>
#include <numeric>
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

std::vector<double> BroydenSteps::StepFrom(
  const std::vector<double>& place, const std::vector<double>& values, double longest)
{
  this->Learn(place, values);
  constexpr double damping = 0.02; // of the mean square of a variable's effects
  const std::size_t count = place.size();
  double squares = 0;
  for (const std::vector<double>& row : this->Derivative)
  {
    squares += std::inner_product(row.begin(), row.end(), row.begin(), 0.0);
  }
  Matrix matrix(count, std::vector<double>(count, 0.0));
  std::vector<double> right(count, 0.0);
  for (std::size_t i = 0; i < count; ++i)
  {
    constexpr double least = 1e-6; // without any effect
    matrix[i][i] = std::max(damping * squares / double(count), least);
    for (std::size_t k = 0; k < count; ++k)
    {
      for (std::size_t j = 0; j < count; ++j)
      {
        matrix[i][j] += this->Derivative[k][i] * this->Derivative[k][j];
      }
      right[i] -= this->Derivative[k][i] * values[k];
    }
  }
  std::vector<double> step = Solved(std::move(matrix), std::move(right));
  double largest = longest;
  for (const double component : step)
  {
    largest = std::max(largest, std::abs(component));
  }
  for (double& component : step)
  {
    component *= longest / largest;
  }
  return step;
}
}
