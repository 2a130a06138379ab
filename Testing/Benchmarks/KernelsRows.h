// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The loops over rows, and whole sweeps, one by one, by Google Benchmark.

#ifndef limpid_testing_benchmarks_KernelsRows_h
#define limpid_testing_benchmarks_KernelsRows_h

#include <string>
#include <vector>

namespace limpid::benchmark
{
struct KernelTime
{
  std::string name;
  std::string item;    ///< what is counted
  int threads = 1;     ///< that were allowed
  double seconds = 0;  ///< of a call, median
  double spread = 0;   ///< over the repetitions
  double itemRate = 0; ///< per second
  double byteRate = 0; ///< of the arrays that the kernel reads and writes, each once [bytes/s]
};

struct KernelEffort
{
  int side = 256;            ///< of the volumes that are swept: nodes along each axis
  int repetitions = 5;       ///< all kernels in turns
  double leastSeconds = 0.1; ///< of a repetition
};

std::vector<KernelTime> MeasureKernels(const KernelEffort& effort);
}

#endif
