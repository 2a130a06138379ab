// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_Communicator_h
#define limpid_backend_Communicator_h

#include "backend/ExactSum.h"
#include "backend/Interruption.h"
#include "math/Require.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace limpid
{
/**
 * The processes, called ranks, that work on one problem together: each has a part of the fields,
 * and all do the same steps in the same order. This is all that the core knows of them.
 *
 * Every rank has to come to every call.
 */
class Communicator
{
public:
  virtual ~Communicator() = default;

  virtual int Rank() const = 0; ///< of this process, from 0
  virtual int Size() const = 0; ///< number of ranks

  /// Bytes for another rank, or room for so many from it.
  struct Message
  {
    int rank;
    void* data;
    std::size_t bytes;
  };

  /// Sends and receives, and returns when all has come. What one rank sends to another arrives in
  /// the order in which it was sent, one message for one room of the same size.
  virtual void Exchange(
    const std::vector<Message>& sent, const std::vector<Message>& received) const = 0;

  /// Tells all other ranks that this one comes to no further call: what waits for it there throws
  /// Interrupted or JointError with these words. For a failure that others do not know of; the
  /// first call counts.
  virtual void GiveUp(const std::string& why, bool interrupted) const noexcept = 0;

  /// Makes every number the sum of those of all ranks.
  void Sum(std::int64_t* numbers, std::size_t count) const;

  /// Makes every number the least of those of all ranks.
  void TakeLeast(std::int32_t* numbers, std::size_t count) const;

  /// The largest of all ranks' numbers, none of which is below zero.
  float LargestOf(float here) const;

  /// Brings numbers, of which each is one rank's, to all: bit by bit. The others have 0 there.
  void Gather(double* numbers, std::size_t count) const;

  /// Makes every number that of the first rank: what ranks compute alike may differ by rounding.
  void TakeFirst(double* numbers, std::size_t count) const;

  /// Makes every sum that of all ranks.
  void Sum(ExactSum* sums, std::size_t count) const
  {
    static_assert(sizeof(ExactSum) % sizeof(std::int64_t) == 0, "integers and nothing else");
    this->Sum(
      reinterpret_cast<std::int64_t*>(sums), count * sizeof(ExactSum) / sizeof(std::int64_t));
  }

  /// Whether any rank says so.
  bool AnyOf(bool here) const
  {
    std::int32_t least = here ? 0 : 1;
    this->TakeLeast(&least, 1);
    return least == 0;
  }
};

/// Whether any rank says so; null: there is one.
inline bool AnyRank(const Communicator* ranks, bool here)
{
  return ranks ? ranks->AnyOf(here) : here;
}

/// The largest of the ranks' numbers, none of which is below zero, so that they decide alike; null:
/// there is one.
inline double LargestOfRanks(const Communicator* ranks, double here)
{
  return ranks ? double(ranks->LargestOf(static_cast<float>(here))) : here;
}

/// What computes on each of the ranks, for the user: "CPU, 2 threads, on each of 4 ranks"; null:
/// there is one.
std::string NameOnRanks(const std::string& backend, const Communicator* ranks);

/// What all ranks throw alike.
class JointError : public Error
{
public:
  using Error::Error;
};

/// Does what ranks do together, and waits for each other within: if it fails here, the others learn
/// of it (Communicator::GiveUp). Null: there is one rank.
template <class Work>
decltype(auto) TellingRanks(const Communicator* ranks, const Work& work)
{
  const auto giveUp = [ranks](const char* why, bool interrupted)
  {
    if (ranks)
    {
      ranks->GiveUp(why, interrupted);
    }
  };
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
    giveUp("It was interrupted.", true);
    throw;
  }
  catch (const std::exception& error)
  {
    giveUp(error.what(), false);
    throw;
  }
}

/// Does what all ranks have to do, or none. Where any of them fails, all throw JointError with the
/// message of the first that did. Within the work nobody may wait for others. Null: there is
/// one rank, which throws what it throws.
void Jointly(const Communicator* ranks, const std::function<void()>& work);
}

#endif
