// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled twice, see CompiledDevice.h.

#include "optimize/AdamOnDevice.h"

#include "optimize/FieldsOnDevice.h"

namespace limpid
{
namespace
{
/// A step at every voxel that leaves the change in place of the derivative.
struct StepAndChange
{
  AdamVoxel<float> step;
  float* gradient;

  LIMPID_HD LIMPID_INLINE void operator()(Index voxel) const
  {
    const float before = this->step.extinction[voxel];
    this->step(voxel);
    this->gradient[voxel] = this->step.extinction[voxel] - before;
  }
};

template <class Device>
class LevelOnDevice : public AdamLevel
{
public:
  using Field = DeviceArray<Device, float>;

  LevelOnDevice(
    const std::shared_ptr<Device>& device, const Problem& problem, const std::vector<float>& start)
    : Task(problem)
    , Home(device)
    , Seen(FieldsOnDevice<Device>::Of(device, problem), problem)
    , Now(device, start, "the extinction")
  {
  }

  IterationRecord Measure() override { return this->Seen.Measure(this->Task, this->Now); }

  IterationRecord Step(int count) override
  {
    if (this->Gradient.Empty())
    {
      this->Gradient = Field(this->Home, this->Now.Size(), "the derivative");
      this->First = Field(this->Home, this->Now.Size(), "the mean derivative");
      this->Second = Field(this->Home, this->Now.Size(), "the mean square of the derivative");
      this->First.SetZero();
      this->Second.SetZero();
      this->FindGradient();
    }
    AdamVoxel<float> body = AdamStep(this->Task, count);
    body.gradient = this->Gradient.Data();
    body.base = this->Seen.Fields().base.Data();
    body.first = this->First.Data();
    body.second = this->Second.Data();
    body.extinction = this->Now.Data();
    float* gradient = this->Gradient.Data();
    this->Home->ForIndices("Adam", this->Task.grid.NodeCount(), StepAndChange{ body, gradient });
    this->Seen.SumChanges({ gradient, nullptr });
    this->FindGradient();
    return this->Seen.RecordOf(this->Task, this->Now);
  }

  std::vector<float> Extinction() override { return OnHost(this->Now); }

  void KeepBest() override
  {
    if (this->Kept.Empty())
    {
      this->Kept = Field(this->Home, this->Now.Size(), "the best extinction");
    }
    this->Kept.CopyFrom(this->Now);
    this->Readable.clear();
  }

  const std::vector<float>& Best() override
  {
    if (this->Readable.empty())
    {
      this->Readable = OnHost(this->Kept);
    }
    return this->Readable;
  }

  std::vector<float> TakeBest() override
  {
    this->Best();
    return std::move(this->Readable);
  }

private:
  static std::vector<float> OnHost(const Field& field)
  {
    std::vector<float> values(field.Size());
    field.Download(values.data());
    return values;
  }

  /// For the next step; the terms see the present extinction along the way.
  void FindGradient()
  {
    const Settings& settings = this->Task.settings;
    const FieldsOnDevice<Device>& scene = this->Seen.Fields();
    const TermFields fields{ this->Now.Data(), scene.importance.Data(),
      scene.nodeImportance.Data() };
    this->Gradient.SetZero();
    if (this->Seen.camera)
    {
      this->Seen.camera->Differentiate(fields, settings.derivative,
        { 1.0f, static_cast<float>(settings.weights.view), this->Gradient.Data() },
        this->Seen.SumsOfCamera());
    }
    if (this->Seen.light)
    {
      this->Seen.light->Differentiate(fields, settings.derivative,
        { 1.0f, static_cast<float>(settings.weights.light), this->Gradient.Data() },
        this->Seen.SumsOfLight());
    }
  }

  const Problem& Task;
  std::shared_ptr<Device> Home;
  TermsOnDevice<Device> Seen;
  Field Now;
  Field Kept;
  Field Gradient; ///< empty: there was no step yet
  Field First;
  Field Second;
  std::vector<float> Readable; ///< the best on the host; empty: not asked for
};
}

template <class Device>
std::unique_ptr<AdamLevel> MakeAdamLevelOnDevice(
  const std::shared_ptr<Device>& device, const Problem& problem, const std::vector<float>& start)
{
  return std::make_unique<LevelOnDevice<Device>>(device, problem, start);
}

template std::unique_ptr<AdamLevel> MakeAdamLevelOnDevice(
  const std::shared_ptr<CompiledDevice>&, const Problem&, const std::vector<float>&);
}
