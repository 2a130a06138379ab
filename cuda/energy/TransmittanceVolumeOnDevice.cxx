// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled twice, see CompiledDevice.h.

#include "energy/TransmittanceVolumeOnDevice.h"

#include "energy/TransmittanceVolumeBodies.h"

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

std::vector<EnteredRays> EnteredOf(const Pyramid& pyramid)
{
  std::vector<EnteredRays> entered;
  entered.reserve(pyramid.stations.size());
  for (const Station& station : pyramid.stations)
  {
    entered.push_back({ RaysEnteredBy(pyramid.columnAxis, station.relativeDepth),
      RaysEnteredBy(pyramid.rowAxis, station.relativeDepth) });
  }
  return entered;
}
}

template <class Device>
TransmittanceVolumeOnDevice<Device>::TransmittanceVolumeOnDevice(std::shared_ptr<Device> device,
  const Grid& grid, const Occupancy& occupancy, const Eye& eye, double rayDensity)
  : Home(std::move(device))
  , Nodes(grid.NodeCount())
{
  std::size_t most = 0;
  for (const Pyramid& pyramid : PlanSweep(grid, occupancy, eye, rayDensity, Placement::ForNodes))
  {
    this->Pyramids.push_back({ { this->Home, pyramid, grid, occupancy },
      { this->Home, EnteredOf(pyramid), "the plan of a sweep" } });
    most = std::max(most, this->Pyramids.back().rays.RayCount());
  }
  this->OpticalDepth = { this->Home, most, "optical depths" };
  this->Images = { this->Home, 2 * slicesPerSlab * most, "images of rays" };
}

template <class Device>
void TransmittanceVolumeOnDevice<Device>::Fill(const float* extinction, float* transmittance)
{
  this->Home->ForIndices("clear transmittance", this->Nodes, ClearNode{ transmittance });
  for (const PyramidOfNodes& pyramid : this->Pyramids)
  {
    this->Sweep(pyramid, extinction, transmittance);
  }
}

template <class Device>
void TransmittanceVolumeOnDevice<Device>::Sweep(
  const PyramidOfNodes& pyramid, const float* extinction, float* transmittance)
{
  const PyramidView& view = pyramid.rays.View();
  this->OpticalDepth.SetZero();
  for (int begin = 0; begin <= view.lastStation; begin += slicesPerSlab)
  {
    const int end = std::min(begin + slicesPerSlab, view.lastStation + 1);
    this->Home->ForEach("transmittance of rays", pyramid.rays.Rays(),
      TransmittanceRay{
        view, extinction, begin, end, this->OpticalDepth.Data(), this->Images.Data() });
    this->Home->ForEach("transmittance", { view.nodesU, view.nodesV * (end - begin) },
      TransmittanceVoxel{
        view, begin, pyramid.entered.Data(), this->Images.Data(), transmittance });
  }
}

template class TransmittanceVolumeOnDevice<CompiledDevice>;
}
