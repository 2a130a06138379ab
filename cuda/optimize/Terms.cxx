// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled twice, see CompiledDevice.h.

#include "optimize/Terms.h"

#include <cmath>
#include <utility>

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
  , Before(PreviousOf(this->Device, problem))
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
    this->camera->Forward(fields, nullptr);
    this->TakeSeen(*this->camera, Kept::Ignored);
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
  this->TakeMoved(this->Scene->base.Data(), nullptr);
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
  this->TakeMoved(extinction, nullptr);
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
  const TermFields fields = this->FieldsOf(term, extinction);
  term.Forward(fields, nullptr);
  this->TakeSeen(term, fields.CountsKept());
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
  const TermFields fields = this->FieldsOf(term, extinction);
  const Derivative derivative = this->Given->settings.derivative;
  if (derivative == Derivative::Volume)
  {
    term.Differentiate(fields, derivative, target, gradient, nullptr);
    this->TakeSeen(term, fields.CountsKept());
    return;
  }
  // What its rays carry is not the score: that is summed in between.
  Seen* sum = this->IsOfCamera(term) ? &this->Sums()->camera : &this->Sums()->light;
  term.Differentiate(fields, derivative, target, gradient, sum);
}

template <class AnyDevice>
void Terms<AnyDevice>::SumChanges(const float* changes)
{
  this->Add("sums",
    Summand<AbsoluteChange>{
      { changes, nullptr }, this->Given->grid.NodeCount(), &this->Sums()->moved.changes });
}

template <class AnyDevice>
void Terms<AnyDevice>::TakeMoved(const float* extinction, const float* last)
{
  this->Unsummed.extinction = extinction;
  this->Unsummed.last = last;
}

template <class AnyDevice>
void Terms<AnyDevice>::Sum()
{
  const Taken taken = std::exchange(this->Unsummed, {});
  TermSums* sums = this->Sums();
  if constexpr (AnyDevice::readsHostMemory)
  {
    if (taken.camera.wanted)
    {
      this->camera->Sum(&sums->camera, taken.camera.kept, taken.camera.first);
    }
    if (taken.light.wanted)
    {
      this->light->Sum(&sums->light, taken.light.kept, taken.light.first);
    }
    if (taken.extinction)
    {
      sums->moved.squares = this->Given->SquaresFrom(this->Given->baseExtinction, taken.extinction);
      sums->moved.squaresFromPrevious =
        this->Previous() ? this->Given->SquaresFrom(this->Previous(), taken.extinction) : 0.0;
    }
  }
  else
  {
    const auto seen = [](auto& term, const typename Taken::OfTerm& of, Seen* sum)
    { return of.wanted ? term->SumsInto(sum, of.kept) : SumsOfSeen(); };
    const SumsOfSeen byCamera = seen(this->camera, taken.camera, &sums->camera);
    const SumsOfSeen byLight = seen(this->light, taken.light, &sums->light);
    const Index nodes = this->Given->grid.NodeCount();
    this->Add("sums", byCamera.all.visible, byCamera.all.unattenuated, byCamera.kept.visible,
      byCamera.kept.unattenuated, byLight.all.visible, byLight.all.unattenuated,
      Summand<AbsoluteChange>{
        { taken.extinction, taken.last }, nodes, taken.last ? &sums->moved.changes : nullptr },
      Summand<SquaredDifference>{ { taken.extinction, this->Scene->base.Data() }, nodes,
        taken.extinction ? &sums->moved.squares : nullptr },
      Summand<SquaredDifference>{ { taken.extinction, this->Previous() }, nodes,
        taken.extinction && this->Previous() ? &sums->moved.squaresFromPrevious : nullptr });
  }
}

template <class AnyDevice>
IterationRecord Terms<AnyDevice>::Record()
{
  const TermSums sums = this->Read();
  const Weights& weights = this->Given->settings.weights;
  IterationRecord record;
  const Problem& problem = *this->Given;
  record.energy.regularization =
    problem.Regularization(problem.RegularizationWeight(), sums.moved.squares); // Eq. (22)
  record.energy.view = -weights.view * sums.camera.all.visible;                 // Eq. (23)
  record.energy.light = -weights.light * sums.light.all.visible;                // Eq. (24)
  record.energy.coherence =
    problem.Regularization(problem.CoherenceWeight(), sums.moved.squaresFromPrevious);
  if (this->Base)
  {
    record.score = ScoreOf(sums.camera, this->Base->unattenuated); // Eq. (32)
  }
  record.meanChange = this->Given->MeanChange(sums.moved.changes);
  return record;
}

template <class AnyDevice>
TermSums Terms<AnyDevice>::Read()
{
  this->Sum();
  TermSums sums;
  this->Found.Download(&sums);
  return sums;
}

#define LIMPID_INSTANTIATE(AnyDevice) template class Terms<AnyDevice>;
LIMPID_FOR_EACH_COMPILED_DEVICE(LIMPID_INSTANTIATE)
}
