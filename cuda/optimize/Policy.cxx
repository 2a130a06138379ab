// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled twice, see CompiledDevice.h.

#include "optimize/Policy.h"

#include "backend/LargePages.h"
#include "sweep/Sweeps.h"

#include <algorithm>
#include <array>

namespace limpid
{
namespace
{
template <class AnyDevice>
PolicyKernel<const float*, float*> KernelOf(
  const Problem& problem, const ProblemFields<AnyDevice>& fields, const PolicySweep& sweep)
{
  // Without regularisation the optimum is bang-bang, which a large but finite gain gives, too.
  const double p = std::max(problem.RegularizationWeight(), 1e-30);
  const auto gainOf = [p](double weight) { return static_cast<float>(std::min(weight / p, 1e30)); };
  return { fields.base.Data(), fields.importance.Data(), fields.nodeImportance.Data(), sweep.last,
    sweep.lagged, sweep.next, { gainOf(sweep.weight), gainOf(1.0), BoundsOf(problem) },
    sweep.transmittance, problem.settings.derivative == Derivative::Volume, sweep.kept };
}

/// Sweeps one frustum. The processor sums what has `moved` while that is at hand; null: nobody
/// asks.
template <class AnyDevice>
void SweepFrustum(AnyDevice& device, FrustumRays<AnyDevice>& rays,
  [[maybe_unused]] const Occupancy& occupancy, const PolicyKernel<const float*, float*>& kernel,
  [[maybe_unused]] Differences* moved)
{
  if constexpr (AnyDevice::readsHostMemory)
  {
    std::vector<Differences> rows(std::size_t(rays.Plan().nodesV)); // of all slices
    SweepBackwardByPhases(device, rays, occupancy, kernel,
      [&rows, moved](const auto& voxels, const auto& windows, int v)
      {
        if (moved)
        {
          const Range<int>& filled = voxels.Filled();
          const float* next = voxels.Row(windows.next) + filled.begin;
          rows[std::size_t(v)] +=
            { SumOfSquares(next, voxels.Row(windows.base) + filled.begin, filled.Length()),
              SumOfChanges(next, voxels.Row(windows.last) + filled.begin, filled.Length()) };
        }
      });
    for (std::size_t v = 1; moved && v < rows.size(); ++v)
    {
      rows[0] += rows[v];
    }
    if (moved)
    {
      *moved += rows[0];
    }
  }
  else
  {
    SweepBackwardByPhases(device, rays, kernel);
  }
}

/// An extinction at all nodes; it may be the base extinction, which is not to be overwritten.
template <class AnyDevice>
struct Iterate
{
  DeviceArray<AnyDevice, float> own;
  const float* values = nullptr;
};

/// Makes sure that an iterate can be overwritten. Where sweeps do not come, and for rays that meet
/// voxels of a frustum that is swept later, it gets the values of the last one; the processor
/// copies only what is filled: all else is 0.
template <class AnyDevice>
void Prepare(const std::shared_ptr<AnyDevice>& device, const Problem& problem, std::size_t frusta,
  const float* last, Iterate<AnyDevice>& next)
{
  const auto count = static_cast<std::size_t>(problem.grid.NodeCount());
  const bool fresh = next.own.Empty();
  if (fresh)
  {
    next.own = DeviceArray<AnyDevice, float>::Zeros(device, count, "an iterate");
    next.values = next.own.Data();
  }
  if (!AnyDevice::readsHostMemory && (fresh || frusta > 1))
  {
    device->Copy(next.own.Data(), last, count * sizeof(float));
  }
  else if (frusta > 1)
  {
    problem.CopyFilled(last, next.own.Data());
  }
}

template <class AnyDevice>
class Policy : public Minimizer
{
public:
  Policy(const std::shared_ptr<AnyDevice>& device, const Problem& problem,
    const std::vector<float>& start, bool warm)
    : Given(&problem)
    , Device(device)
    , Energy(device, problem)
    , Warm(warm)
  {
    if (start.empty())
    {
      this->Iterates[0].values = this->Energy.Fields().base.Data();
      return;
    }
    this->Iterates[0].own = { device, start, "an iterate" };
    this->Iterates[0].values = this->Iterates[0].own.Data();
  }

  IterationRecord Start() override
  {
    const IterationRecord record = this->MeasureFirst();
    this->BestEnergy = record.energy.Total();
    return record;
  }

  Score BaseScore() const override { return this->Energy.BaseScore(); }

  IterationRecord Iterate() override
  {
    [[maybe_unused]] const typename AnyDevice::Team team;
    this->OnHost.clear();
    const std::size_t free = this->FreeIterate();
    const float* last = this->Iterates[this->Now].values;
    limpid::Iterate<AnyDevice>& next = this->Iterates[free];
    Prepare(this->Device, *this->Given, this->Swept().Frusta().size(), last, next);
    const Transmittance transmittance =
      this->Warm || this->Count > 0 ? Transmittance::OfLastIterate : Transmittance::AssumeOne;
    ++this->Count;
    const IterationRecord record = this->Sweep(last, next.own.Data(), transmittance);
    this->Now = free;
    this->Change = record.meanChange;
    if (record.energy.Total() < this->BestEnergy)
    {
      this->BestEnergy = record.energy.Total();
      this->BestOf = free;
    }
    return record;
  }

  bool Converged() const override
  {
    return this->Count > 0 && this->Change < this->Given->settings.tolerance;
  }

  int IterationLimit() const override { return this->Given->settings.maximumIterations; }

  const float* BestValues() const override
  {
    return AnyDevice::readsHostMemory ? this->Iterates[this->BestOf].values : this->Best().data();
  }

  const std::vector<float>& Best() const override
  {
    if (this->OnHost.empty())
    {
      this->OnHost = RoomFor(this->Given->grid.NodeCount());
      this->OnHost.resize(static_cast<std::size_t>(this->Given->grid.NodeCount()));
      this->Device->Download(this->OnHost.data(), this->Iterates[this->BestOf].values,
        this->OnHost.size() * sizeof(float));
    }
    return this->OnHost;
  }

  std::vector<float> TakeBest() override
  {
    this->Best();
    return std::move(this->OnHost);
  }

private:
  /// The term that is swept: the camera's or, without one, the light's.
  VisibilityTerm<AnyDevice>& Swept()
  {
    return this->Energy.camera ? *this->Energy.camera : *this->Energy.light;
  }

  IterationRecord MeasureFirst()
  {
    if (this->Iterates[0].own.Empty())
    {
      return this->Energy.MeasureBase();
    }
    this->Energy.SeeBase();
    return this->Energy.Measure(this->Iterates[0].values);
  }

  /// A place for the next iterate that overwrites neither the last nor the best.
  std::size_t FreeIterate() const
  {
    std::size_t free = 0;
    while (free == this->Now || free == this->BestOf)
    {
      ++free;
    }
    return free;
  }

  /// One policy sweep, and what the next iterate is worth.
  IterationRecord Sweep(const float* last, float* next, Transmittance transmittance)
  {
    const bool lags = this->Energy.HasLagged();
    if (transmittance == Transmittance::OfLastIterate && lags && !this->LagIsFresh)
    {
      this->FindLagged(last);
    }
    this->SweepOnce(last, next, transmittance);
    const bool again = this->Count < this->IterationLimit();
    this->LagIsFresh =
      lags && again && !(this->Energy.MeanChange() < this->Given->settings.tolerance);
    if (this->LagIsFresh)
    {
      this->FindLagged(next); // sees the next iterate along the way
    }
    else if (lags)
    {
      this->Energy.MeasureLagged(next);
    }
    return this->Energy.Record();
  }

  void SweepOnce(const float* last, float* next, Transmittance transmittance)
  {
    const Weights& weights = this->Given->settings.weights;
    Differences moved;
    const Kept kept = this->Energy.camera ? Kept::Counted : Kept::Ignored;
    SweepPolicy(*this->Device, this->Swept(), *this->Given, this->Energy.Fields(),
      { last, this->Lagged.Data(), next, this->Energy.camera ? weights.view : weights.light,
        transmittance, kept },
      moved);
    if constexpr (AnyDevice::readsHostMemory)
    {
      this->Energy.Sums()->moved = moved;
    }
    else
    {
      this->Energy.SumChanges(next, last);
      this->Energy.SumSquares(next);
    }
    const std::size_t frusta = this->Swept().Frusta().size();
    const bool lastFirst = MetNextIterate(frusta - 1, frusta, this->Given->settings.derivative);
    this->Swept().Sum(
      this->Energy.camera ? &this->Energy.Sums()->camera : &this->Energy.Sums()->light, kept,
      lastFirst ? frusta - 1 : 0);
  }

  void FindLagged(const float* extinction)
  {
    if (this->Lagged.Empty())
    {
      this->Lagged = DeviceArray<AnyDevice, float>::Zeros(this->Device,
        static_cast<std::size_t>(this->Given->grid.NodeCount()), "the lagged derivative");
    }
    this->Energy.DifferentiateLagged(extinction, this->Lagged.Data());
  }

  const Problem* Given;
  std::shared_ptr<AnyDevice> Device;
  Terms<AnyDevice> Energy;
  bool Warm;
  int Count = 0;
  double Change = 0;
  double BestEnergy = 0;
  std::array<limpid::Iterate<AnyDevice>, 3> Iterates; ///< filled as needed
  std::size_t Now = 0;                                ///< the last iterate
  std::size_t BestOf = 0;                             ///< the best
  DeviceArray<AnyDevice, float> Lagged; ///< derivative of the other terms; empty: none
  bool LagIsFresh = false;              ///< whether that is the last iterate
  mutable std::vector<float> OnHost;    ///< the best; empty: not read yet
};
}

template <class AnyDevice>
void SweepPolicy(AnyDevice& device, VisibilityTerm<AnyDevice>& term, const Problem& problem,
  const ProblemFields<AnyDevice>& fields, const PolicySweep& sweep, Differences& moved)
{
  const PolicyKernel<const float*, float*> kernel = KernelOf(problem, fields, sweep);
  const std::size_t frusta = term.Frusta().size();
  for (FrustumRays<AnyDevice>& rays : term.Frusta())
  {
    SweepFrustum(device, rays, term.Occupied(), kernel, &moved);
    rays.KeepCollected();
  }
  for (std::size_t index = 0; index < frusta; ++index)
  {
    if (!MetNextIterate(index, frusta, problem.settings.derivative))
    {
      term.ForwardAt(index,
        { sweep.next, fields.importance.Data(), fields.nodeImportance.Data(),
          sweep.kept == Kept::Counted ? fields.base.Data() : nullptr });
    }
  }
}

template <class AnyDevice>
void SweepFirstPolicy(AnyDevice& device, VisibilityTerm<AnyDevice>& term, const Problem& problem,
  const ProblemFields<AnyDevice>& fields, double weight, float* next)
{
  const PolicyKernel<const float*, float*> kernel = KernelOf(problem, fields,
    { fields.base.Data(), nullptr, next, weight, Transmittance::AssumeOne, Kept::Ignored });
  for (FrustumRays<AnyDevice>& rays : term.Frusta())
  {
    SweepFrustum(device, rays, term.Occupied(), kernel, nullptr);
  }
}

template <class AnyDevice>
std::unique_ptr<Minimizer> MakePolicy(const std::shared_ptr<AnyDevice>& device,
  const Problem& problem, const std::vector<float>& start, bool warm)
{
  return std::make_unique<Policy<AnyDevice>>(device, problem, start, warm);
}

#define LIMPID_INSTANTIATE_POLICY(AnyDevice)                                                       \
  template void SweepPolicy(AnyDevice&, VisibilityTerm<AnyDevice>&, const Problem&,                \
    const ProblemFields<AnyDevice>&, const PolicySweep&, Differences&);                            \
  template void SweepFirstPolicy(AnyDevice&, VisibilityTerm<AnyDevice>&, const Problem&,           \
    const ProblemFields<AnyDevice>&, double, float*);                                              \
  template std::unique_ptr<Minimizer> MakePolicy(                                                  \
    const std::shared_ptr<AnyDevice>&, const Problem&, const std::vector<float>&, bool);
LIMPID_FOR_EACH_COMPILED_DEVICE(LIMPID_INSTANTIATE_POLICY)
}
