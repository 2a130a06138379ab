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
  Policy(const Problem& problem, Occupancy&& occupancy, std::vector<float>&& start, bool warm)
    : Task(problem)
    , Occupied(std::move(occupancy))
    , Seen(problem, this->Occupied)
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
      this->Iterates[last], this->Iterates[next], this->Occupied.FilledVoxels());
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
    // Without regularisation the optimum is bang-bang, which a large but finite gain gives, too.
    const double p = std::max(this->Task.RegularizationWeight(), 1e-30);
    const auto gainOf = [p](double weight)
    { return static_cast<float>(std::min(weight / p, 1e30)); };
    const bool useLagged = !this->Lagged.empty();
    PolicyTask task{};
    task.grid = &this->Task.grid;
    task.occupancy = &this->Occupied;
    task.voxel.gain = gainOf(this->Seen.camera ? weights.view : weights.light);
    task.voxel.lagGain = useLagged ? gainOf(weights.light) : 0.0f;
    task.voxel.majorant = this->Task.majorant;
    task.fields = { this->Task.baseExtinction, this->Task.importance, this->Task.nodeImportance,
      last.data(), useLagged ? this->Lagged.data() : nullptr, next.data() };
    task.trust = trust ? Trust::LastIterate : Trust::Clear;
    task.derivative = this->Task.settings.derivative;
    for (std::size_t index = 0; index < swept.PyramidCount(); ++index)
    {
      SweepPolicy(swept.PyramidAt(index), task, swept.ImagesAt(index));
    }
  }

  const Problem& Task;
  Occupancy Occupied;
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

std::unique_ptr<Minimizer> MakePolicy(
  const Problem& problem, Occupancy&& occupancy, std::vector<float>&& start, bool warm)
{
  return std::make_unique<Policy>(problem, std::move(occupancy), std::move(start), warm);
}
}
