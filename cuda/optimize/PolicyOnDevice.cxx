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
  for (RaysOnDevice<Device>& rays : term.Pyramids())
  {
    rays.Reset();
    const PolicyPhases phases{ rays.Plan().View(), rays.States(), task.voxel,
      task.trust == Trust::LastIterate, task.derivative == Derivative::Volume, scene.base.Data(),
      scene.importance.Data(), scene.nodeImportance.Data(), task.fields.extinction,
      task.fields.lagged, task.fields.next };
    device.ForPhases("policy sweep", phases.PhaseCount(), phases);
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
  bool IsEmpty(const Field& field) const { return field.Empty(); }

  Field CopyOf(const Field& field) const
  {
    Field copy(this->Home, field.Size(), "an iterate");
    copy.CopyFrom(field);
    return copy;
  }

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

  IterationRecord Measure(const Field& now, const Field* before)
  {
    if (!before)
    {
      return this->Seen.Measure(*this->Work, now);
    }
    const ChangeOnDevice change{ now.Data(), before->Data() };
    return this->Seen.Measure(*this->Work, now, &change);
  }

  void Sweep(const Field& last, Field& next, bool trust)
  {
    const Problem& problem = *this->Work;
    const FieldsOnDevice<Device>& fields = this->Seen.Fields();
    const Weights& weights = problem.settings.weights;
    const bool joint = this->Seen.camera && this->Seen.light;
    this->Readable = nullptr;
    if (trust && joint)
    {
      if (this->Lagged.Empty())
      {
        this->Lagged = Field(this->Home, last.Size(), "the light's derivative");
      }
      this->Lagged.SetZero();
      this->Seen.light->AddGradient(
        { last.Data(), fields.importance.Data(), fields.nodeImportance.Data() },
        problem.settings.derivative, 1.0f, this->Lagged.Data());
    }
    const bool useLagged = !this->Lagged.Empty();
    PolicyTask task = TaskOf(
      problem, this->Seen.camera ? weights.view : weights.light, useLagged ? weights.light : 0.0);
    task.fields.extinction = last.Data();
    task.fields.lagged = useLagged ? this->Lagged.Data() : nullptr;
    task.fields.next = next.Data();
    task.trust = trust ? Trust::LastIterate : Trust::Clear;
    SweepPolicyOnDevice(
      *this->Home, this->Seen.camera ? *this->Seen.camera : *this->Seen.light, fields, task);
  }

private:
  const Problem* Work;
  std::shared_ptr<Device> Home;
  TermsOnDevice<Device> Seen;
  Field Lagged;                            ///< T_L (V_L - g) of the last iterate; empty: none
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
