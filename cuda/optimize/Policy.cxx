// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Policy.h"

#include "backend/Backend.h"
#include "backend/ThreadTeam.h"
#include "optimize/PolicyIterations.h"
#include "optimize/PolicySweep.h"
#include "optimize/Terms.h"
#include "scene/LargePages.h"
#include "scene/NodeValues.h"

#include <algorithm>

namespace limpid
{
namespace
{
/// An iterate: the caller's values, which stay as they are, or values of its own.
class CpuIterate
{
public:
  CpuIterate() = default;
  explicit CpuIterate(const float* values)
    : Values(values)
  {
  }
  explicit CpuIterate(std::vector<float>&& values)
    : Given(std::move(values))
    , Values(this->Given.data())
  {
  }
  explicit CpuIterate(NodeValues&& values)
    : Own(std::move(values))
    , Values(this->Own.Data())
  {
  }

  const float* Data() const { return this->Values; }
  float* Room() { return this->Own.Data(); } ///< null: these are not to be overwritten

private:
  std::vector<float> Given;
  NodeValues Own;
  const float* Values = nullptr;
};

class PolicyOnCpu
{
public:
  using Field = CpuIterate;

  explicit PolicyOnCpu(const Problem& problem)
    : Work(&problem)
    , Seen(problem)
  {
  }

  const Problem& Task() const { return *this->Work; }

  /// Makes room for an iterate. Where sweeps do not come, and for rays of a frustum that meet
  /// voxels of one that is swept later, it has the values of the last one.
  void Prepare(Field& next, const Field& last) const
  {
    const bool fresh = !next.Room();
    if (fresh)
    {
      next = Field(NodeValues(this->Work->grid.NodeCount()));
    }
    if (fresh || this->FrustumCount() > 1)
    {
      this->CopyFilled(last.Data(), next.Room());
    }
  }

  const float* Values(const Field& field) const { return field.Data(); }

  const std::vector<float>& Read(const Field& field) const
  {
    const Index count = this->Work->grid.NodeCount();
    if (this->OnHost.empty())
    {
      this->OnHost = RoomFor(count);
    }
    this->OnHost.assign(field.Data(), field.Data() + count);
    return this->OnHost;
  }

  std::vector<float> Take(Field&& field) const
  {
    this->Read(field);
    return std::move(this->OnHost);
  }

  IterationRecord Start(const Field& first)
  {
    return this->Seen.Measure(*this->Work, first.Data());
  }

  IterationRecord Sweep(const Field& last, Field& next, bool trust, bool again)
  {
    const ThreadTeam team;
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
                                      : this->Seen.light->Forward(next.Data(), problem.importance);
    }
    IterationRecord record = RecordOf(problem, problem.Regularization(found.moved.squares), seen);
    record.meanChange = change;
    return record;
  }

private:
  bool Joint() const { return this->Seen.camera && this->Seen.light; }

  std::size_t FrustumCount() const
  {
    return (this->Seen.camera ? this->Seen.camera : this->Seen.light)->FrustumCount();
  }

  void CopyFilled(const float* from, float* to) const
  {
    const Int3& nodes = this->Work->grid.nodes;
    ParallelFor(Index(nodes.y) * nodes.z, 16,
      [&](Index row)
      {
        const auto y = static_cast<int>(row % nodes.y);
        const auto z = static_cast<int>(row / nodes.y);
        const Range<int> filled = this->Work->occupancy->Row(0, y, z).filled;
        std::copy_n(from + row * nodes.x + filled.begin, std::max(filled.end - filled.begin, 0),
          to + row * nodes.x + filled.begin);
      });
  }

  /// The policy sweep itself, of the camera or, without one, of the light.
  PolicyFound SweepOnce(const Field& last, Field& next, bool trust)
  {
    const Problem& problem = *this->Work;
    const Weights& weights = problem.settings.weights;
    const bool useLagged = !this->Lagged.Empty();
    PolicyTask task = TaskOf(
      problem, this->Seen.camera ? weights.view : weights.light, useLagged ? weights.light : 0.0);
    task.fields.extinction = last.Data();
    task.fields.lagged = useLagged ? this->Lagged.Data() : nullptr;
    task.fields.next = next.Room();
    task.trust = trust ? Trust::LastIterate : Trust::Clear;
    VisibilityTerm& swept = this->Seen.camera ? *this->Seen.camera : *this->Seen.light;
    const std::size_t frusta = swept.FrustumCount();
    PolicyFound sum;
    for (std::size_t index = 0; index < frusta; ++index)
    {
      const PolicyFound found = SweepPolicy(swept.FrustumAt(index), task, swept.ImagesAt(index));
      sum.moved += found.moved;
      if (MetNextIterate(index, frusta, task.derivative))
      {
        sum.met += found.met;
      }
    }
    for (std::size_t index = 0; index < frusta; ++index)
    {
      if (!MetNextIterate(index, frusta, task.derivative))
      {
        sum.met += swept.ForwardAt(index, next.Data(), problem.importance);
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
      { extinction.Data(), problem.importance, problem.nodeImportance },
      problem.settings.derivative, this->Lagged.Data());
  }

  const Problem* Work;
  Terms Seen;
  NodeValues Lagged;                 ///< T_L (V_L - g) of an iterate; empty: none
  bool LagIsFresh = false;           ///< whether that is the last iterate
  mutable std::vector<float> OnHost; ///< what was read last
};
}

std::unique_ptr<Minimizer> MakePolicy(const Problem& problem, std::vector<float>&& start, bool warm)
{
  CpuIterate first =
    start.empty() ? CpuIterate(problem.baseExtinction) : CpuIterate(std::move(start));
  return std::make_unique<PolicyIterations<PolicyOnCpu>>(
    PolicyOnCpu(problem), std::move(first), warm);
}
}
