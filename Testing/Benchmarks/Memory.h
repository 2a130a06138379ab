// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How much memory a run takes beyond the input.

#ifndef limpid_testing_benchmarks_Memory_h
#define limpid_testing_benchmarks_Memory_h

#include <ostream>
#include <string>
#include <vector>

namespace limpid::benchmark
{
/// Peak resident memory of a run less what was resident before it [byte].
struct MemoryResult
{
  std::string scene;
  double voxels = 0;
  double policy = 0;
  double separate = 0;
  double adam = 0;
};

/// Measures in child processes. Call it before anything in this process has started threads:
/// children inherit none.
MemoryResult MeasureMemory(const std::string& scenePath, int threads);
void WriteMemory(std::ostream& stream, const std::vector<MemoryResult>& results);
}

#endif
