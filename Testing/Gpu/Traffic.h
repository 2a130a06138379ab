// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How many bytes the launches of an iteration move at the least: every field that a launch reads or
// writes counts once, 4 bytes a node, however often it is read. Sweeps count the nodes that are not
// empty, a device's sums all of them. What fits into caches does not count: tables, rays, and their
// images of two slabs (SlabImages.h).

#ifndef limpid_testing_gpu_Traffic_h
#define limpid_testing_gpu_Traffic_h

#include "optimize/Problem.h"

#include <map>
#include <string>

namespace limpid::benchmark
{
/// Bytes by the label of the launches. Labels that are not there are not counted.
using Traffic = std::map<std::string, double>;

Traffic PolicyTraffic(const Problem& problem);
Traffic AdamTraffic(const Problem& problem);
}

#endif
