// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The passes of a policy iteration beside the bytes that they move.

#ifndef limpid_testing_benchmarks_KernelsFloor_h
#define limpid_testing_benchmarks_KernelsFloor_h

#include "SweepCounts.h"
#include "TimedScene.h"

#include <string>
#include <vector>

namespace limpid::benchmark
{
/// A pass over the fields. Bytes: every field that it reads or writes once, 4 bytes a node, at the
/// nodes that it visits. What fits into caches (rays, tables) does not count.
struct PassTime
{
  std::string name;
  double seconds = 0; ///< median over the iterations
  double bytes = 0;
  double samples = 0; ///< rays times layers; 0: it has no rays
};

struct FloorResult
{
  std::string scene;
  Int3 nodes{ 0 };
  int threads = 0;
  double voxels = 0;
  double filled = 0;     ///< voxels that may change
  double seconds = 0;    ///< of an iteration of the solver from the third on, median
  double spread = 0;     ///< of that
  double fieldBytes = 0; ///< as Gpu/Traffic.h counts them: at all nodes that are not empty
  std::vector<PassTime> passes;

  double Bytes() const; ///< of all passes
  double SecondsOfPasses() const;
};

/// Bytes that the sweeps of an iteration move. `filled`: see FilledNodes.
double BytesOfPolicy(const SweepCounts& camera, const NodeSet& filled);
double BytesOfDerivative(const SweepCounts& light);

/// With the threads that are allowed now. `iterations`: how many are timed.
FloorResult MeasureFloor(const TimedScene& scene, int iterations);
}

#endif
