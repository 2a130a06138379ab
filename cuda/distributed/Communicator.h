// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_distributed_Communicator_h
#define limpid_distributed_Communicator_h

#include "backend/Interruption.h"
#include "math/ExactSum.h"
#include "math/Require.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace limpid
{
/**
 * The processes, called ranks, that work on one problem together. Each holds a part of the fields,
 * and all perform the same steps in the same order. The core uses no other interface to them.
 *
 * Every call is collective.
 */
class Communicator
{
public:
  virtual ~Communicator() = default;

  virtual int Rank() const = 0; ///< index of this process, starting at 0
  virtual int Size() const = 0; ///< number of ranks

  /// Whether there are no other ranks.
  bool IsAlone() const { return this->Size() == 1; }

  /// A message to another rank, or a buffer for one from it.
  struct Message
  {
    int rank;
    void* data;
    std::size_t bytes;
  };

  /// Sends and receives, and returns when all messages have arrived. Messages between two ranks
  /// arrive in order; each buffer must have the size of its message.
  virtual void Exchange(
    const std::vector<Message>& sent, const std::vector<Message>& received) const = 0;

  /// Tells all other ranks that this one will make no further calls. Their pending calls throw
  /// Interrupted or JointError with this message. Use it for a failure that others do not know of;
  /// only the first call has an effect.
  virtual void GiveUp(const std::string& why, bool interrupted) const noexcept = 0;

  /// Replaces every number by its sum over all ranks.
  void Sum(std::int64_t* numbers, std::size_t count) const;

  /// Replaces every number by its minimum over all ranks.
  void TakeLeast(std::int32_t* numbers, std::size_t count) const;

  /// Returns the maximum over all ranks of a non-negative number.
  float LargestOf(float here) const;

  /// Gathers numbers, each set on one rank and 0 on the others, on all ranks, bit by bit.
  void Gather(double* numbers, std::size_t count) const;

  /// Broadcasts the numbers of the first rank. Values computed on each rank may differ by
  /// rounding.
  void TakeFirst(double* numbers, std::size_t count) const;

  /// Replaces every sum by its sum over all ranks.
  void Sum(ExactSum* sums, std::size_t count) const
  {
    static_assert(sizeof(ExactSum) % sizeof(std::int64_t) == 0, "integers and nothing else");
    this->Sum(
      reinterpret_cast<std::int64_t*>(sums), count * sizeof(ExactSum) / sizeof(std::int64_t));
  }

  /// Returns whether the condition holds on any rank.
  bool AnyOf(bool here) const
  {
    std::int32_t least = here ? 0 : 1;
    this->TakeLeast(&least, 1);
    return least == 0;
  }
};

/// Returns the communicator of a process that works alone: rank 0 of 1.
const std::shared_ptr<const Communicator>& ThisProcess();

/// Describes the backend of all ranks for the user: "CPU, 2 threads, on each of 4 ranks".
std::string NameOnRanks(const std::string& backend, const Communicator& ranks);

/// An error that all ranks throw.
class JointError : public Error
{
public:
  using Error::Error;
};

/// Runs collective work. If it fails on this rank, the others are notified (Communicator::GiveUp).
template <class Work>
decltype(auto) NotifyingOnFailure(const Communicator& ranks, const Work& work)
{
  try
  {
    return work();
  }
  catch (const JointError&)
  {
    throw;
  }
  catch (const Interrupted&)
  {
    ranks.GiveUp("It was interrupted.", true);
    throw;
  }
  catch (const std::exception& error)
  {
    ranks.GiveUp(error.what(), false);
    throw;
  }
}

/// Runs work that must succeed on all ranks. If it fails on any, all ranks throw JointError with
/// the message of the first that failed. The work itself must not communicate. A process alone
/// passes exceptions on unchanged.
void RequireOnAllRanks(const Communicator& ranks, const std::function<void()>& work);
}

#endif
