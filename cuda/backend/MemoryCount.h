// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_MemoryCount_h
#define limpid_backend_MemoryCount_h

#include <atomic>
#include <cstddef>

namespace limpid
{
/// Counts allocated bytes and their maximum. Thread-safe.
class MemoryCount
{
public:
  void Add(std::size_t bytes)
  {
    const std::size_t now = this->Allocated += bytes;
    std::size_t peak = this->Most;
    while (now > peak && !this->Most.compare_exchange_weak(peak, now))
    {
    }
  }

  void Remove(std::size_t bytes) { this->Allocated -= bytes; }

  std::size_t Bytes() const { return this->Allocated; }
  std::size_t Peak() const { return this->Most; }

private:
  std::atomic<std::size_t> Allocated{ 0 };
  std::atomic<std::size_t> Most{ 0 };
};
}

#endif
