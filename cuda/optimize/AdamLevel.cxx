// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/AdamLevel.h"

#include "backend/Backend.h"
#include "backend/ThreadTeam.h"
#include "optimize/Sums.h"
#include "optimize/Terms.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
AdamVoxel<float> AdamStep(const Problem& problem, int count)
{
  const Settings& settings = problem.settings;
  AdamVoxel<float> body{};
  body.regularization = static_cast<float>(problem.RegularizationWeight());
  body.step =
    static_cast<float>(settings.learningRate * problem.majorant / (1.0 - std::pow(0.9, count)));
  body.secondCorrection = static_cast<float>(1.0 / (1.0 - std::pow(0.999, count)));
  body.floor = static_cast<float>(1e-6 * std::max(settings.weights.view, settings.weights.light));
  body.majorant = problem.majorant;
  return body;
}

namespace
{
LIMPID_MULTIVERSION
void StepRange(const AdamVoxel<float>& body, Index begin, Index end)
{
  const AdamVoxel<float> voxel = body;
#pragma GCC ivdep
  for (Index i = begin; i < end; ++i)
  {
    voxel(i);
  }
}

/// A step in [begin, end). Returns the sum of the changes [1/length].
double StepBlock(const AdamVoxel<float>& body, Index begin, Index end)
{
  constexpr Index chunk = 1024;
  float before[chunk];
  double sum = 0;
  for (Index first = begin; first < end; first += chunk)
  {
    const Index last = std::min(first + chunk, end);
    std::copy(body.extinction + first, body.extinction + last, before);
    StepRange(body, first, last);
    sum += SumOfChanges(body.extinction + first, before, last - first);
  }
  return sum;
}

class LevelOnCpu : public AdamLevel
{
public:
  LevelOnCpu(const Problem& problem, std::vector<float>&& start)
    : Task(problem)
    , Seen(problem)
    , Now(std::move(start))
  {
  }

  IterationRecord Measure() override { return this->Seen.Measure(this->Task, this->Now.data()); }

  IterationRecord Step(int count) override
  {
    const ThreadTeam team;
    if (this->Gradient.empty())
    {
      this->Gradient.resize(this->Now.size());
      this->First.assign(this->Now.size(), 0.0f);
      this->Second.assign(this->Now.size(), 0.0f);
      this->FindGradient();
    }
    AdamVoxel<float> body = AdamStep(this->Task, count);
    body.gradient = this->Gradient.data();
    body.base = this->Task.baseExtinction;
    body.first = this->First.data();
    body.second = this->Second.data();
    body.extinction = this->Now.data();
    const double sum = ParallelBlockSum(this->Task.grid.NodeCount(),
      [&](Index begin, Index end) { return StepBlock(body, begin, end); });
    IterationRecord record = this->FindGradient();
    record.meanChange = this->Task.MeanChange(sum);
    return record;
  }

  std::vector<float> Extinction() override { return this->Now; }
  void KeepBest() override { this->Kept = this->Now; }
  const std::vector<float>& Best() override { return this->Kept; }
  std::vector<float> TakeBest() override { return std::move(this->Kept); }

private:
  /// For the next step, along with the record of the present extinction.
  IterationRecord FindGradient()
  {
    std::fill(this->Gradient.begin(), this->Gradient.end(), 0.0f);
    return this->Seen.AddGradient(this->Task, this->Now, this->Gradient);
  }

  const Problem& Task;
  Terms Seen;
  std::vector<float> Now;
  std::vector<float> Kept;
  std::vector<float> Gradient; ///< empty: there was no step yet
  std::vector<float> First;
  std::vector<float> Second;
};
}

std::unique_ptr<AdamLevel> MakeAdamLevel(const Problem& problem, std::vector<float>&& start)
{
  return std::make_unique<LevelOnCpu>(problem, std::move(start));
}
}
