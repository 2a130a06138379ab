// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Pulls.h"

#include "math/Require.h"

namespace limpid
{
PullsOfKernel::PullsOfKernel(const std::vector<Pull>& pulls, const float* base)
{
  std::size_t count = 0;
  for (const Pull& pull : pulls)
  {
    this->all += pull.weight;
    if (pull.reference == base)
    {
      this->toBase += pull.weight;
      continue;
    }
    LIMPID_EXPECT(count < mostReferences);
    this->references[count] = pull.reference;
    this->weights[count] = pull.weight;
    ++count;
  }
}
}
