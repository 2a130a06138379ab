// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_SilentRanks_h
#define limpid_testing_SilentRanks_h

#include "distributed/Communicator.h"

#include <string>
#include <vector>

namespace limpid
{
/// Ranks of which nobody says anything: for plans.
class SilentRanks : public Communicator
{
public:
  explicit SilentRanks(int size)
    : Count(size)
  {
  }

  int Rank() const override { return 0; }
  int Size() const override { return this->Count; }
  void Exchange(const std::vector<Message>&, const std::vector<Message>&) const override {}
  void GiveUp(const std::string&, bool) const noexcept override {}

private:
  int Count;
};
}

#endif
