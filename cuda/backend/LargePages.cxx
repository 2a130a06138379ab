// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/LargePages.h"

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
    // A wish: where it is not granted, the memory is there all the same.
    madvise(memory, bytes / page * page, smallPages ? MADV_NOHUGEPAGE : MADV_HUGEPAGE);
  }
#endif
}

std::vector<float> RoomFor(Index count)
{
  std::vector<float> room;
  room.reserve(static_cast<std::size_t>(count));
  UseLargePages(room.data(), room.capacity() * sizeof(float));
  return room;
}
}
