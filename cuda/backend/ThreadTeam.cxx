// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/ThreadTeam.h"

#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace limpid
{
namespace
{
/// Waits for a moment; after many calls it yields the processor.
class StallLimit
{
public:
  void Wait()
  {
    constexpr int momentsAwake = 2000;
    if (++this->Moments < momentsAwake)
    {
#if defined(__x86_64__) && defined(__GNUC__)
      __builtin_ia32_pause();
#endif
      return;
    }
    std::this_thread::yield();
  }

private:
  int Moments = 0;
};

/// The remaining indices [begin, end) of a share of a loop, in one word.
struct Rest
{
  std::uint32_t begin;
  std::uint32_t end;

  Rest(std::uint32_t first, std::uint32_t last)
    : begin(first)
    , end(last)
  {
  }
  explicit Rest(std::uint64_t word)
    : begin(static_cast<std::uint32_t>(word))
    , end(static_cast<std::uint32_t>(word >> 32))
  {
  }

  std::uint64_t Word() const { return std::uint64_t(this->end) << 32 | this->begin; }
  bool Empty() const { return this->begin >= this->end; }
};

constexpr std::size_t cacheLine = 64;

/// The team that this thread owns.
thread_local ThreadTeam* ownTeam = nullptr;

/// Whether this thread is working on a loop of any team.
thread_local bool working = false;
}

class ThreadTeam::Members
{
public:
  explicit Members(int threads)
    : Shares(static_cast<std::size_t>(threads))
  {
    try
    {
      for (int helper = 1; helper < threads; ++helper)
      {
        this->Helpers.run([this, helper] { this->Help(static_cast<std::size_t>(helper)); });
      }
    }
    catch (...)
    {
      this->End(); // tasks that have started use this object
      throw;
    }
  }

  ~Members() { this->End(); }

  Members(const Members&) = delete;
  Members& operator=(const Members&) = delete;

  void Run(
    std::uint32_t count, std::uint32_t grain, detail::RangeFunction function, const void* body)
  {
    working = true;
    this->Function = function;
    this->Body = body;
    this->Least.store((grain + 1) / 2, std::memory_order_relaxed);
    this->Finished.store(0, std::memory_order_relaxed);
    const std::size_t shares = this->Shares.size();
    for (std::size_t share = 0; share < shares; ++share)
    {
      const Rest rest(static_cast<std::uint32_t>(count * share / shares),
        static_cast<std::uint32_t>(count * (share + 1) / shares));
      this->Shares[share].open.store(rest.Word(), std::memory_order_release);
    }
    this->Loops.fetch_add(1, std::memory_order_release);
    this->Work(0);
    StallLimit patience;
    while (this->Finished.load(std::memory_order_acquire) < count)
    {
      patience.Wait();
    }
    working = false;
    if (this->Failure)
    {
      std::rethrow_exception(std::exchange(this->Failure, nullptr));
    }
  }

private:
  /// One thread's share of a loop.
  struct alignas(cacheLine) Share
  {
    std::atomic<std::uint64_t> open{ 0 };
  };

  void End()
  {
    this->Over.store(true, std::memory_order_relaxed);
    this->Helpers.wait();
  }

  /// The main function of a helper thread while the team lives. A thread that comes here while it
  /// waits for something else must not stay: the owner of the team might be waiting for that.
  void Help(std::size_t own)
  {
    if (ownTeam || working)
    {
      return;
    }
    working = true;
    std::uint64_t seen = 0;
    StallLimit patience;
    while (!this->Over.load(std::memory_order_relaxed))
    {
      const std::uint64_t loops = this->Loops.load(std::memory_order_acquire);
      if (loops == seen)
      {
        patience.Wait();
        continue;
      }
      seen = loops;
      patience = {};
      this->Work(own);
    }
    working = false;
  }

  /// Works on a thread's own share, then on what is left of others. From loop to loop a thread
  /// gets the same rows, which are still in its cache. Shares 0 and 1 are therefore worked on from
  /// their outer ends, so that ranges taken from the other share are next to its own; likewise
  /// shares 2 and 3, and so on.
  void Work(std::size_t own)
  {
    const std::size_t shares = this->Shares.size();
    for (std::size_t other = 0; other < shares; ++other)
    {
      const std::size_t share = (own ^ other) < shares ? own ^ other : other;
      const bool fromBegin = (share % 2 == 0) == (other == 0);
      this->WorkOn(this->Shares[share].open, other == 0, fromBegin);
    }
  }

  /// Takes ranges of a share until none is left, large ones first. A loop cannot end before all
  /// ranges taken from it are finished, so its description cannot change meanwhile.
  void WorkOn(std::atomic<std::uint64_t>& share, bool own, bool fromBegin)
  {
    const std::uint32_t parts = own ? 4 : 8;
    std::uint64_t word = share.load(std::memory_order_acquire);
    for (Rest rest(word); !rest.Empty(); rest = Rest(word))
    {
      const std::uint32_t left = rest.end - rest.begin;
      const std::uint32_t least = this->Least.load(std::memory_order_relaxed);
      const std::uint32_t taken = std::min(left, std::max(left / parts, least));
      const Rest range =
        fromBegin ? Rest(rest.begin, rest.begin + taken) : Rest(rest.end - taken, rest.end);
      const Rest after = fromBegin ? Rest(range.end, rest.end) : Rest(rest.begin, range.begin);
      if (share.compare_exchange_weak(
            word, after.Word(), std::memory_order_acq_rel, std::memory_order_acquire))
      {
        this->RunRange(range.begin, range.end);
        this->Finished.fetch_add(taken, std::memory_order_release);
        word = share.load(std::memory_order_acquire);
      }
    }
  }

  void RunRange(Index begin, Index end)
  {
    try
    {
      this->Function(this->Body, begin, end);
    }
    catch (...)
    {
      const std::lock_guard<std::mutex> lock(this->FailureMutex);
      this->Failure = std::current_exception();
    }
  }

  // The fields that helpers poll, and those that they read next, are in one cache line.
  alignas(cacheLine) std::atomic<std::uint64_t> Loops{ 0 };
  std::atomic<bool> Over{ false };
  std::atomic<std::uint32_t> Least{ 1 };
  detail::RangeFunction Function = nullptr;
  const void* Body = nullptr;
  std::exception_ptr Failure;
  alignas(cacheLine) std::atomic<std::uint64_t> Finished{ 0 };
  std::mutex FailureMutex;
  std::vector<Share> Shares;
  tbb::task_group Helpers;
};

ThreadTeam::ThreadTeam()
{
  const int threads = ThreadCount();
  if (threads > 1 && !ownTeam && !working)
  {
    this->Here = std::make_unique<Members>(threads);
    ownTeam = this;
  }
}

ThreadTeam::~ThreadTeam()
{
  if (this->Here)
  {
    ownTeam = nullptr;
  }
}

bool ThreadTeam::Run(Index count, Index grain, detail::RangeFunction function, const void* body)
{
  const bool countable = count <= Index(std::numeric_limits<std::uint32_t>::max());
  if (working)
  {
    function(body, 0, count);
    return true;
  }
  if (!ownTeam || !countable)
  {
    return false;
  }
  ownTeam->Here->Run(
    static_cast<std::uint32_t>(count), static_cast<std::uint32_t>(grain), function, body);
  return true;
}
}
