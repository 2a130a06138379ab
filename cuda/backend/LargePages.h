// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_LargePages_h
#define limpid_backend_LargePages_h

#include "math/Vec.h"

#include <cstddef>
#include <vector>

namespace limpid
{
/**
 * Asks the system to back memory that was not touched yet with large pages, if available.
 *
 * With small pages, obtaining the memory of a large field takes several times longer than writing
 * it. Small allocations are ignored. Values other than 0 may be lost.
 */
void UseLargePages(void* memory, std::size_t bytes);

/// Allocates zeroed memory for free(), in large pages; returns null if there is not enough.
void* AllocateZeroPages(std::size_t bytes);

/**
 * While alive, the calling thread's allocations use small pages. A large field that is written in
 * few places then takes memory only for these.
 */
class SmallPages
{
public:
  SmallPages();
  ~SmallPages();
  SmallPages(const SmallPages&) = delete;
  SmallPages& operator=(const SmallPages&) = delete;

private:
  bool Before;
};

/// Returns an empty vector with capacity for `count` values, in large pages.
std::vector<float> RoomFor(Index count);
}

#endif
