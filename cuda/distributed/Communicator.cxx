// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "distributed/Communicator.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <string>

namespace limpid
{
namespace
{
/// Combines the values of all ranks: up a tree of ranks to the first one, and back.
template <class Value, class Combine>
void Reduce(const Communicator& ranks, Value* values, std::size_t count, const Combine& combine)
{
  const int own = ranks.Rank();
  const std::size_t bytes = count * sizeof(Value);
  std::vector<Value> others(count);
  int step = 1;
  for (; step < ranks.Size() && own % (2 * step) == 0; step *= 2)
  {
    if (own + step < ranks.Size())
    {
      ranks.Exchange({}, { { own + step, others.data(), bytes } });
      std::transform(values, values + count, others.begin(), values, combine);
    }
  }
  if (own > 0)
  {
    ranks.Exchange({ { own - step, values, bytes } }, { { own - step, others.data(), bytes } });
    std::copy(others.begin(), others.end(), values);
  }
  std::vector<Communicator::Message> told;
  for (step /= 2; step > 0; step /= 2)
  {
    if (own + step < ranks.Size())
    {
      told.push_back({ own + step, values, bytes });
    }
  }
  ranks.Exchange(told, {});
}

/// Broadcasts a text from rank `teller`.
std::string BroadcastText(const Communicator& ranks, int teller, const std::string& text)
{
  const bool tells = ranks.Rank() == teller;
  std::int64_t length = tells ? std::int64_t(text.size()) : 0;
  ranks.Sum(&length, 1);
  std::vector<std::int64_t> letters(static_cast<std::size_t>(length), 0);
  if (tells)
  {
    std::copy(text.begin(), text.end(), letters.begin());
  }
  ranks.Sum(letters.data(), letters.size());
  std::string told;
  for (const std::int64_t letter : letters)
  {
    told.push_back(static_cast<char>(letter));
  }
  return told;
}

/// A process without others, which has nobody to exchange messages with.
class OneProcess : public Communicator
{
public:
  int Rank() const override { return 0; }
  int Size() const override { return 1; }
  void Exchange(const std::vector<Message>&, const std::vector<Message>&) const override {}
  void GiveUp(const std::string&, bool) const noexcept override {}
};
}

void Communicator::Sum(std::int64_t* numbers, std::size_t count) const
{
  Reduce(*this, numbers, count, [](std::int64_t a, std::int64_t b) { return a + b; });
}

void Communicator::TakeFirst(double* numbers, std::size_t count) const
{
  if (this->Rank() != 0)
  {
    std::fill_n(numbers, count, 0.0);
  }
  this->Gather(numbers, count);
}

float Communicator::LargestOf(float here) const
{
  std::int32_t bits; // the bit patterns of non-negative floats have the same order
  std::memcpy(&bits, &here, sizeof(bits));
  bits = -bits;
  this->TakeLeast(&bits, 1);
  bits = -bits;
  std::memcpy(&here, &bits, sizeof(bits));
  return here;
}

void Communicator::Gather(double* numbers, std::size_t count) const
{
  std::vector<std::int64_t> bits(count);
  std::memcpy(bits.data(), numbers, count * sizeof(double));
  this->Sum(bits.data(), count); // the bits of 0 are all 0
  std::memcpy(numbers, bits.data(), count * sizeof(double));
}

void Communicator::TakeLeast(std::int32_t* numbers, std::size_t count) const
{
  Reduce(*this, numbers, count, [](std::int32_t a, std::int32_t b) { return std::min(a, b); });
}

const std::shared_ptr<const Communicator>& ThisProcess()
{
  static const std::shared_ptr<const Communicator> process = std::make_shared<OneProcess>();
  return process;
}

void RequireOnAllRanks(const Communicator& ranks, const std::function<void()>& work)
{
  if (ranks.IsAlone())
  {
    work();
    return;
  }
  std::string failure;
  std::int32_t first = ranks.Size();
  try
  {
    work();
  }
  catch (const Error& error)
  {
    failure = error.what();
    first = ranks.Rank();
  }
  catch (const std::bad_alloc&)
  {
    failure = "There is not enough memory (a rank could not allocate its part of the scene). Use "
              "more ranks, or machines with more memory.";
    first = ranks.Rank();
  }
  ranks.TakeLeast(&first, 1);
  if (first < ranks.Size())
  {
    throw JointError("Rank " + std::to_string(first) + ": " + BroadcastText(ranks, first, failure));
  }
}

std::string NameOnRanks(const std::string& backend, const Communicator& ranks)
{
  return ranks.IsAlone() ? backend
                         : backend + ", on each of " + std::to_string(ranks.Size()) + " ranks";
}
}
