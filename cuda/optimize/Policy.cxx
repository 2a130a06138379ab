// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Policy.h"

#include "optimize/PolicySweep.h"
#include "optimize/Terms.h"

#include <algorithm>
#include <array>

namespace limpid
{
namespace
{
class Policy : public Minimizer
{
public:
  Policy(const Problem& problem, std::vector<float>&& start, bool warm)
    : Task(problem)
    , Seen(problem)
    , Warm(warm)
  {
    this->Iterates[0] = std::move(start);
  }

  IterationRecord Start() override
  {
    const IterationRecord record = this->Seen.Measure(this->Task, this->Iterates[0]);
    this->BestEnergy = record.energy.Total();
    return record;
  }

  IterationRecord Iterate() override
  {
    const std::size_t last = this->Now;
    const std::size_t next = this->FreeIterate();
    this->Sweep(this->Iterates[last], this->Iterates[next]);
    ++this->Count;
    this->Now = next;
    IterationRecord record = this->Seen.Measure(this->Task, this->Iterates[next]);
    this->Change = this->Task.MeanChange(
      this->Iterates[last], this->Iterates[next], this->Task.occupancy->FilledVoxels());
    record.meanChange = this->Change;
    if (record.energy.Total() < this->BestEnergy)
    {
      this->BestEnergy = record.energy.Total();
      this->BestOf = next;
    }
    return record;
  }

  bool Converged() const override
  {
    return this->Count > 0 && this->Change < this->Task.settings.tolerance;
  }

  int IterationLimit() const override { return this->Task.settings.maximumIterations; }

  const std::vector<float>& Best() const override { return this->Iterates[this->BestOf]; }

  std::vector<float> TakeBest() override { return std::move(this->Iterates[this->BestOf]); }

private:
  /// A place for the next iterate that overwrites neither the last nor the best.
  std::size_t FreeIterate()
  {
    std::size_t free = 0;
    while (free == this->Now || free == this->BestOf)
    {
      ++free;
    }
    if (this->Iterates[free].empty())
    {
      this->Iterates[free] = this->Iterates[this->Now]; // empty voxels are not visited
    }
    return free;
  }

  void Sweep(const std::vector<float>& last, std::vector<float>& next)
  {
    const Weights& weights = this->Task.settings.weights;
    VisibilityTerm& swept = this->Seen.camera ? *this->Seen.camera : *this->Seen.light;
    const bool trust = this->Warm || this->Count > 0;
    const bool joint = this->Seen.camera && this->Seen.light;
    if (trust && joint)
    {
      this->Lagged.assign(last.size(), 0.0f);
      this->Seen.light->AddGradient(
        { last.data(), this->Task.importance, this->Task.nodeImportance },
        this->Task.settings.derivative, 1.0f, this->Lagged.data());
    }
    const bool useLagged = !this->Lagged.empty();
    PolicyTask task = TaskOf(this->Task, this->Seen.camera ? weights.view : weights.light,
      useLagged ? weights.light : 0.0);
    task.fields.extinction = last.data();
    task.fields.lagged = useLagged ? this->Lagged.data() : nullptr;
    task.fields.next = next.data();
    task.trust = trust ? Trust::LastIterate : Trust::Clear;
    for (std::size_t index = 0; index < swept.PyramidCount(); ++index)
    {
      SweepPolicy(swept.PyramidAt(index), task, swept.ImagesAt(index));
    }
  }

  const Problem& Task;
  Terms Seen;
  bool Warm;
  int Count = 0;
  double Change = 0;
  double BestEnergy = 0;
  std::array<std::vector<float>, 3> Iterates; ///< filled as needed
  std::size_t Now = 0;                        ///< the last iterate
  std::size_t BestOf = 0;                     ///< the best
  std::vector<float> Lagged;                  ///< T_L (V_L - g) of the last iterate; empty: none
};
}

std::unique_ptr<Minimizer> MakePolicy(const Problem& problem, std::vector<float>&& start, bool warm)
{
  return std::make_unique<Policy>(problem, std::move(start), warm);
}
}
