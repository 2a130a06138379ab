// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled twice, see CompiledDevice.h.

#include "optimize/FieldsOnDevice.h"

#include <cmath>

namespace limpid
{
namespace
{
struct SquaredDifference
{
  const float* a;
  const float* b;

  LIMPID_HD LIMPID_INLINE double operator()(Index voxel) const
  {
    const double difference = double(this->a[voxel]) - double(this->b[voxel]);
    return difference * difference;
  }
};

struct AbsoluteChange
{
  ChangeOnDevice change;

  LIMPID_HD LIMPID_INLINE double operator()(Index voxel) const
  {
    const double before = this->change.before ? double(this->change.before[voxel]) : 0.0;
    return std::abs(double(this->change.after[voxel]) - before);
  }
};
}

template <class Device>
FieldsOnDevice<Device>::FieldsOnDevice(std::shared_ptr<Device> home, const Problem& problem)
  : device(std::move(home))
{
  const auto count = static_cast<std::size_t>(problem.grid.NodeCount());
  this->base = { this->device, problem.baseExtinction, count, "the base extinction" };
  this->importance = { this->device, problem.importance, count, "the importance" };
  this->nodeImportance = { this->device, problem.nodeImportance, count, "the importance" };
}

template <class Device>
std::shared_ptr<FieldsOnDevice<Device>> FieldsOnDevice<Device>::Of(
  const std::shared_ptr<Device>& device, const Problem& problem)
{
  if (!problem.resident)
  {
    return std::make_shared<FieldsOnDevice>(device, problem);
  }
  const std::lock_guard<std::mutex> lock(problem.resident->access);
  auto fields = std::static_pointer_cast<FieldsOnDevice>(problem.resident->fields);
  if (!fields)
  {
    fields = std::make_shared<FieldsOnDevice>(device, problem);
    problem.resident->fields = fields;
  }
  return fields;
}

template <class Device>
TermsOnDevice<Device>::TermsOnDevice(
  std::shared_ptr<FieldsOnDevice<Device>> fields, const Problem& problem)
  : Resident(std::move(fields))
  , Sum(this->Resident->device)
  , Sums(this->Resident->device, SumCount, "sums")
{
  this->Sums.SetZero(); // what a missing term sees
  const Settings& settings = problem.settings;
  if (settings.weights.view > 0)
  {
    this->camera.emplace(this->Resident->device, problem.grid, *problem.occupancy, problem.camera,
      settings.rayDensity);
  }
  if (settings.weights.light > 0)
  {
    this->light.emplace(
      this->Resident->device, problem.grid, *problem.occupancy, problem.light, settings.rayDensity);
  }
}

template <class Device>
IterationRecord TermsOnDevice<Device>::Measure(const Problem& problem, const Field& now)
{
  const float* importance = this->Resident->importance.Data();
  if (this->camera)
  {
    this->camera->Forward(now.Data(), importance, this->SumsOfCamera());
  }
  if (this->light)
  {
    this->light->Forward(now.Data(), importance, this->SumsOfLight());
  }
  return this->RecordOf(problem, now);
}

template <class Device>
void TermsOnDevice<Device>::SumChanges(const ChangeOnDevice& change)
{
  this->Sum("change", static_cast<Index>(this->Resident->base.Size()), AbsoluteChange{ change },
    this->Sums.Data() + Changes);
}

template <class Device>
IterationRecord TermsOnDevice<Device>::RecordOf(const Problem& problem, const Field& now)
{
  double* sums = this->Sums.Data();
  const Index count = problem.grid.NodeCount();
  this->Sum("regularization", count, SquaredDifference{ now.Data(), this->Resident->base.Data() },
    sums + Squares);
  double values[SumCount];
  this->Sums.Download(values);

  const Weights& weights = problem.settings.weights;
  IterationRecord record;
  record.energy.regularization = problem.Regularization(values[Squares]);
  record.visibilityScore = values[SeenByCamera];
  record.visibleFraction =
    values[ThereForCamera] > 0 ? values[SeenByCamera] / values[ThereForCamera] : 0.0;
  record.energy.view = -weights.view * values[SeenByCamera];
  record.energy.light = -weights.light * values[SeenByLight];
  record.meanChange = problem.MeanChange(values[Changes]);
  return record;
}

template struct FieldsOnDevice<CompiledDevice>;
template class TermsOnDevice<CompiledDevice>;
}
