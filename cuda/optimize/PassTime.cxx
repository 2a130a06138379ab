// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/PassTime.h"

namespace limpid
{
void PassTime::Learn(double secondsPerNode)
{
  constexpr double trust = 0.5; // weight of a new measurement, which other programs may disturb
  this->SecondsPerNode += trust * (secondsPerNode - this->SecondsPerNode);
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
