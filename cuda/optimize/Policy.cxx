// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Policy.h"

#include "optimize/PolicyIterations.h"
#include "optimize/PolicySweep.h"
#include "optimize/Terms.h"
#include "scene/LargePages.h"
#include "scene/NodeValues.h"

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

  Field CopyOf(const Field& field) const
  {
    Field copy;
    copy.reserve(field.size());
    UseLargePages(copy.data(), field.size() * sizeof(float));
    copy.assign(field.begin(), field.end());
    return copy;
  }

  const std::vector<float>& Read(const Field& field) const { return field; }
  std::vector<float> Take(Field&& field) const { return std::move(field); }

  IterationRecord Start(const Field& first) { return this->Seen.Measure(*this->Work, first); }

  IterationRecord Sweep(const Field& last, Field& next, bool trust, bool again)
  {
    const Problem& problem = *this->Work;
    if (trust && this->Joint() && !this->LagIsFresh)
    {
      this->FindLagged(last);
    }
    const PolicyFound found = this->SweepOnce(last, next, trust);
    limpid::Seen seen;
    (this->Seen.camera ? seen.byCamera : seen.byLight) = found.met;
    const double change = problem.MeanChange(found.moved.changes);
    this->LagIsFresh = this->Joint() && again && !(change < problem.settings.tolerance);
    if (this->Joint())
    {
      seen.byLight = this->LagIsFresh ? this->FindLagged(next)
                                      : this->Seen.light->Forward(next.data(), problem.importance);
    }
    IterationRecord record = RecordOf(problem, problem.Regularization(found.moved.squares), seen);
    record.meanChange = change;
    return record;
  }

private:
  bool Joint() const { return this->Seen.camera && this->Seen.light; }

  /// The policy sweep itself, of the camera or, without one, of the light.
  PolicyFound SweepOnce(const Field& last, Field& next, bool trust)
  {
    const Problem& problem = *this->Work;
    const Weights& weights = problem.settings.weights;
    const bool useLagged = !this->Lagged.Empty();
    PolicyTask task = TaskOf(
      problem, this->Seen.camera ? weights.view : weights.light, useLagged ? weights.light : 0.0);
    task.fields.extinction = last.data();
    task.fields.lagged = useLagged ? this->Lagged.Data() : nullptr;
    task.fields.next = next.data();
    task.trust = trust ? Trust::LastIterate : Trust::Clear;
    VisibilityTerm& swept = this->Seen.camera ? *this->Seen.camera : *this->Seen.light;
    const std::size_t pyramids = swept.PyramidCount();
    PolicyFound sum;
    for (std::size_t index = 0; index < pyramids; ++index)
    {
      const PolicyFound found = SweepPolicy(swept.PyramidAt(index), task, swept.ImagesAt(index));
      sum.moved += found.moved;
      if (MetNextIterate(index, pyramids, task.derivative))
      {
        sum.met += found.met;
      }
    }
    for (std::size_t index = 0; index < pyramids; ++index)
    {
      if (!MetNextIterate(index, pyramids, task.derivative))
      {
        sum.met += swept.ForwardAt(index, next.data(), problem.importance);
      }
    }
    return sum;
  }

  Visible FindLagged(const Field& extinction)
  {
    const Problem& problem = *this->Work;
    if (this->Lagged.Empty())
    {
      this->Lagged = NodeValues(problem.grid.NodeCount());
    }
    return this->Seen.light->SetGradient(
      { extinction.data(), problem.importance, problem.nodeImportance },
      problem.settings.derivative, this->Lagged.Data());
  }

  const Problem* Work;
  Terms Seen;
  NodeValues Lagged;       ///< T_L (V_L - g) of an iterate; empty: none
  bool LagIsFresh = false; ///< whether that is the last iterate
};
}

std::unique_ptr<Minimizer> MakePolicy(const Problem& problem, std::vector<float>&& start, bool warm)
{
  return std::make_unique<PolicyIterations<PolicyOnCpu>>(
    PolicyOnCpu(problem), std::move(start), warm);
}
}
