// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How the CPU backend reaches vector units without tying a binary to one machine: functions marked
// LIMPID_MULTIVERSION are compiled for several instruction sets and chosen at load time. What they
// call must be LIMPID_INLINE, or it would be compiled for the base set only.

#ifndef limpid_backend_Simd_h
#define limpid_backend_Simd_h

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__CUDACC__) &&     \
  !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define LIMPID_MULTIVERSION                                                                        \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define LIMPID_MULTIVERSION
#endif

#if defined(__CUDACC__)
#define LIMPID_INLINE __forceinline__
#elif defined(__GNUC__)
#define LIMPID_INLINE inline __attribute__((always_inline))
#else
#define LIMPID_INLINE inline
#endif

#endif
