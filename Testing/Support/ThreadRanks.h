// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Ranks that are threads of one process, so that tests need no launcher.

#ifndef limpid_testing_ThreadRanks_h
#define limpid_testing_ThreadRanks_h

#include "backend/Backend.h"
#include "backend/Interruption.h"
#include "distributed/Communicator.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace limpid
{
/// What ranks share.
class ThreadRanks
{
public:
  explicit ThreadRanks(int size)
    : Size(size)
    , Ways(std::size_t(size * size))
  {
  }

  /// Calls work(communicator) on every rank at a time; throws what the first of them throws.
  template <class Work>
  static void Run(int size, const Work& work)
  {
    const auto all = std::make_shared<ThreadRanks>(size);
    const ThreadLimit threadsOfRank(std::max(ThreadCount() / size, 1)); // as launchers bind ranks
    std::vector<std::exception_ptr> failures(static_cast<std::size_t>(size));
    std::vector<std::thread> threads;
    threads.reserve(failures.size());
    for (int rank = 0; rank < size; ++rank)
    {
      threads.emplace_back(
        [&, rank]
        {
          try
          {
            work(std::shared_ptr<const Communicator>(std::make_shared<One>(all, rank)));
          }
          catch (...)
          {
            failures[std::size_t(rank)] = std::current_exception();
          }
        });
    }
    for (std::thread& thread : threads)
    {
      thread.join();
    }
    for (const std::exception_ptr& failure : failures)
    {
      if (failure)
      {
        std::rethrow_exception(failure);
      }
    }
  }

private:
  class One : public Communicator
  {
  public:
    One(std::shared_ptr<ThreadRanks> all, int rank)
      : All(std::move(all))
      , Number(rank)
    {
    }

    int Rank() const override { return this->Number; }
    int Size() const override { return this->All->Size; }

    void Exchange(
      const std::vector<Message>& sent, const std::vector<Message>& received) const override
    {
      for (const Message& message : sent)
      {
        const char* bytes = static_cast<const char*>(message.data);
        this->All->Post(
          this->All->From(this->Number, message.rank), { bytes, bytes + message.bytes });
      }
      for (const Message& message : received)
      {
        const std::vector<char> bytes =
          this->All->Take(this->All->From(message.rank, this->Number));
        LIMPID_REQUIRE(bytes.size() == message.bytes,
          "A message has " << bytes.size() << " bytes and not " << message.bytes << '.');
        std::copy(bytes.begin(), bytes.end(), static_cast<char*>(message.data)); // may be none
      }
    }

    void GiveUp(const std::string& why, bool interrupted) const noexcept override
    {
      this->All->End("Rank " + std::to_string(this->Number) + ": " + why, interrupted);
    }

  private:
    std::shared_ptr<ThreadRanks> All;
    int Number;
  };

  /// The messages on the way from one rank to another.
  struct Way
  {
    std::mutex access;
    std::condition_variable arrived;
    std::deque<std::vector<char>> messages;
  };

  Way& From(int rank, int to)
  {
    return this->Ways[std::size_t(rank) * std::size_t(this->Size) + std::size_t(to)];
  }

  void Post(Way& way, std::vector<char>&& bytes)
  {
    const std::lock_guard<std::mutex> lock(way.access);
    way.messages.push_back(std::move(bytes));
    way.arrived.notify_one();
  }

  std::vector<char> Take(Way& way)
  {
    std::unique_lock<std::mutex> lock(way.access);
    way.arrived.wait(lock, [&] { return !way.messages.empty() || this->Ended; });
    if (way.messages.empty() && this->WasInterrupted)
    {
      throw Interrupted();
    }
    if (way.messages.empty())
    {
      throw JointError(this->Why);
    }
    std::vector<char> bytes = std::move(way.messages.front());
    way.messages.pop_front();
    return bytes;
  }

  void End(const std::string& why, bool interrupted)
  {
    {
      const std::lock_guard<std::mutex> lock(this->Access);
      if (!this->Ended)
      {
        this->WasInterrupted = interrupted;
        this->Why = why;
      }
      this->Ended = true;
    }
    for (Way& way : this->Ways)
    {
      const std::lock_guard<std::mutex> lock(way.access); // no rank is about to wait
      way.arrived.notify_all();
    }
  }

  int Size;
  std::vector<Way> Ways;
  std::mutex Access; ///< to the following
  std::atomic<bool> Ended{ false };
  bool WasInterrupted = false; ///< set before Ended
  std::string Why;             ///< set before Ended
};
}

#endif
