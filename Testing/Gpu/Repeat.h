// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Repeating and timing.

#ifndef limpid_testing_gpu_Repeat_h
#define limpid_testing_gpu_Repeat_h

#include "Measure.h"
#include "Timing.h"

#include <exception>
#include <vector>

namespace limpid::benchmark
{
/// What `measure` returns, or why it could not.
template <class Work>
Figure Try(const Work& measure)
{
  try
  {
    return measure();
  }
  catch (const std::exception& error)
  {
    Figure figure;
    figure.missing = error.what();
    return figure;
  }
}

inline Figure FigureOf(const std::vector<double>& seconds)
{
  Figure figure;
  figure.seconds = Median(seconds);
  figure.spread = Spread(seconds);
  figure.repetitions = static_cast<int>(seconds.size());
  figure.missing.clear();
  return figure;
}

/// Times `work`, which waits for the device itself, after some runs that do not count.
template <class Work>
Figure Repeat(const Effort& effort, int warmUps, const Work& work)
{
  for (int run = 0; run < warmUps; ++run)
  {
    work();
  }
  std::vector<double> seconds;
  double total = 0;
  while (static_cast<int>(seconds.size()) < effort.repetitions && total < effort.mostSeconds)
  {
    Stopwatch watch;
    work();
    seconds.push_back(watch.Lap());
    total += seconds.back();
  }
  return FigureOf(seconds);
}
}

#endif
