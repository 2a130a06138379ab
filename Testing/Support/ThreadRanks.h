// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Ranks that are threads of one process, so that tests need no launcher.

#ifndef limpid_testing_ThreadRanks_h
#define limpid_testing_ThreadRanks_h

#include "backend/Communicator.h"
#include "math/Require.h"

#include <algorithm>
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

    void Sum(std::int64_t* numbers, std::size_t count) const override
    {
      this->Reduce(numbers, count, [](std::int64_t a, std::int64_t b) { return a + b; });
    }

    void TakeLeast(std::int32_t* numbers, std::size_t count) const override
    {
      this->Reduce(numbers, count, [](std::int32_t a, std::int32_t b) { return std::min(a, b); });
    }

  private:
    /// To the first rank and back.
    template <class Value, class Combine>
    void Reduce(Value* numbers, std::size_t count, const Combine& combine) const
    {
      const std::size_t bytes = count * sizeof(Value);
      if (this->Number > 0)
      {
        this->Exchange({ { 0, numbers, bytes } }, { { 0, numbers, bytes } });
        return;
      }
      std::vector<Value> other(count);
      for (int rank = 1; rank < this->Size(); ++rank)
      {
        this->Exchange({}, { { rank, other.data(), bytes } });
        std::transform(numbers, numbers + count, other.begin(), numbers, combine);
      }
      for (int rank = 1; rank < this->Size(); ++rank)
      {
        this->Exchange({ { rank, numbers, bytes } }, {});
      }
    }

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
    this->Arrived.wait(lock, [&box] { return !box.empty(); });
    std::vector<char> bytes = std::move(box.front());
    box.pop_front();
    return bytes;
  }

  int Size;
  std::mutex Access;
  std::condition_variable Arrived;
  std::map<Way, std::deque<std::vector<char>>> Mail;
};
}

#endif
