// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Policy.h"

#include "optimize/PolicyIterations.h"
#include "optimize/PolicySweep.h"
#include "optimize/Terms.h"

namespace limpid
{
namespace
{
class PolicyOnCpu
{
public:
  using Field = std::vector<float>;

  explicit PolicyOnCpu(const Problem& problem)
    : Work(&problem)
    , Seen(problem)
  {
  }

  const Problem& Task() const { return *this->Work; }
  bool IsEmpty(const Field& field) const { return field.empty(); }
  Field CopyOf(const Field& field) const { return field; }
  const std::vector<float>& Read(const Field& field) const { return field; }
  std::vector<float> Take(Field&& field) const { return std::move(field); }

  IterationRecord Measure(const Field& now, const Field* before)
  {
    IterationRecord record = this->Seen.Measure(*this->Work, now);
    if (before)
    {
      record.meanChange =
        this->Work->MeanChange(*before, now, this->Work->occupancy->FilledVoxels());
    }
    return record;
  }

  void Sweep(const Field& last, Field& next, bool trust)
  {
    const Problem& problem = *this->Work;
    const Weights& weights = problem.settings.weights;
    VisibilityTerm& swept = this->Seen.camera ? *this->Seen.camera : *this->Seen.light;
    const bool joint = this->Seen.camera && this->Seen.light;
    if (trust && joint)
    {
      this->Lagged.assign(last.size(), 0.0f);
      this->Seen.light->AddGradient({ last.data(), problem.importance, problem.nodeImportance },
        problem.settings.derivative, 1.0f, this->Lagged.data());
    }
    const bool useLagged = !this->Lagged.empty();
    PolicyTask task = TaskOf(
      problem, this->Seen.camera ? weights.view : weights.light, useLagged ? weights.light : 0.0);
    task.fields.extinction = last.data();
    task.fields.lagged = useLagged ? this->Lagged.data() : nullptr;
    task.fields.next = next.data();
    task.trust = trust ? Trust::LastIterate : Trust::Clear;
    for (std::size_t index = 0; index < swept.PyramidCount(); ++index)
    {
      SweepPolicy(swept.PyramidAt(index), task, swept.ImagesAt(index));
    }
  }

private:
  const Problem* Work;
  Terms Seen;
  std::vector<float> Lagged; ///< T_L (V_L - g) of the last iterate; empty: none
};
}

std::unique_ptr<Minimizer> MakePolicy(const Problem& problem, std::vector<float>&& start, bool warm)
{
  return std::make_unique<PolicyIterations<PolicyOnCpu>>(
    PolicyOnCpu(problem), std::move(start), warm);
}
}
