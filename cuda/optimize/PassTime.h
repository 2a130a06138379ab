// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_PassTime_h
#define limpid_optimize_PassTime_h

#include "math/Vec.h"

#include <functional>
#include <vector>

namespace limpid
{
/// Makes a pass over a grid of so many nodes and says how long it took [s].
using Stopwatch = std::function<double(Index nodes, const std::function<void()>& pass)>;

/// The stopwatch that looks at the clock.
double TimePass(Index nodes, const std::function<void()>& pass);

/**
 * How long a pass over a grid is going to take: so many nodes, so much time per node as the last
 * passes took.
 */
class PassTime
{
public:
  double Expected(Index nodes) const { return double(nodes) * this->SecondsPerNode; }

  /// A pass has been made.
  void Learn(Index nodes, double seconds);

  /// The first of some grids, finest first, that is expected to take no longer than `seconds`; the
  /// last if none is. A grid finer than `current` has to be expected to take clearly less, so that
  /// the choice does not flicker.
  std::size_t Choose(const std::vector<Index>& nodes, double seconds, std::size_t current) const;

private:
  double SecondsPerNode = 1e-7; ///< cautious: a slow machine, a dense scene
};
}

#endif
