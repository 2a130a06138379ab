// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled twice, see CompiledDevice.h.

#include "energy/TermOnDevice.h"

#include <algorithm>

namespace limpid
{
namespace
{
/// So few that the images of the rays stay in the cache of a large GPU: 30 MB at 256^3.
constexpr int slicesPerSlab = 8;

struct ClearRay
{
  RayStates states;

  LIMPID_HD LIMPID_INLINE void operator()(Index ray) const
  {
    this->states.behind[ray] = 0;
    this->states.visible[ray] = -1;
    this->states.unattenuated[ray] = 0;
    this->states.transmittance[ray] = 1;
    this->states.density[ray] = 0;
    this->states.ahead[ray] = 0;
    this->states.collected[ray] = 0;
  }
};
}

template <class Device>
RaysOnDevice<Device>::RaysOnDevice(const std::shared_ptr<Device>& device,
  const FaceFrustum& frustum, const Grid& grid, const Occupancy& occupancy)
  : Home(device)
  , Tables(device, frustum, grid, occupancy)
  , OpticalDepths(device, 2 * this->Tables.RayCount(), "optical depths")
  , Others(device, 6 * this->Tables.RayCount(), "rays")
{
}

template <class Device>
RayStates RaysOnDevice<Device>::States()
{
  const std::size_t count = this->Tables.RayCount();
  double* depths = this->OpticalDepths.Data();
  float* others = this->Others.Data();
  return { depths + (this->Swapped ? count : 0), others, others + count, others + 2 * count,
    others + 3 * count, others + 4 * count, others + 5 * count,
    depths + (this->Swapped ? 0 : count) };
}

template <class Device>
void RaysOnDevice<Device>::Reset()
{
  this->Home->ForIndices(
    "clear rays", static_cast<Index>(this->Tables.RayCount()), ClearRay{ this->States() });
}

template <class Device>
TermOnDevice<Device>::TermOnDevice(std::shared_ptr<Device> device, const Grid& grid,
  const Occupancy& occupancy, const RaySource& eye, double rayDensity)
  : Home(std::move(device))
  , Sum(this->Home)
{
  std::size_t count = 0;
  for (const FaceFrustum& frustum : PlanSweep(grid, occupancy, eye, rayDensity))
  {
    this->Rays.emplace_back(this->Home, frustum, grid, occupancy);
    this->First.push_back(count);
    count += this->Rays.back().Plan().RayCount();
  }
  this->Gathered = { this->Home, 2 * count, "rays" };
  this->Shares = { this->Home, count, "rays" };
  for (std::size_t index = 0; index < this->Rays.size(); ++index)
  {
    const FrustumOnDevice<Device>& plan = this->Rays[index].Plan();
    this->Home->Copy(this->Shares.Data() + this->First[index], plan.View().shares,
      plan.RayCount() * sizeof(double));
  }
}

template <class Device>
RayTotals TermOnDevice<Device>::TotalsOf(std::size_t frustum)
{
  float* visible = this->Gathered.Data() + this->First[frustum];
  return { visible, visible + this->Shares.Size() };
}

template <class Device>
void TermOnDevice<Device>::SumTotals(double* sums)
{
  const auto count = static_cast<Index>(this->Shares.Size());
  const double* shares = this->Shares.Data();
  const float* visible = this->Gathered.Data();
  this->Sum("visible importance", count, WeightedRay{ shares, visible }, sums);
  this->Sum("importance", count, WeightedRay{ shares, visible + count }, sums + 1);
}

template <class Device>
void TermOnDevice<Device>::Forward(const float* extinction, const float* importance, double* sums)
{
  for (std::size_t index = 0; index < this->Rays.size(); ++index)
  {
    this->ForwardAt(index, extinction, importance);
  }
  this->SumTotals(sums);
}

template <class Device>
void TermOnDevice<Device>::ForwardAt(
  std::size_t frustum, const float* extinction, const float* importance)
{
  RaysOnDevice<Device>& rays = this->Rays[frustum];
  this->Home->ForEach("forward sweep", rays.Plan().Rays(),
    ForwardRay{ rays.Plan().View(), extinction, importance, rays.States().opticalDepth,
      this->TotalsOf(frustum) });
}

template <class Device>
void TermOnDevice<Device>::Differentiate(
  const TermFields& fields, Derivative derivative, const GradientTarget& target, double* sums)
{
  if (this->Images.Empty())
  {
    this->Images = { this->Home, 3 * slicesPerSlab * this->MostRays(), "images of rays" };
  }
  // Without the weight of the rays, what they carry is not the score.
  const bool widens = derivative == Derivative::Volume;
  if (!widens)
  {
    this->Forward(fields.extinction, fields.importance, sums);
  }
  for (std::size_t index = 0; index < this->Rays.size(); ++index)
  {
    RaysOnDevice<Device>& rays = this->Rays[index];
    const FrustumView& view = rays.Plan().View();
    if (widens)
    {
      this->Home->ForEach("optical depths", rays.Plan().Rays(),
        DepthRay{ view, fields.extinction, rays.States().opticalDepth });
    }
    rays.Reset();
    for (int end = view.lastSlice + 1; end > view.firstNodeSlice; end -= slicesPerSlab)
    {
      const int begin = std::max(view.firstNodeSlice, end - slicesPerSlab);
      this->Home->ForEach("backward sweep", rays.Plan().Rays(),
        BackwardRay{ view, fields.extinction, fields.importance, widens, begin, end, rays.States(),
          this->Images.Data(), this->TotalsOf(index) });
      this->Home->ForEach("derivative", { view.nodesU, view.nodesV * (end - begin) },
        GradientOfVoxel{ view, widens, begin, this->Images.Data(), fields.nodeImportance, target });
    }
  }
  if (widens)
  {
    this->SumTotals(sums);
  }
}

template <class Device>
std::size_t TermOnDevice<Device>::MostRays() const
{
  std::size_t most = 0;
  for (const RaysOnDevice<Device>& rays : this->Rays)
  {
    most = std::max(most, rays.Plan().RayCount());
  }
  return most;
}

template class RaysOnDevice<CompiledDevice>;
template class TermOnDevice<CompiledDevice>;
}
