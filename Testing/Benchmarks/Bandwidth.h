// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How fast this machine moves bytes, with code like that of the row kernels.

#ifndef limpid_testing_benchmarks_Bandwidth_h
#define limpid_testing_benchmarks_Bandwidth_h

#include <cstddef>
#include <string>
#include <vector>

namespace limpid::benchmark
{
/// What a loop does with arrays of floats.
enum class Stream
{
  Read,   ///< sum of one
  Copy,   ///< one to another, through registers
  Triad,  ///< the sum of one and a multiple of another to a third
  Memcpy, ///< one to another by the library, whose stores may pass the caches by
};

/// Bytes are those that a loop names: each array once. Ordinary stores to what is in no cache also
/// read it first; that is not counted, neither here nor in Traffic.h.
struct StreamRate
{
  Stream kind = Stream::Read;
  std::string place;      ///< where the arrays fit in: L1, L2, L3 of today's processors, or memory
  int threads = 0;        ///< each with arrays of its own
  std::size_t arrays = 0; ///< all of them [bytes]
  double seconds = 0;     ///< of one pass, the fastest
  double rate = 0;        ///< bytes per second of that
};

std::string NameOf(Stream kind);

/// All kinds with 1, 2, 4 ... threads, in caches and in memory. `allThreads`: the most. `quick`:
/// only to see whether it works.
std::vector<StreamRate> MeasureBandwidth(int allThreads, bool quick);

/// Of a kind in memory with so many threads [bytes/s]; 0: not measured.
double MemoryRate(const std::vector<StreamRate>& rates, Stream kind, int threads);
}

#endif
