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

struct SetValue
{
  float value;
  float* out;
  LIMPID_HD LIMPID_INLINE void operator()(Index index) const { this->out[index] = this->value; }
};
}

template <class Device>
RaysOnDevice<Device>::RaysOnDevice(const std::shared_ptr<Device>& device, const Pyramid& pyramid,
  const Grid& grid, const Occupancy& occupancy)
  : Home(device)
  , Tables(device, pyramid, grid, occupancy)
  , OpticalDepth(device, this->Tables.RayCount(), "optical depths")
  , Others(device, 4 * this->Tables.RayCount(), "rays")
{
}

template <class Device>
RayStates RaysOnDevice<Device>::States()
{
  const std::size_t count = this->Tables.RayCount();
  float* others = this->Others.Data();
  return { this->OpticalDepth.Data(), others, others + count, others + 2 * count,
    others + 3 * count };
}

template <class Device>
void RaysOnDevice<Device>::Reset()
{
  this->Others.SetZero();
  this->Home->ForIndices("clear rays", static_cast<Index>(this->Tables.RayCount()),
    SetValue{ 1.0f, this->States().transmittance });
}

template <class Device>
TermOnDevice<Device>::TermOnDevice(std::shared_ptr<Device> device, const Grid& grid,
  const Occupancy& occupancy, const Eye& eye, double rayDensity)
  : Home(std::move(device))
  , Sum(this->Home)
{
  std::size_t count = 0;
  for (const Pyramid& pyramid : PlanSweep(grid, occupancy, eye, rayDensity))
  {
    this->Rays.emplace_back(this->Home, pyramid, grid, occupancy);
    count += this->Rays.back().Plan().RayCount();
  }
  this->Gathered = { this->Home, 2 * count, "rays" };
  this->Shares = { this->Home, count, "rays" };
  std::size_t first = 0;
  for (RaysOnDevice<Device>& rays : this->Rays)
  {
    const std::size_t here = rays.Plan().RayCount();
    this->Home->Copy(this->Shares.Data() + first, rays.Plan().View().shares, here * sizeof(double));
    first += here;
  }
}

template <class Device>
void TermOnDevice<Device>::Forward(const float* extinction, const float* importance, double* sums)
{
  const std::size_t count = this->Shares.Size();
  float* visible = this->Gathered.Data();
  float* plain = visible + count;
  std::size_t first = 0;
  for (RaysOnDevice<Device>& rays : this->Rays)
  {
    this->Home->ForEach("forward sweep", rays.Plan().Rays(),
      ForwardRay{ rays.Plan().View(), extinction, importance, rays.States().opticalDepth,
        visible + first, plain + first });
    first += rays.Plan().RayCount();
  }
  const double* shares = this->Shares.Data();
  this->Sum("visible importance", static_cast<Index>(count), WeightedRay{ shares, visible }, sums);
  this->Sum("importance", static_cast<Index>(count), WeightedRay{ shares, plain }, sums + 1);
}

template <class Device>
void TermOnDevice<Device>::AddGradient(
  const TermFields& fields, Derivative derivative, float weight, float* gradient)
{
  if (this->Images.Empty())
  {
    this->Images = { this->Home, 3 * slicesPerSlab * this->MostRays(), "images of rays" };
  }
  const bool widens = derivative == Derivative::Volume;
  for (RaysOnDevice<Device>& rays : this->Rays)
  {
    const PyramidView& view = rays.Plan().View();
    rays.Reset();
    for (int end = view.lastStation + 1; end > view.firstSlice; end -= slicesPerSlab)
    {
      const int begin = std::max(view.firstSlice, end - slicesPerSlab);
      this->Home->ForEach("backward sweep", rays.Plan().Rays(),
        BackwardRay{ view, fields.extinction, fields.importance, widens, begin, end, rays.States(),
          this->Images.Data() });
      this->Home->ForEach("derivative", { view.nodesU, view.nodesV * (end - begin) },
        GradientOfVoxel{
          view, widens, begin, this->Images.Data(), fields.nodeImportance, weight, gradient });
    }
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
