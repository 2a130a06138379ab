// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/Communicator.h"

#include "math/Require.h"

#include <algorithm>
#include <new>
#include <string>

namespace limpid
{
namespace
{
/// A text that one of the ranks has, for all.
std::string Told(const Communicator& ranks, int teller, const std::string& text)
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
}

void Jointly(const Communicator* ranks, const std::function<void()>& work)
{
  if (!ranks)
  {
    work();
    return;
  }
  std::string failure;
  std::int32_t first = ranks->Size();
  try
  {
    work();
  }
  catch (const Error& error)
  {
    failure = error.what();
    first = ranks->Rank();
  }
  catch (const std::bad_alloc&)
  {
    failure = "There is not enough memory (a rank could not get what its part takes). Use more "
              "ranks, or machines with more memory.";
    first = ranks->Rank();
  }
  ranks->TakeLeast(&first, 1);
  if (first < ranks->Size())
  {
    throw Error("Rank " + std::to_string(first) + ": " + Told(*ranks, first, failure));
  }
}
}
