// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How much of a scene the sweeps of an iteration visit, counted in their plans.

#ifndef limpid_testing_benchmarks_SweepCounts_h
#define limpid_testing_benchmarks_SweepCounts_h

#include "optimize/Problem.h"

#include <vector>

namespace limpid::benchmark
{
/// Nodes of a grid, 0 or 1 each, in the order of its fields.
using NodeSet = std::vector<unsigned char>;

double CountOf(const NodeSet& nodes);
void Add(const NodeSet& more, NodeSet& nodes);

/// What the sweeps from one source visit.
struct SweepCounts
{
  double samples = 0;   ///< rays times layers
  NodeSet read;         ///< nodes that rays are interpolated from
  double readAgain = 0; ///< how many of them the rays of all frusta but the last read
  NodeSet updated;      ///< not empty nodes that rays are interpolated to
};

SweepCounts CountSweep(const Problem& problem, const RaySource& source);

/// In every row along x all nodes from the first to the last that is not empty.
NodeSet FilledNodes(const Problem& problem);
}

#endif
