// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How many bytes the launches of an iteration move at the least: every field that a launch reads or
// writes counts once, 4 bytes a node, however often it is read. Sweeps count the nodes that are not
// empty, a device's sums all of them. What fits into caches, tables and the rays of one slice, does
// not count; images of rays that a device's sweep leaves for the voxels do.

#ifndef limpid_testing_gpu_Traffic_h
#define limpid_testing_gpu_Traffic_h

#include "optimize/Problem.h"

#include <map>
#include <string>

namespace limpid::benchmark
{
/// Bytes by the label of the launches. Labels that are not there are not counted.
using Traffic = std::map<std::string, double>;

/// What runs the launches.
enum class Runner
{
  Device,
  Processor ///< voxels follow the rays of their slice at once, and are summed along the way
};

Traffic PolicyTraffic(const Problem& problem, Runner runner = Runner::Device);
Traffic AdamTraffic(const Problem& problem);
}

#endif
