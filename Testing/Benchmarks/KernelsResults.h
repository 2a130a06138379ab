// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// All that limpid_bench_kernels measures, for people and for programs.

#ifndef limpid_testing_benchmarks_KernelsResults_h
#define limpid_testing_benchmarks_KernelsResults_h

#include "Bandwidth.h"
#include "KernelsFloor.h"
#include "KernelsRows.h"

#include <ostream>
#include <vector>

namespace limpid::benchmark
{
struct KernelsResults
{
  double loadBefore = 0;
  double loadAfter = 0;
  std::vector<StreamRate> streams;
  std::vector<FloorResult> floors;
  std::vector<KernelTime> kernels;
};

/// Time that the bytes of a pass need at the least: as fast as the fastest stream in memory with as
/// many threads.
double FloorOf(double bytes, int threads, const std::vector<StreamRate>& streams);

void WriteKernels(std::ostream& stream, const KernelsResults& results);
void WriteKernelsJson(std::ostream& stream, const KernelsResults& results);
}

#endif
