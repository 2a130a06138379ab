// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled twice, see CompiledDevice.h.

#include "optimize/Terms.h"

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
  const float* next;
  const float* last; ///< null: `next` is the change

  LIMPID_HD LIMPID_INLINE double operator()(Index voxel) const
  {
    const double before = this->last ? double(this->last[voxel]) : 0.0;
    return std::abs(double(this->next[voxel]) - before);
  }
};
}

template <class AnyDevice>
Terms<AnyDevice>::Terms(std::shared_ptr<AnyDevice> device, const Problem& problem)
  : Given(&problem)
  , Device(std::move(device))
  , Scene(ProblemFields<AnyDevice>::Of(this->Device, problem))
  , Add(this->Device)
  , Found(DeviceArray<AnyDevice, TermSums>::Zeros(this->Device, 1, "sums"))
{
  const Settings& settings = problem.settings;
  if (settings.weights.view > 0)
  {
    this->camera.emplace(
      this->Device, problem.grid, *problem.occupancy, problem.camera, settings.rayDensity);
  }
  if (settings.weights.light > 0)
  {
    this->light.emplace(
      this->Device, problem.grid, *problem.occupancy, problem.light, settings.rayDensity);
  }
}

template <class AnyDevice>
TermFields Terms<AnyDevice>::FieldsOf(
  const VisibilityTerm<AnyDevice>& term, const float* extinction) const
{
  const bool ofCamera = this->camera && &term == &*this->camera;
  return { extinction, this->Scene->importance.Data(), this->Scene->nodeImportance.Data(),
    ofCamera ? this->Scene->base.Data() : nullptr };
}

template <class AnyDevice>
void Terms<AnyDevice>::SeeBase()
{
  if (this->camera && !this->Base)
  {
    TermFields fields = this->FieldsOf(*this->camera, this->Scene->base.Data());
    fields.base = nullptr; // all of it is kept
    this->camera->Forward(fields, &this->Sums()->camera);
    this->Base = this->Read().camera.all;
  }
}

template <class AnyDevice>
IterationRecord Terms<AnyDevice>::MeasureBase()
{
  this->SeeBase();
  if (this->light)
  {
    this->MeasureLagged(this->Scene->base.Data());
  }
  this->SumSquares(this->Scene->base.Data());
  IterationRecord record = this->Record();
  record.score = this->BaseScore();
  return record;
}

template <class AnyDevice>
IterationRecord Terms<AnyDevice>::Measure(const float* extinction)
{
  if (this->camera)
  {
    this->camera->Forward(this->FieldsOf(*this->camera, extinction), &this->Sums()->camera);
  }
  if (this->light)
  {
    this->MeasureLagged(extinction);
  }
  this->SumSquares(extinction);
  return this->Record();
}

template <class AnyDevice>
void Terms<AnyDevice>::Differentiate(const float* extinction, float* gradient)
{
  const Weights& weights = this->Given->settings.weights;
  if (this->camera)
  {
    this->DifferentiateOne(*this->camera, extinction, { 1.0f, static_cast<float>(weights.view) },
      gradient, &this->Sums()->camera);
  }
  if (this->light)
  {
    this->DifferentiateOne(*this->light, extinction, { 1.0f, static_cast<float>(weights.light) },
      gradient, &this->Sums()->light);
  }
}

template <class AnyDevice>
void Terms<AnyDevice>::DifferentiateLagged(const float* extinction, float* lagged)
{
  const auto weight = static_cast<float>(this->Given->settings.weights.light);
  this->DifferentiateOne(*this->light, extinction, { 0.0f, weight }, lagged, &this->Sums()->light);
}

template <class AnyDevice>
void Terms<AnyDevice>::MeasureLagged(const float* extinction)
{
  this->light->Forward(this->FieldsOf(*this->light, extinction), &this->Sums()->light);
}

template <class AnyDevice>
void Terms<AnyDevice>::DifferentiateOne(VisibilityTerm<AnyDevice>& term, const float* extinction,
  const GradientTarget& target, float* gradient, Seen* sum)
{
  term.Differentiate(
    this->FieldsOf(term, extinction), this->Given->settings.derivative, target, gradient, sum);
}

template <class AnyDevice>
void Terms<AnyDevice>::SumChanges(const float* next, const float* last)
{
  this->Add("change", this->Given->grid.NodeCount(), AbsoluteChange{ next, last },
    &this->Sums()->moved.changes);
}

template <class AnyDevice>
void Terms<AnyDevice>::SumSquares(const float* extinction)
{
  if constexpr (AnyDevice::readsHostMemory)
  {
    this->Sums()->moved.squares = this->Given->SquaresFromBase(extinction);
  }
  else
  {
    this->Add("regularization", this->Given->grid.NodeCount(),
      SquaredDifference{ extinction, this->Scene->base.Data() }, &this->Sums()->moved.squares);
  }
}

template <class AnyDevice>
IterationRecord Terms<AnyDevice>::Record() const
{
  const TermSums sums = this->Read();
  const Weights& weights = this->Given->settings.weights;
  IterationRecord record;
  record.energy.regularization = this->Given->Regularization(sums.moved.squares); // Eq. (22)
  record.energy.view = -weights.view * sums.camera.all.visible;                   // Eq. (23)
  record.energy.light = -weights.light * sums.light.all.visible;                  // Eq. (24)
  record.score = ScoreOf(sums.camera, this->Base ? this->Base->unattenuated : 0); // Eq. (32)
  record.meanChange = this->Given->MeanChange(sums.moved.changes);
  return record;
}

template <class AnyDevice>
TermSums Terms<AnyDevice>::Read() const
{
  TermSums sums;
  this->Found.Download(&sums);
  return sums;
}

#define LIMPID_INSTANTIATE(AnyDevice) template class Terms<AnyDevice>;
LIMPID_FOR_EACH_COMPILED_DEVICE(LIMPID_INSTANTIATE)
}
