// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled twice, see CompiledDevice.h.

#include "optimize/EngineOnDevice.h"

#include "energy/TransmittanceVolumeOnDevice.h"
#include "optimize/Adam.h"
#include "optimize/AdamOnDevice.h"
#include "optimize/FieldsOnDevice.h"
#include "optimize/PolicyOnDevice.h"
#include "optimize/PolicySweep.h"

namespace limpid
{
namespace
{
template <class Device>
class DeviceSweeps : public EyeSweeps
{
public:
  using Field = DeviceArray<Device, float>;

  DeviceSweeps(const std::shared_ptr<Device>& device, const Problem& problem, const RaySource& eye)
    : Task(problem)
    , Home(device)
    , Fields(FieldsOnDevice<Device>::Of(device, problem))
    , Term(device, problem.grid, *problem.occupancy, eye, problem.settings.rayDensity)
    , Sums(device, 2, "sums")
  {
  }

  Visible Score(const float* extinction) override
  {
    const Field field(
      this->Home, extinction, std::size_t(this->Task.grid.NodeCount()), "the extinction");
    this->Term.Forward(field.Data(), this->Fields->importance.Data(), this->Sums.Data());
    double values[2];
    this->Sums.Download(values);
    Visible seen;
    seen.visible = values[0];
    seen.unattenuated = values[1];
    return seen;
  }

  void Pass(double weight, std::vector<float>& found) override
  {
    Field next(this->Home, found, "the extinction");
    PolicyTask task = TaskOf(this->Task, weight, 0.0);
    task.fields.next = next.Data();
    task.trust = Trust::Clear;
    SweepPolicyOnDevice(*this->Home, this->Term, *this->Fields, task);
    next.Download(found.data());
  }

private:
  const Problem& Task;
  std::shared_ptr<Device> Home;
  std::shared_ptr<FieldsOnDevice<Device>> Fields;
  TermOnDevice<Device> Term;
  DeviceArray<Device, double> Sums;
};

template <class Device>
class DeviceEngine : public Engine
{
public:
  explicit DeviceEngine(std::shared_ptr<Device> device)
    : Home(std::move(device))
  {
  }

  std::unique_ptr<Minimizer> MakeMinimizer(
    const Problem& problem, std::vector<float>&& start, bool warm) override
  {
    if (problem.settings.solver == SolverKind::Policy)
    {
      return MakePolicyOnDevice(this->Home, problem, start, warm);
    }
    StartFromBase(problem, start);
    return MakeAdam(problem, std::move(start),
      [home = this->Home](const Problem& level, std::vector<float>&& first)
      { return MakeAdamLevelOnDevice(home, level, first); });
  }

  std::unique_ptr<EyeSweeps> Look(const Problem& problem, const RaySource& eye) override
  {
    return std::make_unique<DeviceSweeps<Device>>(this->Home, problem, eye);
  }

  void Transmittance(const Problem& problem, const RaySource& eye, double rayDensity,
    const float* extinction, float* transmittance) override
  {
    const auto count = static_cast<std::size_t>(problem.grid.NodeCount());
    const DeviceArray<Device, float> field(this->Home, extinction, count, "the extinction");
    DeviceArray<Device, float> result(this->Home, count, "the transmittance");
    const Occupancy occupancy(problem.grid, extinction, extinction, true);
    TransmittanceVolumeOnDevice<Device>(this->Home, problem.grid, occupancy, eye, rayDensity)
      .Fill(field.Data(), result.Data());
    result.Download(transmittance);
  }

private:
  std::shared_ptr<Device> Home;
};
}

template <class Device>
std::shared_ptr<Engine> EngineOn(std::shared_ptr<Device> device)
{
  return std::make_shared<DeviceEngine<Device>>(std::move(device));
}

template std::shared_ptr<Engine> EngineOn(std::shared_ptr<CompiledDevice>);
}
