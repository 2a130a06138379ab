// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What takes how long on the GPU. Its sources are compiled twice, see TestedDevice.h: with the
// processor in the role of a GPU they show whether this program works. Times are seconds; what
// could not be measured says why, as "missing".

#ifndef limpid_testing_gpu_Measure_h
#define limpid_testing_gpu_Measure_h

#include "Program.h"
#include "SceneForSolver.h"

#include <exception>
#include <functional>
#include <memory>

namespace limpid::benchmark
{
struct Effort
{
  int repetitions = 30;   ///< of short things, at most
  double mostSeconds = 2; ///< no further repetition of a thing after [s]
  int directions = 642;   ///< of the viewpoint search
  int pictureSide = 1024; ///< [pixels]
  int copySize = 1 << 30; ///< of what is copied to learn the rate [bytes]

  Effort With(int repetitionsAtMost) const
  {
    Effort effort = *this;
    effort.repetitions = repetitionsAtMost;
    return effort;
  }
};

/// Name and copy rate of the GPU.
Json MeasureDevice(const Effort& effort);

/// Measures steps of a scene, what matters most first; `save` is called after each. `parts`: some
/// of policy, frame, set-up, adam, processor, sphere; empty: all.
void MeasureScene(const SceneForSolver& scene, const Effort& effort,
  const std::vector<std::string>& parts, Json& result, const std::function<void()>& save);

/// What `measure` returns, or why it could not.
template <class Work>
Json Try(const Work& measure)
{
  try
  {
    return measure();
  }
  catch (const std::exception& error)
  {
    return { { "missing", error.what() } };
  }
}

/// Times `work`, which waits for the device itself, after some runs that do not count.
template <class Work>
Json Repeat(const Effort& effort, int warmUps, const Work& work)
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
