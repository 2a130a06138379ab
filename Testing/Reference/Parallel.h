// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_Parallel_h
#define limpid_testing_Parallel_h

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace truth
{
/// Calls body(row) for every row below `count` on so many threads, zero: as many as the machine
/// has. A body owns what it writes, so that the result is the same.
template <class Body>
void ForEachRow(std::size_t count, unsigned threads, const Body& body)
{
  const unsigned wanted = threads ? threads : std::max(1u, std::thread::hardware_concurrency());
  std::atomic<std::size_t> next{ 0 };
  const auto work = [&]()
  {
    for (std::size_t row = next++; row < count; row = next++)
    {
      body(row);
    }
  };
  std::vector<std::thread> others;
  for (unsigned thread = 1; thread < wanted; ++thread)
  {
    others.emplace_back(work);
  }
  work();
  for (std::thread& other : others)
  {
    other.join();
  }
}
}

#endif
