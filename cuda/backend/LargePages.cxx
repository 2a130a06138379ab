// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/LargePages.h"

#include <cstdlib>
#include <cstring>
#include <memory>

#if defined(__linux__)
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace limpid
{
namespace
{
thread_local bool smallPages = false;
}

SmallPages::SmallPages()
  : Before(smallPages)
{
  smallPages = true;
}

SmallPages::~SmallPages()
{
  smallPages = this->Before;
}

void UseLargePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes)
{
#if defined(__linux__)
  constexpr std::size_t leastBytes = std::size_t(1) << 22;
  if (bytes < leastBytes)
  {
    return;
  }
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  if (std::align(page, page, memory, bytes))
  {
    // This is only a hint; the memory is valid even if it is ignored.
    madvise(memory, bytes / page * page, smallPages ? MADV_NOHUGEPAGE : MADV_HUGEPAGE);
    if (smallPages)
    {
      madvise(memory, bytes / page * page, MADV_DONTNEED); // malloc() may reuse pages
    }
  }
#endif
}

void* AllocateZeroPages(std::size_t bytes)
{
#if defined(__linux__)
  constexpr std::size_t leastBytes = std::size_t(1) << 16;
  if (smallPages && bytes >= leastBytes)
  {
    // Reused memory of malloc() is not zero, but pages returned to the system read as zero again.
    void* const memory = std::malloc(bytes);
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    void* first = memory;
    std::size_t room = bytes;
    if (memory && std::align(page, page, first, room))
    {
      const std::size_t whole = room / page * page;
      const auto before =
        static_cast<std::size_t>(static_cast<char*>(first) - static_cast<char*>(memory));
      UseLargePages(first, whole);
      const bool given = madvise(first, whole, MADV_DONTNEED) == 0;
      std::memset(memory, 0, given ? before : bytes);
      std::memset(static_cast<char*>(first) + whole, 0, bytes - before - whole);
    }
    return memory;
  }
#endif
  void* const memory = std::calloc(bytes, 1);
  if (memory)
  {
    UseLargePages(memory, bytes);
  }
  return memory;
}

std::vector<float> RoomFor(Index count)
{
  std::vector<float> room;
  room.reserve(static_cast<std::size_t>(count));
  UseLargePages(room.data(), room.capacity() * sizeof(float));
  return room;
}
}
