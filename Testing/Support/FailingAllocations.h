// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Allocations that fail on purpose: operator new everywhere, and malloc and calloc of what is
// linked statically. For executables of limpid_add_test with ALLOCATIONS_FAIL.

#ifndef limpid_testing_FailingAllocations_h
#define limpid_testing_FailingAllocations_h

#include <cstddef>
#include <cstdint>

namespace limpid
{
/// Which allocations fail, of those that are made while it lives.
class FailingAllocations
{
public:
  enum class Which
  {
    One,      ///< a block that is too large, but others are there
    AllFromIt ///< memory is exhausted
  };

  /// Which allocations count.
  struct Scope
  {
    const char* caller = nullptr; ///< part of the name of a library that makes them; null: any
    std::size_t leastBytes = 0;
  };

  /// From the `number`-th on, counted from 1 in the order in which they are made.
  FailingAllocations(std::int64_t number, Which which, const Scope& scope = Everything());
  ~FailingAllocations();
  FailingAllocations(const FailingAllocations&) = delete;
  FailingAllocations& operator=(const FailingAllocations&) = delete;

  /// Whether any has failed.
  bool Failed() const;

private:
  static Scope Everything() { return {}; }
};

/// Blocks that are allocated now.
std::int64_t LiveBlocks();
}

#endif
