// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_benchmarks_Timing_h
#define limpid_testing_benchmarks_Timing_h

#include <algorithm>
#include <chrono>
#include <vector>

namespace limpid::benchmark
{
/// Wall clock since its construction or the last Lap().
class Stopwatch
{
public:
  /// Seconds since the last lap; starts the next.
  double Lap()
  {
    const Clock::time_point now = Clock::now();
    const std::chrono::duration<double> seconds = now - this->Start;
    this->Start = now;
    return seconds.count();
  }

  /// Seconds since the last lap, which goes on.
  double Elapsed() const
  {
    return std::chrono::duration<double>(Clock::now() - this->Start).count();
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point Start = Clock::now();
};

/// Middle value, or the mean of the two in the middle; 0 of nothing.
inline double Median(std::vector<double> values)
{
  if (values.empty())
  {
    return 0;
  }
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

/// Range of the values over their median: how quiet the machine was.
inline double Spread(const std::vector<double>& values)
{
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return values.empty() ? 0 : (*most - *least) / Median(values);
}
}

#endif
