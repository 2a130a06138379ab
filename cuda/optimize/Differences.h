// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Differences_h
#define limpid_optimize_Differences_h

#include "math/ExactSum.h"
#include "optimize/Pulls.h"
#include "scene/Grid.h"

#include <array>
#include <vector>

namespace limpid
{
/// Sum of (a - b)^2 over `count` values.
double SumOfSquares(const float* a, const float* b, Index count);

/// Sum of |a - b| over `count` values.
double SumOfChanges(const float* a, const float* b, Index count);

/// Distances of an iterate from the last one and from the references of all pulls.
struct Differences
{
  double changes = 0;                      ///< sum of |iterate - last iterate|
  double squares[1 + mostReferences] = {}; ///< sums of (iterate - reference)^2, in the order of
                                           ///< Problem::Pulls
};

/// Differences, accumulated exactly.
class ExactDifferences
{
public:
  void Add(const Differences& some)
  {
    this->Sums.back().Add(some.changes);
    for (std::size_t i = 0; i <= mostReferences; ++i)
    {
      this->Sums[i].Add(some.squares[i]);
    }
  }

  /// Adds all of them, in parallel.
  void Add(const std::vector<Differences>& all);

  ExactDifferences& operator+=(const ExactDifferences& other)
  {
    for (std::size_t i = 0; i < this->Sums.size(); ++i)
    {
      this->Sums[i] += other.Sums[i];
    }
    return *this;
  }

  using All = std::array<ExactSum, 2 + mostReferences>; ///< of squares, and last of changes
  All& Exact() { return this->Sums; }

  Differences Values() const
  {
    Differences values;
    values.changes = this->Sums.back().Value();
    for (std::size_t i = 0; i <= mostReferences; ++i)
    {
      values.squares[i] = this->Sums[i].Value();
    }
    return values;
  }

private:
  All Sums;
};
}

#endif
