// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled twice, see CompiledDevice.h.

#include "optimize/PolicyOnDevice.h"

#include "optimize/PolicyIterations.h"
#include "optimize/PolicyPhases.h"

namespace limpid
{
template <class Device>
void SweepPolicyOnDevice(Device& device, TermOnDevice<Device>& term,
  const FieldsOnDevice<Device>& scene, const PolicyTask& task)
{
  for (std::size_t index = 0; index < term.Frusta().size(); ++index)
  {
    RaysOnDevice<Device>& rays = term.Frusta()[index];
    rays.Reset();
    const PolicyPhases phases{ rays.Plan().View(), rays.States(), task.voxel,
      task.trust == Trust::LastIterate, task.derivative == Derivative::Volume, scene.base.Data(),
      scene.importance.Data(), scene.nodeImportance.Data(), task.fields.extinction,
      task.fields.lagged, task.fields.next, term.TotalsOf(index) };
    device.ForPhases("policy sweep", phases.PhaseCount(), phases);
    rays.KeepCollected();
  }
}

namespace
{
template <class Device>
class PolicyEngine
{
public:
  using Field = DeviceArray<Device, float>;

  PolicyEngine(const std::shared_ptr<Device>& device, const Problem& problem)
    : Work(&problem)
    , Home(device)
    , Seen(FieldsOnDevice<Device>::Of(device, problem), problem)
  {
  }

  const Problem& Task() const { return *this->Work; }
  void Prepare(Field& next, const Field& last) const
  {
    if (next.Empty())
    {
      next = this->CopyOf(last);
    }
    else if (this->FrustumCount() > 1)
    {
      next.CopyFrom(last);
    }
  }

  Field CopyOf(const Field& field) const
  {
    Field copy(this->Home, field.Size(), "an iterate");
    copy.CopyFrom(field);
    return copy;
  }

  const float* Values(const Field& field) const { return this->Read(field).data(); }

  const std::vector<float>& Read(const Field& field) const
  {
    if (this->Readable != field.Data())
    {
      this->OnHost.resize(field.Size());
      field.Download(this->OnHost.data());
      this->Readable = field.Data();
    }
    return this->OnHost;
  }

  std::vector<float> Take(Field&& field) const
  {
    this->Read(field);
    this->Readable = nullptr;
    return std::move(this->OnHost);
  }

  IterationRecord Start(const Field& first) { return this->Seen.Measure(*this->Work, first); }

  IterationRecord Sweep(const Field& last, Field& next, bool trust, bool again)
  {
    this->Readable = nullptr;
    if (trust && this->Joint() && !this->LagIsFresh)
    {
      this->FindLagged(last);
    }
    this->SweepOnce(last, next, trust);
    this->Seen.SumChanges({ next.Data(), last.Data() });
    this->LagIsFresh = this->Joint() && again;
    if (this->LagIsFresh)
    {
      this->FindLagged(next);
    }
    else if (this->Joint())
    {
      this->Seen.light->Forward(
        next.Data(), this->Seen.Fields().importance.Data(), this->Seen.SumsOfLight());
    }
    return this->Seen.RecordOf(*this->Work, next);
  }

private:
  bool Joint() const { return this->Seen.camera && this->Seen.light; }

  std::size_t FrustumCount() const
  {
    return (this->Seen.camera ? this->Seen.camera : this->Seen.light)->FrustumCount();
  }

  /// The policy sweep itself, of the camera or, without one, of the light.
  void SweepOnce(const Field& last, Field& next, bool trust)
  {
    const Problem& problem = *this->Work;
    const FieldsOnDevice<Device>& fields = this->Seen.Fields();
    const Weights& weights = problem.settings.weights;
    const bool useLagged = !this->Lagged.Empty();
    PolicyTask task = TaskOf(
      problem, this->Seen.camera ? weights.view : weights.light, useLagged ? weights.light : 0.0);
    task.fields.extinction = last.Data();
    task.fields.lagged = useLagged ? this->Lagged.Data() : nullptr;
    task.fields.next = next.Data();
    task.trust = trust ? Trust::LastIterate : Trust::Clear;
    TermOnDevice<Device>& swept = this->Seen.camera ? *this->Seen.camera : *this->Seen.light;
    double* sums = this->Seen.camera ? this->Seen.SumsOfCamera() : this->Seen.SumsOfLight();
    SweepPolicyOnDevice(*this->Home, swept, fields, task);
    const std::size_t frusta = swept.Frusta().size();
    for (std::size_t index = 0; index < frusta; ++index)
    {
      if (!MetNextIterate(index, frusta, task.derivative))
      {
        swept.ForwardAt(index, next.Data(), fields.importance.Data());
      }
    }
    swept.SumTotals(sums);
  }

  void FindLagged(const Field& extinction)
  {
    const FieldsOnDevice<Device>& fields = this->Seen.Fields();
    if (this->Lagged.Empty())
    {
      this->Lagged = Field(this->Home, extinction.Size(), "the light's derivative");
      this->Lagged.SetZero();
    }
    this->Seen.light->Differentiate(
      { extinction.Data(), fields.importance.Data(), fields.nodeImportance.Data() },
      this->Work->settings.derivative, { 0.0f, 1.0f, this->Lagged.Data() },
      this->Seen.SumsOfLight());
  }

  const Problem* Work;
  std::shared_ptr<Device> Home;
  TermsOnDevice<Device> Seen;
  Field Lagged;                            ///< T_L (V_L - g) of an iterate; empty: none
  bool LagIsFresh = false;                 ///< whether that is the last iterate
  mutable std::vector<float> OnHost;       ///< what was read last
  mutable const float* Readable = nullptr; ///< ... of which field; null: of none
};
}

template <class Device>
std::unique_ptr<Minimizer> MakePolicyOnDevice(const std::shared_ptr<Device>& device,
  const Problem& problem, const std::vector<float>& start, bool warm)
{
  using Engine = PolicyEngine<Device>;
  Engine engine(device, problem);
  typename Engine::Field first = start.empty()
    ? engine.CopyOf(FieldsOnDevice<Device>::Of(device, problem)->base)
    : typename Engine::Field(device, start, "an iterate");
  return std::make_unique<PolicyIterations<Engine>>(std::move(engine), std::move(first), warm);
}

template void SweepPolicyOnDevice(CompiledDevice&, TermOnDevice<CompiledDevice>&,
  const FieldsOnDevice<CompiledDevice>&, const PolicyTask&);
template std::unique_ptr<Minimizer> MakePolicyOnDevice(
  const std::shared_ptr<CompiledDevice>&, const Problem&, const std::vector<float>&, bool);
}
