// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Differences.h"

#include "backend/Simd.h"

#include <cmath>

namespace limpid
{
namespace
{
constexpr int lanes = 8; // partial sums, so that additions need not wait for each other
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
}
