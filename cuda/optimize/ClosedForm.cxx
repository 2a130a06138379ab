// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled for each device, see CompiledDevice.h.

#include "optimize/ClosedForm.h"

#include "optimize/Terms.h"

#include <utility>

namespace limpid
{
namespace
{
template <class AnyDevice>
class ClosedForm : public Minimizer
{
public:
  ClosedForm(std::shared_ptr<AnyDevice> device, const Problem& problem)
    : Given(problem)
    , Device(std::move(device))
    , Energy(this->Device, problem)
    , Found(problem.baseExtinction, problem.baseExtinction + problem.grid.NodeCount())
  {
  }

  IterationRecord Start() override { return this->Energy.MeasureBase(); }

  IterationRecord Iterate() override
  {
    DeviceArray<AnyDevice, float> there(this->Device, this->Found, "the extinction");
    FindByMethod(this->Device, this->Given, this->Energy.Fields(), there.Data());
    IterationRecord record = this->Energy.Measure(there.Data());
    record.isResult = true;
    there.Download(this->Found.data());
    this->IsFound = true;
    return record;
  }

  IterationRecord Smooth() override { return {}; } // never called: the method has no iterations
  Score BaseScore() const override { return this->Energy.BaseScore(); }
  bool Converged() const override { return this->IsFound; }
  int IterationLimit() const override { return 1; }
  const std::vector<float>& Best() const override { return this->Found; }
  std::vector<float> TakeBest() override { return std::move(this->Found); }

private:
  const Problem& Given;
  std::shared_ptr<AnyDevice> Device;
  Terms<AnyDevice> Energy;
  std::vector<float> Found; ///< initially the base extinction
  bool IsFound = false;
};
}

template <class AnyDevice>
void FindByMethod(const std::shared_ptr<AnyDevice>& device, const Problem& problem,
  const ProblemFields<AnyDevice>& fields, float* extinction)
{
  if (const auto find = PassesOf<AnyDevice>(problem.settings.method).findExtinction)
  {
    find(SceneOf(device, problem, fields), extinction);
  }
}

template <class AnyDevice>
std::unique_ptr<Minimizer> MakeClosedForm(std::shared_ptr<AnyDevice> device, const Problem& problem)
{
  return std::make_unique<ClosedForm<AnyDevice>>(std::move(device), problem);
}

template std::unique_ptr<Minimizer> MakeClosedForm(std::shared_ptr<CompiledDevice>, const Problem&);
template void FindByMethod(const std::shared_ptr<CompiledDevice>&, const Problem&,
  const ProblemFields<CompiledDevice>&, float*);
}
