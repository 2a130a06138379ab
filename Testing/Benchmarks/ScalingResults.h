// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// All that limpid_bench_scaling measures, for people and for programs.

#ifndef limpid_testing_benchmarks_ScalingResults_h
#define limpid_testing_benchmarks_ScalingResults_h

#include "MemoryInChild.h"
#include "Options.h"
#include "ScalingSkips.h"
#include "ScalingTimes.h"

#include <ostream>
#include <string>
#include <vector>

namespace limpid::benchmark
{
struct VolumeMemory
{
  std::string scene;
  int side = 0; ///< nodes along each axis
  Usage usage;  ///< of a default run to the end
};

struct ScalingResults
{
  double loadBefore = 0;
  double loadAfter = 0;
  std::vector<VolumeMemory> memory;
  std::vector<SizeResult> sizes;
  std::vector<Exponents> exponents;
  std::vector<ThreadResult> threads;
  std::vector<SkipResult> skips;
};

void WriteScaling(std::ostream& stream, const ScalingResults& results, const Options& options);
void WriteScalingJson(std::ostream& stream, const ScalingResults& results);
}

#endif
