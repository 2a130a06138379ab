// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Runs a body for every index, compiled for the same instruction sets as the product's sweeps, so
// that a comparison of the two compares schemes.

#ifndef limpid_testing_PaperScheme_Launch_h
#define limpid_testing_PaperScheme_Launch_h

#include "backend/Backend.h"
#include "backend/Simd.h"

namespace limpid::reference
{
#if defined(__GNUC__)
#define LIMPID_FLATTEN __attribute__((flatten)) // bodies must join each version of the loop
#else
#define LIMPID_FLATTEN
#endif

/// body(index) for every index in [begin, end). Clang joins bodies to a lambda, GCC to a version.
template <class Body>
#if defined(__clang__)
void RunRange(const Body& body, Index begin, Index end)
{
  RunMultiversioned(
    [&body, begin, end]() LIMPID_INLINE_LAMBDA LIMPID_FLATTEN
    {
      for (Index index = begin; index < end; ++index)
      {
        body(index);
      }
    });
}
#else
LIMPID_MULTIVERSION LIMPID_FLATTEN void RunRange(const Body& body, Index begin, Index end)
{
  for (Index index = begin; index < end; ++index)
  {
    body(index);
  }
}
#endif

/// body(index) for every index in [0, count), in parallel and in any order.
template <class Body>
void Launch(Index count, const Body& body)
{
  constexpr Index blockSize = 64;
  ParallelFor((count + blockSize - 1) / blockSize,
    [&body, count](Index block)
    {
      const Index begin = block * blockSize;
      RunRange(body, begin, begin + blockSize < count ? begin + blockSize : count);
    });
}
}

#endif
