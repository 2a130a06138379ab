// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_benchmarks_MemoryInChild_h
#define limpid_testing_benchmarks_MemoryInChild_h

#include <functional>
#include <string>

namespace limpid::benchmark
{
/// What a run needs beside what was there before it.
struct Usage
{
  double voxels = 0;
  double bytes = 0; ///< peak resident memory less what was resident before
};

/// Does what is to be measured and returns the number of voxels.
using MeasuredRun = std::function<double()>;

/**
 * Measures in a child process: makes the run there, forgets the peak so far, and runs it. Call it
 * before anything in this process has started threads: children inherit none. `name` is for the
 * message if it fails.
 */
Usage UsageInChild(const std::string& name, const std::function<MeasuredRun()>& makeRun);
}

#endif
