// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled twice, see CompiledDevice.h.

#include "optimize/FieldsOnDevice.h"

#include <cmath>

namespace limpid
{
namespace
{
/// Where the sums of a measurement are.
enum SumOf : int
{
  SeenByCamera,
  ThereForCamera,
  SeenByLight,
  ThereForLight,
  Squares,
  Changes,
  SumCount
};

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
IterationRecord TermsOnDevice<Device>::Measure(
  const Problem& problem, const Field& now, const ChangeOnDevice* change)
{
  double* sums = this->Sums.Data();
  const float* importance = this->Resident->importance.Data();
  const Index count = problem.grid.NodeCount();
  this->Sums.SetZero();
  if (this->camera)
  {
    this->camera->Forward(now.Data(), importance, sums + SeenByCamera);
  }
  if (this->light)
  {
    this->light->Forward(now.Data(), importance, sums + SeenByLight);
  }
  this->Sum("regularization", count, SquaredDifference{ now.Data(), this->Resident->base.Data() },
    sums + Squares);
  if (change)
  {
    this->Sum("change", count, AbsoluteChange{ *change }, sums + Changes);
  }
  double values[SumCount];
  this->Sums.Download(values);

  const Weights& weights = problem.settings.weights;
  const double filled = double(problem.occupancy->FilledVoxels());
  IterationRecord record;
  record.energy.regularization =
    0.5 * problem.RegularizationWeight() * problem.grid.CellVolume() * values[Squares];
  record.visibilityScore = values[SeenByCamera];
  record.visibleFraction =
    values[ThereForCamera] > 0 ? values[SeenByCamera] / values[ThereForCamera] : 0.0;
  record.energy.view = -weights.view * values[SeenByCamera];
  record.energy.light = -weights.light * values[SeenByLight];
  record.meanChange =
    filled > 0 && problem.majorant > 0 ? values[Changes] / filled / problem.majorant : 0.0;
  return record;
}

template struct FieldsOnDevice<CompiledDevice>;
template class TermsOnDevice<CompiledDevice>;
}
