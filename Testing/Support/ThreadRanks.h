// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Ranks that are threads of one process, so that tests need no launcher.

#ifndef limpid_testing_ThreadRanks_h
#define limpid_testing_ThreadRanks_h

#include "backend/Interruption.h"
#include "distributed/Communicator.h"

#include <condition_variable>
#include <cstring>
#include <deque>
#include <exception>
#include <map>
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
  {
  }

  /// Calls work(communicator) on every rank at a time; throws what the first of them throws.
  template <class Work>
  static void Run(int size, const Work& work)
  {
    const auto all = std::make_shared<ThreadRanks>(size);
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
        this->All->Post({ this->Number, message.rank }, { bytes, bytes + message.bytes });
      }
      for (const Message& message : received)
      {
        const std::vector<char> bytes = this->All->Take({ message.rank, this->Number });
        LIMPID_REQUIRE(bytes.size() == message.bytes,
          "A message has " << bytes.size() << " bytes and not " << message.bytes << '.');
        std::memcpy(message.data, bytes.data(), bytes.size());
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

  using Way = std::pair<int, int>; ///< from, to

  void Post(const Way& way, std::vector<char>&& bytes)
  {
    const std::lock_guard<std::mutex> lock(this->Access);
    this->Mail[way].push_back(std::move(bytes));
    this->Arrived.notify_all();
  }

  std::vector<char> Take(const Way& way)
  {
    std::unique_lock<std::mutex> lock(this->Access);
    std::deque<std::vector<char>>& box = this->Mail[way];
    this->Arrived.wait(lock, [&] { return !box.empty() || this->Ended; });
    if (box.empty() && this->WasInterrupted)
    {
      throw Interrupted();
    }
    if (box.empty())
    {
      throw JointError(this->Why);
    }
    std::vector<char> bytes = std::move(box.front());
    box.pop_front();
    return bytes;
  }

  void End(const std::string& why, bool interrupted)
  {
    const std::lock_guard<std::mutex> lock(this->Access);
    if (!this->Ended)
    {
      this->WasInterrupted = interrupted;
      this->Why = why;
    }
    this->Ended = true;
    this->Arrived.notify_all();
  }

  int Size;
  bool Ended = false;
  bool WasInterrupted = false;
  std::string Why;
  std::mutex Access;
  std::condition_variable Arrived;
  std::map<Way, std::deque<std::vector<char>>> Mail;
};
}

#endif
