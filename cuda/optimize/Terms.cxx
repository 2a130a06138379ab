// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled for each device, see CompiledDevice.h.

#include "optimize/Terms.h"

#include "distributed/DistributedFields.h"

#include <algorithm>
#include <cmath>
#include <iterator>
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
  const float* last; ///< null if `next` itself is the change

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
  , Drawn(this->Device, problem, this->Scene->base.Data())
  , Add(this->Device)
  , Found(DeviceArray<AnyDevice, TermSums>::Zeros(this->Device, 1, "sums"))
{
  const Settings& settings = problem.settings;
  const Communicator* ranks = problem.shared ? problem.shared->ranks.get() : nullptr;
  if (settings.weights.view > 0)
  {
    const auto add = [&](const RaySource& camera)
    {
      this->cameras.emplace_back(
        this->Device, problem.grid, *problem.occupancy, camera, settings.rayDensity, ranks);
    };
    add(problem.camera);
    std::for_each(problem.otherCameras.begin(), problem.otherCameras.end(), add);
    this->SumsOfOtherCameras =
      DeviceArray<AnyDevice, Seen>::Zeros(this->Device, problem.otherCameras.size(), "sums");
  }
  if (settings.weights.light > 0)
  {
    this->light.emplace(
      this->Device, problem.grid, *problem.occupancy, problem.light, settings.rayDensity, ranks);
  }
  if (ranks)
  {
    this->ShareFields();
  }
}

template <class AnyDevice>
void Terms<AnyDevice>::ShareFields()
{
  if constexpr (AnyDevice::readsHostMemory)
  {
    DistributedFields& shared = *this->Given->shared;
    std::vector<FieldDistribution::OfTerm> terms;
    const RaySource* other = this->Given->otherCameras.data();
    for (VisibilityTerm<AnyDevice>& camera : this->cameras)
    {
      terms.push_back({ &camera.Frusta(), terms.empty() ? &this->Given->camera : other++ });
    }
    if (this->light)
    {
      terms.push_back({ &this->light->Frusta(), &this->Given->light });
    }
    this->Shared = std::make_unique<const FieldDistribution>(*shared.ranks, this->Given->grid.nodes,
      terms, *this->Given->occupancy, shared.inSlabs, shared.places);
    std::vector<FieldDistribution::Input> inputs;
    const auto add = [&inputs](DistributedFields::Field& field) {
      inputs.push_back({ field.piece, field.values.Data() });
    };
    add(shared.base);
    add(shared.importance);
    add(shared.nodeImportance);
    std::for_each(shared.references.begin(), shared.references.end(), add);
    this->Shared->FromPieces(shared.pieces, inputs);
  }
}

template <class AnyDevice>
std::vector<VisibilityTerm<AnyDevice>*> Terms<AnyDevice>::All()
{
  std::vector<VisibilityTerm<AnyDevice>*> all;
  for (VisibilityTerm<AnyDevice>& term : this->cameras)
  {
    all.push_back(&term);
  }
  if (this->light)
  {
    all.push_back(&*this->light);
  }
  return all;
}

template <class AnyDevice>
TermFields Terms<AnyDevice>::FieldsOf(
  const VisibilityTerm<AnyDevice>& term, const float* extinction) const
{
  const bool scored = this->IsOfCamera(term) && this->Given->tellsScores;
  return { extinction, this->Scene->importance.Data(), this->Scene->nodeImportance.Data(),
    scored ? this->Scene->base.Data() : nullptr };
}

template <class AnyDevice>
void Terms<AnyDevice>::SeeBase()
{
  if (this->Given->tellsScores && this->Base.empty())
  {
    for (VisibilityTerm<AnyDevice>& camera : this->cameras)
    {
      TermFields fields = this->FieldsOf(camera, this->Scene->base.Data());
      fields.base = nullptr; // all of it is kept
      camera.Forward(fields, nullptr);
      this->TakeSeen(camera, Kept::Ignored);
    }
    this->Sum();
    for (const Seen& seen : this->ReadCameras(this->ReadSums()))
    {
      this->Base.push_back(seen.all);
    }
  }
}

template <class AnyDevice>
Score Terms<AnyDevice>::BaseScore() const
{
  std::vector<Score> scores;
  std::transform(this->Base.begin(), this->Base.end(), std::back_inserter(scores), ScoreOfBase);
  return scores.empty() ? Score() : MeanOf(scores);
}

template <class AnyDevice>
IterationRecord Terms<AnyDevice>::MeasureBase()
{
  if (!this->Given->tellsScores)
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
  for (VisibilityTerm<AnyDevice>* term : this->All())
  {
    this->MeasureTerm(*term, extinction);
  }
  this->TakeMoved(extinction, nullptr);
  return this->Record();
}

template <class AnyDevice>
void Terms<AnyDevice>::Differentiate(const float* extinction, float* gradient)
{
  const std::vector<VisibilityTerm<AnyDevice>*> all = this->All();
  if constexpr (AnyDevice::readsHostMemory)
  {
    if (this->Shared)
    {
      this->Shared->FillNeeded(&all.front()->Frusta(), 0.0f, gradient);
    }
  }
  const VisibilityTerm<AnyDevice>* before = nullptr;
  for (VisibilityTerm<AnyDevice>* term : all)
  {
    this->Pass(gradient, before, term);
    this->DifferentiateTerm(*term, extinction, 1.0f, gradient);
    before = term;
  }
  this->Pass(gradient, before, nullptr);
}

template <class AnyDevice>
void Terms<AnyDevice>::FillGradient(
  const float* extinction, DeviceArray<AnyDevice, float>& gradient)
{
  if (!this->Shared)
  {
    gradient.SetZero();
  }
  this->Differentiate(extinction, gradient.Data());
}

template <class AnyDevice>
void Terms<AnyDevice>::Pass(float* derivative, const VisibilityTerm<AnyDevice>* from,
  const VisibilityTerm<AnyDevice>* to) const
{
  if (from)
  {
    this->Redistribute(derivative, from, to);
  }
}

template <class AnyDevice>
void Terms<AnyDevice>::PassFromSlabs(float* field, const VisibilityTerm<AnyDevice>& to) const
{
  this->Redistribute(field, nullptr, &to);
}

template <class AnyDevice>
void Terms<AnyDevice>::Redistribute([[maybe_unused]] float* field,
  [[maybe_unused]] const VisibilityTerm<AnyDevice>* from,
  [[maybe_unused]] const VisibilityTerm<AnyDevice>* to) const
{
  if constexpr (AnyDevice::readsHostMemory)
  {
    if (this->Shared)
    {
      this->Shared->Pass(field, from ? &from->Frusta() : FieldDistribution::slabs,
        to ? &to->Frusta() : FieldDistribution::slabs);
    }
  }
}

template <class AnyDevice>
DeviceArray<AnyDevice, float> Terms<AnyDevice>::Everywhere(
  const std::vector<float>& extinction) const
{
  if (!this->Shared)
  {
    return { this->Device, extinction, "an iterate" };
  }
  auto field = DeviceArray<AnyDevice, float>::Zeros(
    this->Device, static_cast<std::size_t>(this->Given->grid.NodeCount()), "an iterate");
  std::copy(extinction.begin(), extinction.end(), field.Data() + this->Given->OwnSlab().Begin());
  this->ShareSlabs(field.Data());
  return field;
}

template <class AnyDevice>
void Terms<AnyDevice>::ShareSlabs([[maybe_unused]] float* extinction) const
{
  if constexpr (AnyDevice::readsHostMemory)
  {
    if (this->Shared)
    {
      this->Shared->Share(extinction, FieldDistribution::slabs);
    }
  }
}

template <class AnyDevice>
void Terms<AnyDevice>::DifferentiateTerm(
  VisibilityTerm<AnyDevice>& term, const float* extinction, float kept, float* gradient)
{
  const auto weight = static_cast<float>(this->WeightOf(term));
  this->DifferentiateOne(term, extinction, { kept, weight }, gradient);
}

template <class AnyDevice>
void Terms<AnyDevice>::DifferentiateSeen(
  VisibilityTerm<AnyDevice>& term, const float* extinction, float kept, float* gradient)
{
  TermFields fields = this->FieldsOf(term, extinction);
  fields.base = nullptr; // nothing is summed
  term.DifferentiateSeen(fields, this->Given->settings.derivative,
    { kept, static_cast<float>(this->WeightOf(term)) }, gradient);
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
  return this->IsOfCamera(term) ? weights.view / this->Given->NumberOfCameras() : weights.light;
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
  // The rays of this sweep do not carry the score, so it is summed in between.
  term.Differentiate(fields, derivative, target, gradient, this->SumOf(term));
}

template <class AnyDevice>
Seen* Terms<AnyDevice>::SumOf(const VisibilityTerm<AnyDevice>& term)
{
  if (!this->IsOfCamera(term))
  {
    return &this->Sums()->light;
  }
  std::size_t number = 0;
  while (&this->cameras[number] != &term)
  {
    ++number;
  }
  return number == 0 ? &this->Sums()->camera : this->SumsOfOtherCameras.Data() + (number - 1);
}

template <class AnyDevice>
void Terms<AnyDevice>::TakeSeen(VisibilityTerm<AnyDevice>& term, Kept kept)
{
  auto& seen = this->Unsummed.seen;
  const auto isOfTerm = [&term](const auto& other) { return other.term == &term; };
  seen.erase(std::remove_if(seen.begin(), seen.end(), isOfTerm), seen.end());
  seen.push_back({ &term, kept });
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
    for (const typename Taken::OfTerm& seen : taken.seen)
    {
      seen.term->Sum(this->SumOf(*seen.term), seen.kept);
    }
    for (std::size_t i = 0; taken.extinction && i < this->Pulls().size(); ++i)
    {
      // In distributed runs no rank holds the whole base extinction.
      const float* reference = this->Pulls()[i].reference;
      sums->moved.squares[i] =
        taken.extinction == reference ? 0.0 : this->Given->SquaresFrom(reference, taken.extinction);
    }
  }
  else
  {
    this->SumOnGpu(taken, std::make_index_sequence<1 + mostReferences>());
  }
}

template <class AnyDevice>
template <std::size_t... Numbers>
void Terms<AnyDevice>::SumOnGpu(const Taken& taken, std::index_sequence<Numbers...>)
{
  TermSums* sums = this->Sums();
  SumsOfSeen byCamera;
  SumsOfSeen byLight;
  for (const typename Taken::OfTerm& seen : taken.seen)
  {
    Seen* sum = this->SumOf(*seen.term);
    const SumsOfSeen by = seen.term->SumsInto(sum, seen.kept);
    if (sum == &sums->camera || sum == &sums->light)
    {
      (sum == &sums->camera ? byCamera : byLight) = by;
      continue;
    }
    this->Add("sums", by.all.visible, by.all.unattenuated, by.kept.visible, by.kept.unattenuated);
  }
  const Index nodes = this->Given->grid.NodeCount();
  const auto squares = [&](std::size_t number)
  {
    const bool isPull = taken.extinction && number < this->Pulls().size();
    return Summand<SquaredDifference>{ { taken.extinction,
                                         isPull ? this->Pulls()[number].reference : nullptr },
      nodes, isPull ? &sums->moved.squares[number] : nullptr };
  };
  this->Add("sums", byCamera.all.visible, byCamera.all.unattenuated, byCamera.kept.visible,
    byCamera.kept.unattenuated, byLight.all.visible, byLight.all.unattenuated,
    Summand<AbsoluteChange>{
      { taken.extinction, taken.last }, nodes, taken.last ? &sums->moved.changes : nullptr },
    squares(Numbers)...);
}

template <class AnyDevice>
IterationRecord Terms<AnyDevice>::Record()
{
  this->Sum();
  const TermSums sums = this->ReadSums();
  const std::vector<Seen> byCameras = this->ReadCameras(sums);
  const Weights& weights = this->Given->settings.weights;
  IterationRecord record;
  const Problem& problem = *this->Given;
  for (std::size_t i = 0; i < this->Pulls().size(); ++i)
  {
    const Pull& pull = this->Pulls()[i];
    pull.summand(record.energy) += problem.EnergyOf(pull, sums.moved.squares[i]); // Eq. (22)
  }
  double visible = 0;
  for (const Seen& seen : byCameras)
  {
    visible += seen.all.visible;
  }
  record.energy.view = -weights.view * (visible / problem.NumberOfCameras()); // Eq. (23)
  record.energy.light = -weights.light * sums.light.all.visible;              // Eq. (24)
  if (!this->Base.empty())
  {
    std::vector<Score> scores;
    for (std::size_t i = 0; i < byCameras.size(); ++i)
    {
      scores.push_back(ScoreOf(byCameras[i], this->Base[i].unattenuated)); // Eq. (32)
    }
    record.score = MeanOf(scores);
  }
  record.meanChange = this->Given->MeanChange(sums.moved.changes);
  return record;
}

template <class AnyDevice>
TermSums Terms<AnyDevice>::ReadSums()
{
  TermSums sums;
  this->Found.Download(&sums);
  return sums;
}

template <class AnyDevice>
std::vector<Seen> Terms<AnyDevice>::ReadCameras(const TermSums& sums)
{
  if (this->cameras.empty())
  {
    return {};
  }
  std::vector<Seen> seen(this->cameras.size());
  seen[0] = sums.camera;
  if (seen.size() > 1)
  {
    this->SumsOfOtherCameras.Download(seen.data() + 1);
  }
  return seen;
}

template class Terms<CompiledDevice>;
}
