// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Differences.h"

#include "backend/Backend.h"
#include "backend/Simd.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace limpid
{
namespace
{
constexpr int lanes = 8; // number of independent partial sums, which hide the latency of additions
}

LIMPID_MULTIVERSION
double SumOfSquares(const float* a, const float* b, Index count)
{
  double partial[lanes] = {};
  Index i = 0;
  for (; i + lanes <= count; i += lanes)
  {
    for (int lane = 0; lane < lanes; ++lane)
    {
      const double difference = double(a[i + lane]) - double(b[i + lane]);
      partial[lane] += difference * difference;
    }
  }
  double sum = 0;
  for (const double part : partial)
  {
    sum += part;
  }
  for (; i < count; ++i)
  {
    sum += (double(a[i]) - b[i]) * (double(a[i]) - b[i]);
  }
  return sum;
}

LIMPID_MULTIVERSION
double SumOfChanges(const float* a, const float* b, Index count)
{
  double partial[lanes] = {};
  Index i = 0;
  for (; i + lanes <= count; i += lanes)
  {
    for (int lane = 0; lane < lanes; ++lane)
    {
      partial[lane] += std::abs(double(a[i + lane]) - double(b[i + lane]));
    }
  }
  double sum = 0;
  for (const double part : partial)
  {
    sum += part;
  }
  for (; i < count; ++i)
  {
    sum += std::abs(double(a[i]) - b[i]);
  }
  return sum;
}

void ExactDifferences::Add(const std::vector<Differences>& all)
{
  constexpr std::size_t perPart = 4096;
  std::vector<ExactDifferences> parts((all.size() + perPart - 1) / perPart);
  ParallelFor(static_cast<Index>(parts.size()),
    [&](Index index)
    {
      const auto part = static_cast<std::size_t>(index);
      for (std::size_t i = part * perPart; i < std::min((part + 1) * perPart, all.size()); ++i)
      {
        parts[part].Add(all[i]);
      }
    });
  for (const ExactDifferences& part : parts)
  {
    *this += part;
  }
}
}
