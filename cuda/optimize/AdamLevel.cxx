// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled for each device, see CompiledDevice.h.

#include "optimize/AdamLevel.h"

#include "optimize/AdamVoxel.h"
#include "optimize/Iterate.h"
#include "optimize/VoxelSteps.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
/// Returns step number `count` at every voxel; its arrays are not set yet.
AdamVoxel<float> AdamStep(const Problem& problem, int count)
{
  const Settings& settings = problem.settings;
  AdamVoxel<float> body{};
  body.step =
    static_cast<float>(settings.learningRate * problem.majorant / (1.0 - std::pow(0.9, count)));
  body.secondCorrection = static_cast<float>(1.0 / (1.0 - std::pow(0.999, count)));
  body.floor = static_cast<float>(1e-6 * std::max(settings.weights.view, settings.weights.light));
  body.bounds = BoundsOf(problem);
  return body;
}

template <class AnyDevice>
class LevelOn : public AdamLevel
{
public:
  using Field = DeviceArray<AnyDevice, float>;

  LevelOn(const std::shared_ptr<AnyDevice>& device, const Problem& problem,
    const StartingExtinction& start)
    : Given(problem)
    , Device(device)
    , Energy(device, problem)
    , Own(problem.OwnSlab())
    , Now(this->Begin(start))
  {
    this->Energy.SeeBase();
  }

  Score BaseScore() const override { return this->Energy.BaseScore(); }

  IterationRecord Measure() override { return this->Energy.Measure(this->Now.Data()); }
  IterationRecord MeasureBase() override { return this->Energy.MeasureBase(); }

  IterationRecord Step(int count) override
  {
    [[maybe_unused]] const typename AnyDevice::Team team;
    if (this->Gradient.Empty())
    {
      this->Gradient = Field::Zeros(this->Device, this->Now.Size(), "the derivative");
      this->First = Field::Zeros(this->Device, this->Now.Size(), "the mean derivative");
      this->Second =
        Field::Zeros(this->Device, this->Now.Size(), "the mean square of the derivative");
      this->Energy.Differentiate(this->Now.Data(), this->Gradient.Data());
    }
    AdamVoxel<float> step = AdamStep(this->Given, count);
    step.gradient = this->Gradient.Data();
    step.base = this->Energy.Fields().base.Data();
    step.pulls = PullsAtVoxels<float>::Of(this->Energy.Pulls(), step.base);
    step.importance = this->Energy.Fields().importance.Data();
    step.first = this->First.Data();
    step.second = this->Second.Data();
    step.extinction = this->Now.Data();
    StepAll(*this->Device, this->Given, step, this->Gradient.Data(), this->Energy);
    this->Energy.Distribution().Share(this->Now.Data(), FieldDistribution::slabs);
    this->Energy.Differentiate(this->Now.Data(), this->Gradient.Data());
    this->Energy.TakeMoved(this->Now.Data(), nullptr);
    return this->Energy.Record();
  }

  std::vector<float> Extinction() override
  {
    return OnHost(*this->Device, this->Now.Data() + this->Own.Begin(), this->Own.Count());
  }

  void KeepBest() override
  {
    this->Kept.RoomFor(this->Device, this->Now.Size(), "the best extinction");
    this->Device->Copy(this->Kept.Data() + this->Own.Begin(), this->Now.Data() + this->Own.Begin(),
      std::size_t(this->Own.Count()) * sizeof(float));
    this->Readable.Outdate();
  }

  const std::vector<float>& Best() override
  {
    return this->Readable.Of(
      *this->Device, this->Kept.Data() + this->Own.Begin(), this->Own.Count());
  }

  std::vector<float> TakeBest() override
  {
    this->Best();
    return this->Readable.Take();
  }

private:
  Field Begin(const StartingExtinction& start) const
  {
    const float* base = this->Given.baseExtinction + this->Own.Begin();
    return this->Energy.Everywhere(
      start ? *start : std::vector<float>(base, base + this->Own.Count()));
  }

  const Problem& Given;
  std::shared_ptr<AnyDevice> Device;
  Terms<AnyDevice> Energy;
  Slab Own; ///< the owned slab
  Field Now;
  Field Kept;
  Field Gradient; ///< empty before the first step
  Field First;
  Field Second;
  FieldOnHost Readable; ///< the best iterate
};
}

template <class AnyDevice>
std::unique_ptr<AdamLevel> MakeAdamLevel(
  const std::shared_ptr<AnyDevice>& device, const Problem& problem, const StartingExtinction& start)
{
  return std::make_unique<LevelOn<AnyDevice>>(device, problem, start);
}

template std::unique_ptr<AdamLevel> MakeAdamLevel(
  const std::shared_ptr<CompiledDevice>&, const Problem&, const StartingExtinction&);
}
