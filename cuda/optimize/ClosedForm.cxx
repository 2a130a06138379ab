// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled for each device, see CompiledDevice.h.

#include "optimize/ClosedForm.h"

#include "optimize/Iterate.h"
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
    , Found(this->Device, this->Energy.Fields().base.Size(), "the extinction")
  {
    this->Device->Copy(
      this->Found.Data(), this->Energy.Fields().base.Data(), this->Found.Size() * sizeof(float));
  }

  IterationRecord Start() override { return this->Energy.MeasureBase(); }

  IterationRecord Iterate() override
  {
    FindByMethod(this->Device, this->Given, this->Energy.Fields(), this->Found.Data());
    IterationRecord record = this->Energy.Measure(this->Found.Data());
    record.isResult = true;
    this->Readable.Outdate();
    this->IsFound = true;
    return record;
  }

  IterationRecord Smooth() override { return {}; } // never called: the method has no iterations
  Score BaseScore() const override { return this->Energy.BaseScore(); }
  bool Converged() const override { return this->IsFound; }
  int IterationLimit() const override { return 1; }

  const std::vector<float>& Best() const override
  {
    return this->Readable.Of(
      *this->Device, this->Found.Data(), static_cast<Index>(this->Found.Size()));
  }

  std::vector<float> TakeBest() override
  {
    this->Best();
    return this->Readable.Take();
  }

  ExtinctionOnDevice BestOnDevice() const override
  {
    return PlaceOnDevice(this->Energy.Fields(), this->Found.Data());
  }

  FoundExtinction TakeResult() override
  {
    return TakeResultOf(*this, this->Device, this->Energy.SharedFields(), std::move(this->Found));
  }

private:
  const Problem& Given;
  std::shared_ptr<AnyDevice> Device;
  Terms<AnyDevice> Energy;
  DeviceArray<AnyDevice, float> Found; ///< initially the base extinction
  mutable FieldOnHost Readable;        ///< its values
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
