// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_Backend_h
#define limpid_backend_Backend_h

#include "math/Vec.h"

#include <memory>
#include <string>
#include <vector>

namespace limpid
{
/// Returns the number of threads that ParallelFor uses in the calling thread.
int ThreadCount();

/// Describes the processor for the user: "CPU, 2 threads".
std::string CpuName();

/// While alive, limits the number of threads of ParallelFor. For tests and benchmarks.
class ThreadLimit
{
public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

private:
  struct Control;
  std::unique_ptr<Control> Holder;
};

/// Returns `count` floats of scratch memory, valid until the calling thread's next call.
float* ThreadScratch(std::size_t count);

namespace detail
{
using RangeFunction = void (*)(const void* body, Index begin, Index end);
void ParallelRanges(Index count, Index grain, RangeFunction function, const void* body);
}

/**
 * Calls body(index) for every index in [0, count), in parallel and in any order.
 *
 * Each index must write its own data, so that the result does not depend on the number of threads.
 * `grain`: smallest number of indices per task.
 */
template <class Body>
void ParallelFor(Index count, Index grain, const Body& body)
{
  const auto range = [](const void* typeless, Index begin, Index end)
  {
    const Body& call = *static_cast<const Body*>(typeless);
    for (Index index = begin; index < end; ++index)
    {
      call(index);
    }
  };
  detail::ParallelRanges(count, grain, range, &body);
}

template <class Body>
void ParallelFor(Index count, const Body& body)
{
  ParallelFor(count, 1, body);
}

/**
 * Sums body(begin, end) over blocks of indices, in double precision and in a fixed order. The
 * result does not depend on the number of threads.
 */
template <class Body>
double ParallelBlockSum(Index count, const Body& body)
{
  constexpr Index blockSize = 16384;
  const Index blocks = (count + blockSize - 1) / blockSize;
  std::vector<double> partial(static_cast<std::size_t>(blocks), 0.0);
  ParallelFor(blocks,
    [&](Index block)
    {
      const Index begin = block * blockSize;
      const Index end = begin + blockSize < count ? begin + blockSize : count;
      partial[static_cast<std::size_t>(block)] = body(begin, end);
    });
  double total = 0;
  for (const double part : partial)
  {
    total += part;
  }
  return total;
}
}

#endif
