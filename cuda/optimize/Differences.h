// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Differences_h
#define limpid_optimize_Differences_h

#include "distributed/Communicator.h"
#include "distributed/Slab.h"

#include <functional>
#include <vector>

namespace limpid
{
/// Sum of (a - b)^2 over `count` values.
double SumOfSquares(const float* a, const float* b, Index count);

/// Sum of |a - b| over `count` values.
double SumOfChanges(const float* a, const float* b, Index count);

/// Sums ofRow(y, z) over the rows along x of a slab. The result is bit-identical for any number of
/// threads and, if each rank has a slab, of ranks. `ranks`: null for one process.
double SumOverRows(
  const Slab& slab, const Communicator* ranks, const std::function<double(int y, int z)>& ofRow);

/// Distances of an iterate from the base, the last iterate and the reference.
struct Differences
{
  double squares = 0;             ///< sum of (iterate - base)^2
  double changes = 0;             ///< sum of |iterate - last iterate|
  double squaresFromPrevious = 0; ///< sum of (iterate - reference)^2
};

/// Differences, accumulated exactly.
struct ExactDifferences
{
  ExactSum squares;
  ExactSum changes;
  ExactSum squaresFromPrevious;

  void Add(const Differences& some)
  {
    this->squares.Add(some.squares);
    this->changes.Add(some.changes);
    this->squaresFromPrevious.Add(some.squaresFromPrevious);
  }

  /// Adds all of them, in parallel.
  void Add(const std::vector<Differences>& all);

  ExactDifferences& operator+=(const ExactDifferences& other)
  {
    this->squares += other.squares;
    this->changes += other.changes;
    this->squaresFromPrevious += other.squaresFromPrevious;
    return *this;
  }

  /// Sums the differences over all ranks.
  void SumOver(const Communicator& ranks)
  {
    ExactSum all[] = { this->squares, this->changes, this->squaresFromPrevious };
    ranks.Sum(all, 3);
    *this = { all[0], all[1], all[2] };
  }

  Differences Values() const
  {
    return { this->squares.Value(), this->changes.Value(), this->squaresFromPrevious.Value() };
  }
};
}

#endif
