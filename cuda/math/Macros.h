// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The few macros that distinguish compilers.

#ifndef limpid_math_Macros_h
#define limpid_math_Macros_h

/// Marks functions for both the processor and CUDA devices.
#ifdef __CUDACC__
#define LIMPID_HD __host__ __device__
#else
#define LIMPID_HD
#endif

/// Marks functions that are inlined in every build, so that they are compiled for the caller's
/// instruction set.
#if defined(__CUDACC__)
#define LIMPID_INLINE __forceinline__
#elif defined(__GNUC__)
#define LIMPID_INLINE inline __attribute__((always_inline))
#else
#define LIMPID_INLINE inline
#endif

/// Marks a lambda as LIMPID_INLINE; put it after the parameters.
#if defined(__GNUC__) && !defined(__CUDACC__)
#define LIMPID_INLINE_LAMBDA __attribute__((always_inline))
#else
#define LIMPID_INLINE_LAMBDA
#endif

#endif
