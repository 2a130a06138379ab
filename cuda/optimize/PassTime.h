// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_PassTime_h
#define limpid_optimize_PassTime_h

#include "math/Vec.h"

#include <functional>
#include <vector>

namespace limpid
{
/// Runs a pass over a grid of `nodes` nodes and returns its duration per node [s].
double SecondsPerNodeOf(Index nodes, const std::function<void()>& pass);

/**
 * Predicts the duration of a pass over a grid from its number of nodes and the time per node of
 * the last passes.
 */
class PassTime
{
public:
  double Expected(Index nodes) const { return double(nodes) * this->SecondsPerNode; }

  /// Records the duration of a pass.
  void Learn(double secondsPerNode);

  /// Returns the first of several grids, finest first, whose expected duration is at most
  /// `seconds`, or the last grid. A grid finer than `current` must be expected to take clearly
  /// less, so that the choice does not flicker.
  std::size_t Choose(const std::vector<Index>& nodes, double seconds, std::size_t current) const;

private:
  double SecondsPerNode = 1e-7; ///< pessimistic: a slow machine and a dense scene
};
}

#endif
