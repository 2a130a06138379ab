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
 * Asks the system to back memory that nobody has touched yet with large pages, where it has them.
 *
 * Of small ones it takes several times longer to get the memory of a large field than to write it.
 * Does nothing for what is small. Its values are not kept, unless they are 0.
 */
void UseLargePages(void* memory, std::size_t bytes);

/// Memory for free() whose bytes are 0, in large pages; null: there is not enough.
void* AllocateZeroPages(std::size_t bytes);

/**
 * While alive, memory that its thread gets is in small pages: of a field that is large but written
 * in few places only those take memory.
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

/// An empty array with room for so many values, in large pages.
std::vector<float> RoomFor(Index count);
}

#endif
