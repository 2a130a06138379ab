// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How the CPU backend reaches vector units without tying a binary to one machine: functions marked
// LIMPID_MULTIVERSION are compiled for several instruction sets and chosen at load time. What they
// call must be LIMPID_INLINE, or it would be compiled for the base set only.

#ifndef limpid_backend_Simd_h
#define limpid_backend_Simd_h

#include "math/Macros.h"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__CUDACC__) &&     \
  !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define LIMPID_MULTIVERSION                                                                        \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define LIMPID_MULTIVERSION
#endif

// Before a loop whose numbers are to be lanes of registers rather than places in memory: it is
// unrolled so many times.
#if defined(__GNUC__) && !defined(__clang__) && !defined(__CUDACC__)
#define LIMPID_PRAGMA(text) _Pragma(#text)
#define LIMPID_UNROLL(times) LIMPID_PRAGMA(GCC unroll times)
#else
#define LIMPID_UNROLL(times)
#endif

namespace limpid
{
/// Brings the cache lines of values that will be read soon. Rows of voxels are short, and one lies
/// far from the next: the processor does not foresee them. Callers must be LIMPID_INLINE, too, or
/// GCC takes a function that only prefetches for one without effect.
LIMPID_INLINE void Prefetch(const float* begin, const float* end)
{
#if defined(__GNUC__) && !defined(__CUDACC__)
  constexpr int perLine = 16;
  for (const float* line = begin; line < end; line += perLine)
  {
    __builtin_prefetch(line);
  }
#else
  static_cast<void>(begin);
  static_cast<void>(end);
#endif
}
}

#endif
