// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How the CPU backend reaches vector units without tying a binary to one machine: what is marked
// LIMPID_MULTIVERSION, or called by RunMultiversioned, is compiled for several instruction sets, of
// which the processor's is chosen at run time. What it calls must be LIMPID_INLINE, or it would be
// compiled for the base set only. No file is compiled for a set as a whole: its inline functions
// would have the names of those in other files, and the linker could take them for all processors.

#ifndef limpid_backend_Simd_h
#define limpid_backend_Simd_h

#include "math/Macros.h"

// Sanitizers are not ready yet when the loader asks which version to take.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define LIMPID_SANITIZED
#elif defined(__clang__)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer) ||                         \
  __has_feature(thread_sanitizer) || __has_feature(undefined_behavior_sanitizer)
#define LIMPID_SANITIZED
#endif
#endif

#if defined(__x86_64__) && defined(__GNUC__) && defined(__ELF__) && !defined(__CUDACC__) &&        \
  !defined(LIMPID_SANITIZED)
#define LIMPID_HAS_VERSIONS
#endif

/// Marks a function of several versions; it is no template. The loader chooses. Not with clang:
/// before version 18 it takes no names of instruction sets, and what calls a version in another
/// file calls nothing; later ones leave out functions that versions alone call.
#if defined(LIMPID_HAS_VERSIONS) && !defined(__clang__)
#define LIMPID_MULTIVERSION                                                                        \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define LIMPID_MULTIVERSION
#endif

// Before a loop whose numbers are to be lanes of registers rather than places in memory: it is
// unrolled so many times.
#define LIMPID_PRAGMA(text) _Pragma(#text)
#if defined(__GNUC__) && !defined(__clang__) && !defined(__CUDACC__)
#define LIMPID_UNROLL(times) LIMPID_PRAGMA(GCC unroll times)
#else
#define LIMPID_UNROLL(times)
#endif

// Before a loop no step of which reads what another one writes: it needs no look at addresses.
// Clang warns where it cannot use this, which is so where a sanitizer checks every step.
#if defined(__clang__) && defined(LIMPID_SANITIZED)
#define LIMPID_IVDEP
#elif defined(__clang__)
#define LIMPID_IVDEP LIMPID_PRAGMA(clang loop vectorize(assume_safety))
#elif defined(__GNUC__)
#define LIMPID_IVDEP LIMPID_PRAGMA(GCC ivdep)
#else
#define LIMPID_IVDEP
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

#if defined(LIMPID_HAS_VERSIONS) && defined(__clang__)
// Clang has no templates of several versions; these have a name of their own for each.
namespace detail
{
template <class Body>
__attribute__((target("avx512f,avx512vl,avx512dq,avx512bw,avx2,fma"))) auto RunByAvx512(
  const Body& body)
{
  return body();
}

template <class Body>
__attribute__((target("avx2,fma"))) auto RunByAvx2(const Body& body)
{
  return body();
}
}

/// Returns body() by the version for the processor. The body is LIMPID_INLINE, or a lambda that is
/// LIMPID_INLINE_LAMBDA.
template <class Body>
auto RunMultiversioned(const Body& body)
{
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool avx512 = __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
    __builtin_cpu_supports("avx512bw");
  if (avx2 && avx512)
  {
    return detail::RunByAvx512(body);
  }
  return avx2 ? detail::RunByAvx2(body) : body();
}
#else
/// Returns body() by the version for the processor. The body is LIMPID_INLINE, or a lambda that is
/// LIMPID_INLINE_LAMBDA.
template <class Body>
LIMPID_MULTIVERSION auto RunMultiversioned(const Body& body)
{
  return body();
}
#endif
}

#endif
