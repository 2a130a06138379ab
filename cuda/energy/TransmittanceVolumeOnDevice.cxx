// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled twice, see CompiledDevice.h.

#include "energy/TransmittanceVolumeOnDevice.h"

#include "energy/TransmittanceVolumeKernels.h"

#include <algorithm>

namespace limpid
{
namespace
{
/// So few that the images of a slab stay in the second-level cache, and as many as there are floats
/// in 32 bytes, which a slab writes at once where the depth axis is the fastest in memory.
constexpr int slicesPerSlab = 8;

struct ClearNode
{
  float* transmittance;
  LIMPID_HD LIMPID_INLINE void operator()(Index node) const { this->transmittance[node] = 1; }
};

std::vector<EnteredRays> EnteredOf(const FaceFrustum& frustum)
{
  std::vector<EnteredRays> entered;
  entered.reserve(frustum.slices.size());
  for (const Slice& slice : frustum.slices)
  {
    entered.push_back({ RaysEnteredBy(frustum.columnAxis, slice.relativeDepth),
      RaysEnteredBy(frustum.rowAxis, slice.relativeDepth) });
  }
  return entered;
}
}

template <class Device>
TransmittanceVolumeOnDevice<Device>::TransmittanceVolumeOnDevice(std::shared_ptr<Device> device,
  const Grid& grid, const Occupancy& occupancy, const RaySource& eye, double rayDensity)
  : Home(std::move(device))
  , Nodes(grid.NodeCount())
{
  std::size_t most = 0;
  for (const FaceFrustum& frustum :
    PlanSweep(grid, occupancy, eye, rayDensity, Placement::ForNodes))
  {
    this->Frusta.push_back({ { this->Home, frustum, grid, occupancy },
      { this->Home, EnteredOf(frustum), "the plan of a sweep" } });
    most = std::max(most, this->Frusta.back().rays.RayCount());
  }
  this->OpticalDepth = { this->Home, most, "optical depths" };
  this->Images = { this->Home, 2 * slicesPerSlab * most, "images of rays" };
}

template <class Device>
void TransmittanceVolumeOnDevice<Device>::Fill(const float* extinction, float* transmittance)
{
  this->Home->ForIndices("clear transmittance", this->Nodes, ClearNode{ transmittance });
  for (const FrustumOfNodes& frustum : this->Frusta)
  {
    this->Sweep(frustum, extinction, transmittance);
  }
}

template <class Device>
void TransmittanceVolumeOnDevice<Device>::Sweep(
  const FrustumOfNodes& frustum, const float* extinction, float* transmittance)
{
  const FrustumView& view = frustum.rays.View();
  this->OpticalDepth.SetZero();
  for (int begin = 0; begin <= view.lastSlice; begin += slicesPerSlab)
  {
    const int end = std::min(begin + slicesPerSlab, view.lastSlice + 1);
    this->Home->ForEach("transmittance of rays", frustum.rays.Rays(),
      TransmittanceRay{
        view, extinction, begin, end, this->OpticalDepth.Data(), this->Images.Data() });
    this->Home->ForEach("transmittance", { view.nodesU, view.nodesV * (end - begin) },
      TransmittanceVoxel{
        view, begin, frustum.entered.Data(), this->Images.Data(), transmittance });
  }
}

template class TransmittanceVolumeOnDevice<CompiledDevice>;
}
