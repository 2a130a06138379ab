// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled for each device, see CompiledDevice.h.

#include "optimize/SolverBackend.h"

#include "energy/NodeTransmittance.h"
#include "energy/TransmittanceSweep.h"
#include "optimize/Adam.h"
#include "optimize/ClosedForm.h"
#include "optimize/Permuted.h"
#include "optimize/Policy.h"
#include "optimize/PolicySweep.h"

#include <optional>
#include <utility>

namespace limpid
{
namespace
{
template <class AnyDevice>
class SweepsOn : public SourceSweeps
{
public:
  SweepsOn(
    const std::shared_ptr<AnyDevice>& device, const Problem& problem, const RaySource& source)
    : Given(problem)
    , Device(device)
    , Fields(ProblemFields<AnyDevice>::Of(device, problem))
    , Pulls(device, problem, this->Fields->base.Data())
    , Term(
        device, problem.grid, *problem.occupancy, source, problem.settings.rayDensity, problem.fine)
    , Sum(DeviceArray<AnyDevice, Seen>::Zeros(device, 1, "sums"))
  {
  }

  Score ScoreOf(const ExtinctionInPlace& extinction) override
  {
    const float* base = this->Fields->base.Data();
    if (!this->Base)
    {
      this->Base = this->See(base, nullptr).all;
    }
    if (extinction.values == this->Given.baseExtinction || extinction.values == base)
    {
      return ScoreOfBase(*this->Base);
    }
    if (const auto see = PassesOf<AnyDevice>(this->Given.settings.method).see)
    {
      return limpid::ScoreOf(
        see(SceneOf(this->Device, this->Given, *this->Fields)), this->Base->unattenuated);
    }
    if (extinction.onDevice)
    {
      return limpid::ScoreOf(this->See(extinction.values, base), this->Base->unattenuated);
    }
    const BorrowedArray<AnyDevice, float> field(this->Device, extinction.values,
      static_cast<std::size_t>(this->Given.grid.NodeCount()), "the extinction");
    return limpid::ScoreOf(this->See(field.Data(), base), this->Base->unattenuated);
  }

  Ceiling CeilingOf(const float* least, const MostExtinction<float>& most) override
  {
    const auto count = static_cast<std::size_t>(this->Given.grid.NodeCount());
    const BorrowedArray<AnyDevice, float> bound(
      this->Device, least, least ? count : 0, "the lower bound of the extinction");
    const CeilingFields fields{ this->Fields->base.Data(), this->Fields->importance.Data(),
      bound.Data(), most };
    this->Term.FindCeiling(fields, this->Sum.Data());
    Seen seen;
    this->Sum.Download(&seen);
    return limpid::CeilingOf(seen, fields.CountsKept());
  }

  void SweepPolicyOnce(double weight, std::vector<float>& next) override
  {
    ResultArray<AnyDevice, float> there(this->Device, next.data(), next.size(), "the extinction");
    there.Upload();
    SweepFirstPolicy(*this->Device, this->Term, this->Given, *this->Fields, this->Pulls.All(),
      weight, there.Data());
    there.Download();
  }

private:
  /// `base`: null if kept base extinction is not counted.
  Seen See(const float* extinction, const float* base)
  {
    this->Term.Forward(
      { extinction, this->Fields->importance.Data(), nullptr, base }, this->Sum.Data());
    Seen seen;
    this->Sum.Download(&seen);
    return seen;
  }

  const Problem& Given;
  std::shared_ptr<AnyDevice> Device;
  std::shared_ptr<ProblemFields<AnyDevice>> Fields;
  PullsOnDevice<AnyDevice> Pulls;
  VisibilityTerm<AnyDevice> Term;
  DeviceArray<AnyDevice, Seen> Sum;
  std::optional<Visible> Base; ///< empty before the first sweep
};

template <class AnyDevice>
std::unique_ptr<Minimizer> MakeMinimizerOn(const std::shared_ptr<AnyDevice>& device,
  const Problem& problem, StartingExtinction&& start, bool warm)
{
  if (!InfoOf(problem.settings.method).iterates)
  {
    return MakeClosedForm(device, problem);
  }
  if (problem.settings.solver == SolverKind::Policy)
  {
    return MakePolicy(device, problem, std::exchange(start, {}), warm); // it has a copy
  }
  return MakeAdam(
    problem, std::move(start),
    [device](const Problem& level, const StartingExtinction& first)
    { return MakeAdamLevel(device, level, first); },
    [device, &problem](const std::vector<float>& first)
    { return MakePolicy(device, problem, first, true); });
}

template <class AnyDevice>
class SolverBackendOn : public SolverBackend
{
public:
  explicit SolverBackendOn(std::shared_ptr<AnyDevice> device)
    : Device(std::move(device))
  {
  }

  std::unique_ptr<Minimizer> MakeMinimizer(
    const Problem& problem, StartingExtinction&& start, bool warm) override
  {
    const auto make = [this, warm](const Problem& inside, StartingExtinction&& first)
    { return MakeMinimizerOn(this->Device, inside, std::move(first), warm); };
    return MakePermuted(problem, FastestOrder(*this->Device, problem), std::move(start), make);
  }

  std::unique_ptr<SourceSweeps> SweepsFrom(const Problem& problem, const RaySource& source) override
  {
    return std::make_unique<SweepsOn<AnyDevice>>(this->Device, problem, source);
  }

  void FindByMethod(const Problem& problem, std::vector<float>& extinction) override
  {
    const auto fields = ProblemFields<AnyDevice>::Of(this->Device, problem);
    ResultArray<AnyDevice, float> there(
      this->Device, extinction.data(), extinction.size(), "the extinction");
    there.Upload();
    limpid::FindByMethod(this->Device, problem, *fields, there.Data());
    there.Download();
  }

  void FindTransmittance(const Problem& problem, const RaySource& source, double rayDensity,
    const float* extinction, float* transmittance) override
  {
    const auto count = static_cast<std::size_t>(problem.grid.NodeCount());
    const BorrowedArray<AnyDevice, float> field(this->Device, extinction, count, "the extinction");
    const Occupancy occupancy(problem.grid, extinction, extinction, true);
    TransmittanceSweep<AnyDevice> volume(this->Device, problem.grid, occupancy, source, rayDensity);
    ResultArray<AnyDevice, float> result(this->Device, transmittance, count, "the transmittance");
    if (!problem.IsThick())
    {
      volume.Fill(field.Data(), result.Data());
    }
    else
    {
      DeviceArray<AnyDevice, float> swept(this->Device, count, "the transmittance of a sweep");
      volume.Fill(field.Data(), swept.Data());
      RefineTransmittance(
        *this->Device, problem.grid, source, field.Data(), swept.Data(), result.Data());
    }
    result.Download();
  }

private:
  std::shared_ptr<AnyDevice> Device;
};
}

template <class AnyDevice>
std::unique_ptr<SolverBackend> MakeSolverBackend(std::shared_ptr<AnyDevice> device)
{
  return std::make_unique<SolverBackendOn<AnyDevice>>(std::move(device));
}

template std::unique_ptr<SolverBackend> MakeSolverBackend(std::shared_ptr<CompiledDevice>);
}
