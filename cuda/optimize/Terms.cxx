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
  const bool scored = this->IsOfCamera(term) && TellsScores(this->Given->settings);
  return { extinction, this->Scene->importance.Data(), this->Scene->nodeImportance.Data(),
    scored ? this->Scene->base.Data() : nullptr };
}

template <class AnyDevice>
void Terms<AnyDevice>::SeeBase()
{
  if (TellsScores(this->Given->settings) && !this->Base)
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
  if (!TellsScores(this->Given->settings))
  {
    return this->Measure(this->Scene->base.Data());
  }
  this->SeeBase();
  if (this->light)
  {
    this->MeasureTerm(*this->light, this->Scene->base.Data());
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
    this->MeasureTerm(*this->camera, extinction);
  }
  if (this->light)
  {
    this->MeasureTerm(*this->light, extinction);
  }
  this->SumSquares(extinction);
  return this->Record();
}

template <class AnyDevice>
void Terms<AnyDevice>::Differentiate(const float* extinction, float* gradient)
{
  for (auto* term : { &this->camera, &this->light })
  {
    if (*term)
    {
      const auto weight = static_cast<float>(this->WeightOf(**term));
      this->DifferentiateOne(**term, extinction, { 1.0f, weight }, gradient);
    }
  }
}

template <class AnyDevice>
void Terms<AnyDevice>::DifferentiateTerm(
  VisibilityTerm<AnyDevice>& term, const float* extinction, float* gradient)
{
  const auto weight = static_cast<float>(this->WeightOf(term));
  this->DifferentiateOne(term, extinction, { 0.0f, weight }, gradient);
}

template <class AnyDevice>
void Terms<AnyDevice>::DifferentiateSeen(
  VisibilityTerm<AnyDevice>& term, const float* extinction, float* gradient)
{
  TermFields fields = this->FieldsOf(term, extinction);
  fields.base = nullptr; // nothing is summed
  term.DifferentiateSeen(fields, this->Given->settings.derivative,
    { 0.0f, static_cast<float>(this->WeightOf(term)) }, gradient);
}

template <class AnyDevice>
void Terms<AnyDevice>::MeasureTerm(VisibilityTerm<AnyDevice>& term, const float* extinction)
{
  term.Forward(this->FieldsOf(term, extinction), this->SumOf(term));
}

template <class AnyDevice>
double Terms<AnyDevice>::WeightOf(const VisibilityTerm<AnyDevice>& term) const
{
  const Weights& weights = this->Given->settings.weights;
  return this->IsOfCamera(term) ? weights.view : weights.light;
}

template <class AnyDevice>
void Terms<AnyDevice>::DifferentiateOne(VisibilityTerm<AnyDevice>& term, const float* extinction,
  const GradientTarget& target, float* gradient)
{
  term.Differentiate(this->FieldsOf(term, extinction), this->Given->settings.derivative, target,
    gradient, this->SumOf(term));
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
  if (this->Base)
  {
    record.score = ScoreOf(sums.camera, this->Base->unattenuated); // Eq. (32)
  }
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
