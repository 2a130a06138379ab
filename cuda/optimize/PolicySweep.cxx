// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled for each device, see CompiledDevice.h.

#include "optimize/PolicySweep.h"

#include "sweep/Sweeps.h"

#include <algorithm>
#include <vector>

namespace limpid
{
namespace
{
template <class AnyDevice>
PolicyKernel<const float*, float*> KernelOf(
  const Problem& problem, const ProblemFields<AnyDevice>& fields, const PolicySweep& sweep)
{
  const PullsOfKernel pulls(sweep.pulls, fields.base.Data());
  const double p = std::max(pulls.all, leastPull);
  const auto gainOf = [p](double weight) { return static_cast<float>(std::min(weight / p, 1e30)); };
  PolicyKernel<const float*, float*> kernel;
  kernel.base = fields.base.Data();
  kernel.importance = fields.importance.Data();
  kernel.nodeImportance = fields.nodeImportance.Data();
  kernel.last = sweep.last;
  kernel.lagged = sweep.lagged;
  kernel.next = sweep.next;
  kernel.alternative = sweep.alternative;
  kernel.policy.gain = gainOf(sweep.weight);
  kernel.policy.lagGain = gainOf(1.0);
  kernel.policy.bounds = BoundsOf(problem);
  kernel.policy.bounds.emphasis = sweep.emphasises ? kernel.policy.bounds.emphasis : 0.0f;
  for (std::size_t i = 0; i < mostReferences; ++i)
  {
    kernel.references[i] = pulls.references[i];
    kernel.policy.shares[i] = static_cast<float>(pulls.weights[i] / p);
  }
  kernel.transmittance = sweep.transmittance;
  kernel.areaWeighted = problem.settings.derivative == Derivative::Volume;
  kernel.kept = sweep.kept;
  kernel.priceOfSquare = 0.5f / kernel.policy.gain;
  return kernel;
}

/// Sweeps one frustum.
template <class AnyDevice, class Kernel>
void SweepFrustum(AnyDevice& device, FrustumRays<AnyDevice>& rays, const Occupancy&,
  const Kernel& kernel, ExactDifferences*)
{
  SweepBackwardByPhases(device, rays, kernel);
}

/// On the processor, distances are added to `moved` in the same pass, unless it is null.
template <class Kernel>
void SweepFrustum(HostDevice& device, FrustumRays<HostDevice>& rays, const Occupancy& occupancy,
  const Kernel& kernel, ExactDifferences* moved)
{
  const FaceFrustum& plan = rays.Plan();
  // [slice][voxel row]
  std::vector<Differences> rows(
    moved ? std::size_t(plan.SliceCount()) * std::size_t(plan.nodesV) : 0);
  SweepBackwardByPhases(device, rays, occupancy, kernel,
    [&rows, &plan, moved](const auto& voxels, const auto& windows, int v)
    {
      if (moved)
      {
        const Range<int>& filled = voxels.Filled();
        const float* next = voxels.Row(windows.next) + filled.begin;
        const auto squaresFrom = [&](const auto& field)
        { return SumOfSquares(next, voxels.Row(field) + filled.begin, filled.Length()); };
        const Index slice = &voxels.SliceHere() - &plan.SliceAt(0);
        Differences& row = rows[std::size_t(slice * plan.nodesV + v)];
        row.changes = SumOfChanges(next, voxels.Row(windows.last) + filled.begin, filled.Length());
        row.squares[0] = squaresFrom(windows.base);
        for (std::size_t i = 0; i < mostReferences && windows.references[i]; ++i)
        {
          row.squares[i + 1] = squaresFrom(windows.references[i]);
        }
      }
    });
  if (moved)
  {
    moved->Add(rows);
  }
}
}

template <class AnyDevice>
void SweepPolicy(AnyDevice& device, EnergyTerm<AnyDevice>& term, const Terms<AnyDevice>& terms,
  const Problem& problem, const PolicySweep& sweep, ExactDifferences& moved)
{
  const ProblemFields<AnyDevice>& fields = terms.Fields();
  const PolicyKernel<const float*, float*> kernel = KernelOf(problem, fields, sweep);
  const std::size_t frusta = term.Frusta().size();
  for (FrustumRays<AnyDevice>& rays : term.Frusta())
  {
    if (sweep.alternative && sweep.reach == Reach::Unlimited)
    {
      device.ForIndices("start rays", rays.Plan().RayCount(), StartReach{ rays.States() });
    }
    SweepFrustum(device, rays, term.Occupied(), kernel, &moved);
    rays.KeepCollected();
    terms.Distribution().ShareFrustum(
      sweep.next, term.Number(), std::size_t(&rays - term.Frusta().data()));
  }
  for (std::size_t index = 0; sweep.tellsAfter && index < frusta; ++index)
  {
    // Policy sweeps do not resolve thick layers.
    if (sweep.alternative || problem.MayHaveThickLayers(term.Rays()) ||
      !MetNextIterate(index, frusta, problem.settings.derivative))
    {
      term.ForwardAt(index,
        { sweep.next, fields.importance.Data(), fields.nodeImportance.Data(),
          sweep.kept == Kept::Counted ? fields.base.Data() : nullptr });
    }
  }
}

template <class AnyDevice>
void SweepFirstPolicy(AnyDevice& device, VisibilityTerm<AnyDevice>& term, const Problem& problem,
  const ProblemFields<AnyDevice>& fields, const std::vector<Pull>& pulls, double weight,
  float* next)
{
  const PolicySweep sweep{ fields.base.Data(), nullptr, next, weight, pulls,
    Transmittance::AssumeOne, Kept::Ignored };
  const PolicyKernel<const float*, float*> kernel = KernelOf(problem, fields, sweep);
  for (FrustumRays<AnyDevice>& rays : term.Frusta())
  {
    SweepFrustum(device, rays, term.Occupied(), kernel, nullptr);
  }
}

template void SweepPolicy(CompiledDevice&, EnergyTerm<CompiledDevice>&,
  const Terms<CompiledDevice>&, const Problem&, const PolicySweep&, ExactDifferences&);
template void SweepFirstPolicy(CompiledDevice&, VisibilityTerm<CompiledDevice>&, const Problem&,
  const ProblemFields<CompiledDevice>&, const std::vector<Pull>&, double, float*);
}
