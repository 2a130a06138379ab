// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled twice, see CompiledDevice.h.

#include "optimize/EngineOnDevice.h"

#include "optimize/Adam.h"
#include "optimize/AdamOnDevice.h"
#include "optimize/FieldsOnDevice.h"
#include "optimize/PolicyOnDevice.h"

namespace limpid
{
namespace
{
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
    return MakeAdam(problem, std::move(start),
      [home = this->Home](const Problem& level, std::vector<float>&& first)
      { return MakeAdamLevelOnDevice(home, level, first); });
  }

  Visible Score(const Problem& problem, const float* extinction) override
  {
    const auto fields = FieldsOnDevice<Device>::Of(this->Home, problem);
    const auto count = static_cast<std::size_t>(problem.grid.NodeCount());
    const DeviceArray<Device, float> field(this->Home, extinction, count, "the extinction");
    TermOnDevice<Device> term(
      this->Home, problem.grid, *problem.occupancy, problem.camera, problem.settings.rayDensity);
    DeviceArray<Device, double> sums(this->Home, 2, "sums");
    term.Forward(field.Data(), fields->importance.Data(), sums.Data());
    Visible seen;
    double values[2];
    sums.Download(values);
    seen.visible = values[0];
    seen.plain = values[1];
    return seen;
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
