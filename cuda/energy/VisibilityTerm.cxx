// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled for each device, see CompiledDevice.h.

#include "energy/VisibilityTerm.h"

#include "backend/CompiledDevice.h"
#include "energy/ScoreKernel.h"
#include "sweep/Sweeps.h"

namespace limpid
{
template <class AnyDevice>
VisibilityTerm<AnyDevice>::VisibilityTerm(std::shared_ptr<AnyDevice> device, const Grid& grid,
  const Occupancy& occupancy, const RaySource& source, double rayDensity, bool fine)
  : Device(std::move(device))
  , Filled(&occupancy)
  , Rays(
      PlanRays(this->Device, grid, occupancy, source, { rayDensity, RayPlacement::ForIntegrals }))
  , Fine(fine)
  , Add(this->Device)
{
}

template <class AnyDevice>
void VisibilityTerm<AnyDevice>::Forward(const TermFields& fields, Seen* sum)
{
  for (std::size_t index = 0; index < this->Rays.size(); ++index)
  {
    this->ForwardAt(index, fields);
  }
  if (sum)
  {
    this->Sum(sum, fields.CountsKept());
  }
}

template <class AnyDevice>
void VisibilityTerm<AnyDevice>::ForwardAt(std::size_t frustum, const TermFields& fields)
{
  FrustumRays<AnyDevice>& rays = this->Rays[frustum];
  this->Fine ? this->Score<FineCuts>(rays, fields) : this->Score<UsualCuts>(rays, fields);
}

template <class AnyDevice>
template <class Cuts>
void VisibilityTerm<AnyDevice>::Score(FrustumRays<AnyDevice>& rays, const TermFields& fields)
{
  SweepForward(*this->Device, rays, *this->Filled,
    ScoreKernel<const float*, Cuts>{ fields.extinction, fields.importance, fields.base });
}

template <class AnyDevice>
void VisibilityTerm<AnyDevice>::FindCeiling(const CeilingFields& fields, Seen* sum)
{
  for (FrustumRays<AnyDevice>& rays : this->Rays)
  {
    this->Fine ? this->FindMost<FineCuts>(rays, fields) : this->FindMost<UsualCuts>(rays, fields);
  }
  this->Sum(sum, fields.CountsKept());
}

template <class AnyDevice>
template <class Cuts>
void VisibilityTerm<AnyDevice>::FindMost(FrustumRays<AnyDevice>& rays, const CeilingFields& fields)
{
  SweepRaysBackward(*this->Device, rays, *this->Filled,
    CeilingKernel<const float*, Cuts>{
      fields.base, fields.importance, fields.least, fields.most, fields.CountsKept() });
}

template <class AnyDevice>
void VisibilityTerm<AnyDevice>::Differentiate(const TermFields& fields, Derivative derivative,
  const GradientTarget& target, float* gradient, Seen* sum)
{
  // Without the weight of widening rays, they do not carry the score.
  const bool areaWeighted = derivative == Derivative::Volume;
  if (!areaWeighted)
  {
    this->Forward(fields, sum);
  }
  for (FrustumRays<AnyDevice>& rays : this->Rays)
  {
    if (areaWeighted)
    {
      SweepForward(
        *this->Device, rays, *this->Filled, DepthKernel<const float*>{ fields.extinction });
    }
    this->SweepGradient(rays, fields, derivative, target, gradient);
  }
  if (areaWeighted && sum)
  {
    this->Sum(sum, fields.CountsKept());
  }
}

template <class AnyDevice>
void VisibilityTerm<AnyDevice>::Sum(Seen* sum, Kept kept)
{
  SumRays(this->Add, this->Rays, kept, sum);
}

template <class AnyDevice>
void VisibilityTerm<AnyDevice>::DifferentiateSeen(
  const TermFields& fields, Derivative derivative, const GradientTarget& target, float* gradient)
{
  for (FrustumRays<AnyDevice>& rays : this->Rays)
  {
    this->SweepGradient(rays, fields, derivative, target, gradient);
  }
}

template <class AnyDevice>
void VisibilityTerm<AnyDevice>::SweepGradient(FrustumRays<AnyDevice>& rays,
  const TermFields& fields, Derivative derivative, const GradientTarget& target, float* gradient)
{
  // Without the weight of widening rays, they do not carry the score.
  if (derivative == Derivative::Volume && fields.CountsKept() == Kept::Counted)
  {
    this->SweepGradientAs<Kept::Counted>(rays, fields, derivative, target, gradient);
  }
  else
  {
    this->SweepGradientAs<Kept::Ignored>(rays, fields, derivative, target, gradient);
  }
}

template <class AnyDevice>
template <Kept kept>
void VisibilityTerm<AnyDevice>::SweepGradientAs(FrustumRays<AnyDevice>& rays,
  const TermFields& fields, Derivative derivative, const GradientTarget& target, float* gradient)
{
  const GradientKernel<const float*, float*, kept> kernel{ fields.extinction, fields.importance,
    fields.nodeImportance, kept == Kept::Counted ? fields.base : nullptr, gradient, target,
    derivative == Derivative::Volume };
  SweepBackward(*this->Device, rays, *this->Filled, kernel);
}

template class VisibilityTerm<CompiledDevice>;
}
