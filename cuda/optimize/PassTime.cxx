// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/PassTime.h"

#include <algorithm>
#include <chrono>

namespace limpid
{
double TimePass(Index, const std::function<void()>& pass)
{
  const auto start = std::chrono::steady_clock::now();
  pass();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void PassTime::Learn(Index nodes, double seconds)
{
  constexpr double trust = 0.5; // weight of a new measurement, which other programs may disturb
  const double measured = seconds / double(std::max<Index>(nodes, 1));
  this->SecondsPerNode += trust * (measured - this->SecondsPerNode);
}

std::size_t PassTime::Choose(
  const std::vector<Index>& nodes, double seconds, std::size_t current) const
{
  constexpr double reserve = 0.75;
  for (std::size_t level = 0; level + 1 < nodes.size(); ++level)
  {
    const double budget = level < current ? reserve * seconds : seconds;
    if (this->Expected(nodes[level]) <= budget)
    {
      return level;
    }
  }
  return nodes.size() - 1;
}
}
