// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Vector instructions in the CPU backend of a portable binary. Functions marked
// LIMPID_MULTIVERSION, and bodies passed to RunMultiversioned, are compiled for several
// instruction sets. The best one for the processor is chosen at run time. Functions called from
// them must be LIMPID_INLINE; otherwise they are compiled for the base set only. No file as a
// whole is compiled for one set: its inline functions would share names with those of other files,
// and the linker could use them on all processors.

#ifndef limpid_backend_Simd_h
#define limpid_backend_Simd_h

#include "math/Macros.h"

// Sanitizers are not initialised yet when the loader selects a version.
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

/// Marks a function, not a template, of which the loader selects a version. Not used with clang:
/// before version 18 it does not accept names of instruction sets, and calls of a version from
/// another file have no effect. Later versions omit functions that only versions call.
#if defined(LIMPID_HAS_VERSIONS) && !defined(__clang__)
#define LIMPID_MULTIVERSION                                                                        \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define LIMPID_MULTIVERSION
#endif

// Put before a loop whose arrays should become vector registers instead of memory: it is unrolled
// `times` times.
#define LIMPID_PRAGMA(text) _Pragma(#text)
#if defined(__GNUC__) && !defined(__clang__) && !defined(__CUDACC__)
#define LIMPID_UNROLL(times) LIMPID_PRAGMA(GCC unroll times)
#else
#define LIMPID_UNROLL(times)
#endif

// Put before a loop whose iterations are independent, to skip checks for aliasing. Clang warns if
// it cannot use this, which happens with sanitizers.
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
/// Prefetches the cache lines of values that are read soon. Rows of voxels are short and far
/// apart, so the processor cannot predict them. Callers must be LIMPID_INLINE, too; otherwise GCC
/// assumes that a function that only prefetches has no effect.
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
// Clang does not support templates with several versions; these functions have separate names.
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

/// Returns body() compiled for the current processor. The body must be LIMPID_INLINE, or a lambda
/// with LIMPID_INLINE_LAMBDA.
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
/// Returns body() compiled for the current processor. The body must be LIMPID_INLINE, or a lambda
/// with LIMPID_INLINE_LAMBDA.
template <class Body>
LIMPID_MULTIVERSION auto RunMultiversioned(const Body& body)
{
  return body();
}
#endif
}

#endif
