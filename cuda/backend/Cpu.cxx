// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/Backend.h"
#include "backend/Interruption.h"
#include "backend/ThreadTeam.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace limpid
{
struct ThreadLimit::Control
{
  tbb::global_control parallelism;
};

ThreadLimit::ThreadLimit(int threads)
  : Holder(new Control{ tbb::global_control(tbb::global_control::max_allowed_parallelism,
      static_cast<std::size_t>(std::max(1, threads))) })
{
}

ThreadLimit::~ThreadLimit() = default;

int ThreadCount()
{
  const auto allowed = static_cast<int>(
    tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  return std::min(allowed, tbb::this_task_arena::max_concurrency());
}

std::string CpuName()
{
  const int threads = ThreadCount();
  return "CPU, " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
}

float* ThreadScratch(std::size_t count)
{
  thread_local std::vector<float> memory;
  if (memory.size() < count)
  {
    memory.resize(count);
  }
  return memory.data();
}

void detail::ParallelRanges(Index count, Index grain, RangeFunction function, const void* body)
{
  if (count <= 0)
  {
    return;
  }
  Interruptible::Check();
  if (count <= grain)
  {
    function(body, 0, count);
    return;
  }
  if (ThreadTeam::Run(count, grain, function, body))
  {
    return;
  }
  tbb::parallel_for(tbb::blocked_range<Index>(0, count, static_cast<std::size_t>(grain)),
    [=](const tbb::blocked_range<Index>& range)
    {
      Interruptible::Check();
      function(body, range.begin(), range.end());
    });
}
}
