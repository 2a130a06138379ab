// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What the steps of an optimisation take: as volumes grow, and with more threads.

#ifndef limpid_testing_benchmarks_ScalingTimes_h
#define limpid_testing_benchmarks_ScalingTimes_h

#include "TimedScene.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace limpid::benchmark
{
/// Nodes along each axis of the smallest volume that exponents are fitted to.
constexpr int smallestFitted = 64;

/// What is timed.
enum class Step
{
  Setup,     ///< the solver's constructor: checks, spans, rays, score and energy of the base
  FirstPass, ///< the first policy iteration
  Iteration, ///< from the third on: camera and light
  Adam,      ///< an Adam iteration at full resolution
  Score      ///< S seen from one of many directions, all threads busy with directions
};

constexpr std::array<Step, 5> allSteps{ { Step::Setup, Step::FirstPass, Step::Iteration, Step::Adam,
  Step::Score } };

std::string NameOf(Step step);

/// One value per step; 0: not measured.
struct StepTimes
{
  std::array<double, allSteps.size()> values{};

  double& operator[](Step step) { return this->values[std::size_t(step)]; }
  double operator[](Step step) const { return this->values[std::size_t(step)]; }
};

/// Medians [s] and, of them, the spreads.
struct StepResult
{
  StepTimes seconds;
  StepTimes spread;
};

/// Volumes of several sizes.
struct Series
{
  Filling filling = Filling::Dense;
  bool skip = true; ///< whether what is not needed is left out
  std::vector<int> sides;

  std::string Name() const { return NameOf(this->filling) + (this->skip ? "" : ", skips off"); }
};

struct SizeResult
{
  std::string scene;
  int side = 0; ///< nodes along each axis
  StepResult times;
};

/// Fits of time = factor * voxels^exponent; 0: not measured.
struct Exponents
{
  std::string scene;
  int smallest = 0; ///< side of the smallest volume that counts
  int largest = 0;
  StepTimes values;
};

struct ThreadResult
{
  std::string scene;
  Int3 nodes{ 0 };
  std::vector<int> threads; ///< 1, 2, 4 ...
  std::vector<StepResult> times;
  double cores = 0; ///< that the machine lent to all threads of pure arithmetic, median

  /// Of the last number of threads: t1 / (n tn).
  double Efficiency(Step step) const;
};

/// Largest side of a volume whose run fits into free memory.
int LargestThatFits();

/// All sizes in turns, with all threads. `say` tells the user what is being done.
std::vector<SizeResult> MeasureSizes(
  const Series& series, int repeats, const std::function<void(const std::string&)>& say);

/// Least squares in the logarithms, from `smallestFitted` on.
Exponents FitExponents(const std::string& name, const std::vector<SizeResult>& sizes);

/// All numbers of threads in turns.
ThreadResult MeasureThreads(const TimedScene& scene, int allThreads, int repeats);
}

#endif
