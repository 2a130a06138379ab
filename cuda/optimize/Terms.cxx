// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled for each device, see CompiledDevice.h.

#include "optimize/Terms.h"

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

template <class AnyDevice>
std::deque<EnergyTerm<AnyDevice>> MakeTerms(
  const std::shared_ptr<AnyDevice>& device, const Problem& problem)
{
  std::deque<EnergyTerm<AnyDevice>> terms;
  for (const TermSource& source : problem.sources)
  {
    if (problem.WeightOf(source) > 0)
    {
      terms.emplace_back(device, problem, source, terms.size());
    }
  }
  return terms;
}
}

template <class AnyDevice>
Terms<AnyDevice>::Terms(std::shared_ptr<AnyDevice> device, const Problem& problem)
  : all(MakeTerms(device, problem))
  , Given(&problem)
  , Device(std::move(device))
  , Scene(ProblemFields<AnyDevice>::Of(this->Device, problem))
  , Drawn(this->Device, problem, this->Scene->base.Data())
  , Shared(this->Device, problem, this->all)
  , Add(this->Device)
  , Found(DeviceArray<AnyDevice, TermSums>::Zeros(this->Device, problem.sources.size(), "sums"))
{
}

template <class AnyDevice>
TermFields Terms<AnyDevice>::FieldsOf(const Term& term, const float* extinction) const
{
  const bool scored = term.IsOfCamera() && this->Given->tellsScores;
  return { extinction, this->Scene->importance.Data(), this->Scene->nodeImportance.Data(),
    scored ? this->Scene->base.Data() : nullptr };
}

template <class AnyDevice>
void Terms<AnyDevice>::SeeBase()
{
  if (!this->Given->tellsScores || !this->Base.empty())
  {
    return;
  }
  for (Term& term : this->all)
  {
    if (term.IsOfCamera())
    {
      TermFields fields = this->FieldsOf(term, this->Scene->base.Data());
      fields.base = nullptr; // all of it is kept
      term.Forward(fields, nullptr);
      this->TakeSeen(term, Kept::Ignored);
    }
  }
  this->Sum();
  const std::vector<TermSums> sums = this->ReadSums();
  for (const Term& term : this->all)
  {
    if (term.IsOfCamera())
    {
      this->Base.push_back(sums[term.Number()].seen.all);
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
  for (Term& term : this->all)
  {
    if (!term.IsOfCamera())
    {
      this->MeasureTerm(term, this->Scene->base.Data());
    }
  }
  this->TakeMoved(this->Scene->base.Data(), nullptr);
  IterationRecord record = this->Record();
  record.score = this->BaseScore();
  return record;
}

template <class AnyDevice>
IterationRecord Terms<AnyDevice>::Measure(const float* extinction)
{
  for (Term& term : this->all)
  {
    this->MeasureTerm(term, extinction);
  }
  this->TakeMoved(extinction, nullptr);
  return this->Record();
}

template <class AnyDevice>
void Terms<AnyDevice>::Differentiate(const float* extinction, float* gradient)
{
  std::size_t place = this->all.front().Number();
  this->Shared.SetZero(place, gradient);
  for (Term& term : this->all)
  {
    this->Shared.Pass(gradient, std::exchange(place, term.Number()), term.Number());
    this->DifferentiateTerm(term, extinction, 1.0f, gradient);
  }
  this->Shared.Pass(gradient, place, FieldDistribution::slabs);
}

template <class AnyDevice>
DeviceArray<AnyDevice, float> Terms<AnyDevice>::Everywhere(
  const std::vector<float>& extinction) const
{
  auto field = DeviceArray<AnyDevice, float>::Zeros(
    this->Device, static_cast<std::size_t>(this->Given->grid.NodeCount()), "an iterate");
  this->Device->Upload(field.Data() + this->Given->OwnSlab().Begin(), extinction.data(),
    extinction.size() * sizeof(float));
  this->Shared.Share(field.Data(), FieldDistribution::slabs);
  return field;
}

template <class AnyDevice>
void Terms<AnyDevice>::DifferentiateTerm(
  Term& term, const float* extinction, float kept, float* gradient)
{
  this->DifferentiateOne(term, extinction, { kept, static_cast<float>(term.Weight()) }, gradient);
}

template <class AnyDevice>
void Terms<AnyDevice>::DifferentiateSeen(
  Term& term, const float* extinction, float kept, float* gradient)
{
  TermFields fields = this->FieldsOf(term, extinction);
  fields.base = nullptr; // nothing is summed
  term.DifferentiateSeen(fields, this->Given->settings.derivative,
    { kept, static_cast<float>(term.Weight()) }, gradient);
}

template <class AnyDevice>
void Terms<AnyDevice>::MeasureTerm(Term& term, const float* extinction)
{
  const TermFields fields = this->FieldsOf(term, extinction);
  term.Forward(fields, nullptr);
  this->TakeSeen(term, fields.CountsKept());
}

template <class AnyDevice>
void Terms<AnyDevice>::DifferentiateOne(
  Term& term, const float* extinction, const GradientTarget& target, float* gradient)
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
void Terms<AnyDevice>::TakeSeen(Term& term, Kept kept)
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
      { changes, nullptr }, this->Given->grid.NodeCount(), &this->Moved()->changes });
}

template <class AnyDevice>
void Terms<AnyDevice>::TakeMoved(const float* extinction, const float* last)
{
  this->Unsummed.extinction = extinction;
  this->Unsummed.last = last;
}

template <class AnyDevice>
void Terms<AnyDevice>::TakeSwept(
  Term& swept, Kept kept, [[maybe_unused]] ExactDifferences& moved, const float* last, float* next)
{
  this->Shared.Share(next, swept.Number());
  if constexpr (AnyDevice::readsHostMemory)
  {
    this->Given->SumOverAll(moved.Exact().data(), moved.Exact().size());
    *this->Moved() = moved.Values();
  }
  else
  {
    this->TakeMoved(next, last);
  }
  this->TakeSeen(swept, kept);
}

template <class AnyDevice>
void Terms<AnyDevice>::Sum()
{
  const Taken taken = std::exchange(this->Unsummed, {});
  if constexpr (AnyDevice::readsHostMemory)
  {
    for (const typename Taken::OfTerm& seen : taken.seen)
    {
      seen.term->Sum(this->SumOf(*seen.term), seen.kept);
    }
    for (std::size_t i = 0; taken.extinction && i < this->Pulls().size(); ++i)
    {
      // In distributed runs no process holds the whole base extinction.
      const float* reference = this->Pulls()[i].reference;
      this->Moved()->squares[i] =
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
  Differences* moved = this->Moved();
  SumsOfSeen first[2]; // the sums of more terms take a launch each
  for (std::size_t i = 0; i < taken.seen.size(); ++i)
  {
    const typename Taken::OfTerm& seen = taken.seen[i];
    const SumsOfSeen by = seen.term->SumsInto(this->SumOf(*seen.term), seen.kept);
    if (i < std::size(first))
    {
      first[i] = by;
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
      nodes, isPull ? &moved->squares[number] : nullptr };
  };
  this->Add("sums", first[0].all.visible, first[0].all.unattenuated, first[0].kept.visible,
    first[0].kept.unattenuated, first[1].all.visible, first[1].all.unattenuated,
    first[1].kept.visible, first[1].kept.unattenuated,
    Summand<AbsoluteChange>{
      { taken.extinction, taken.last }, nodes, taken.last ? &moved->changes : nullptr },
    squares(Numbers)...);
}

template <class AnyDevice>
IterationRecord Terms<AnyDevice>::Record()
{
  this->Sum();
  const std::vector<TermSums> sums = this->ReadSums();
  const Differences& moved = sums.front().moved;
  const Weights& weights = this->Given->settings.weights;
  IterationRecord record;
  const Problem& problem = *this->Given;
  for (std::size_t i = 0; i < this->Pulls().size(); ++i)
  {
    const Pull& pull = this->Pulls()[i];
    pull.summand(record.energy) += problem.EnergyOf(pull, moved.squares[i]); // Eq. (22)
  }
  double visible = 0; // by all cameras
  double lit = 0;
  std::vector<Score> scores;
  for (const Term& term : this->all)
  {
    const Seen& seen = sums[term.Number()].seen;
    (term.IsOfCamera() ? visible : lit) += seen.all.visible;
    if (term.IsOfCamera() && !this->Base.empty())
    {
      scores.push_back(ScoreOf(seen, this->Base[term.Number()].unattenuated)); // Eq. (32)
    }
  }
  record.energy.view = -weights.view * (visible / problem.NumberOfCameras()); // Eq. (23)
  record.energy.light = -weights.light * lit;                                 // Eq. (24)
  record.score = scores.empty() ? Score() : MeanOf(scores);
  record.meanChange = this->Given->MeanChange(moved.changes);
  return record;
}

template <class AnyDevice>
std::vector<TermSums> Terms<AnyDevice>::ReadSums() const
{
  std::vector<TermSums> sums(this->Found.Size());
  this->Found.Download(sums.data());
  return sums;
}

template class Terms<CompiledDevice>;
}
