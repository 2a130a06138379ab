// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_ShadowVolume_h
#define limpid_render_ShadowVolume_h

#include "backend/CompiledDevice.h"
#include "backend/HostDevice.h"
#include "energy/TransmittanceSweep.h"
#include "render/DrawnPart.h"
#include "scene/Occupancy.h"

#include <memory>
#include <optional>

namespace limpid
{
/// Computes the light that arrives at the nodes of a part, on a device. GPUs draw the whole only.
template <class AnyDevice>
class ShadowVolume
{
public:
  explicit ShadowVolume(std::shared_ptr<AnyDevice> device)
    : Device(std::move(device))
  {
  }

  /// FillTransmittance on the device, with both fields in its memory. Does not wait.
  void Fill(const DrawnPart& whole, const float* extinction, const RaySource& light,
    double rayDensity, float* transmittance)
  {
    const Grid& grid = whole.Nodes();
    if (!this->Now || !this->Now->IsOf(grid, light, rayDensity))
    {
      this->Now.reset(); // first, to free memory for the other one
      // The plan is that of a completely filled volume, so that it stays valid if the extinction
      // changes.
      const Occupancy everywhere = OccupancyBuilder(grid).Take(false);
      this->Now.emplace(
        Plan{ grid, light, rayDensity, { this->Device, grid, everywhere, light, rayDensity } });
    }
    this->Now->volume.Fill(extinction, transmittance);
  }

private:
  /// The rays from one light through one grid, independent of the extinction.
  struct Plan
  {
    Grid grid;
    RaySource light;
    double rayDensity;
    TransmittanceSweep<AnyDevice> volume;

    bool IsOf(const Grid& nodes, const RaySource& source, double density) const
    {
      return this->grid.nodes == nodes.nodes && this->grid.spacing == nodes.spacing &&
        this->grid.origin == nodes.origin && this->grid.direction == nodes.direction &&
        this->light.parallel == source.parallel && this->light.origin == source.origin &&
        this->light.direction == source.direction && this->rayDensity == density;
    }
  };

  std::shared_ptr<AnyDevice> Device;
  std::optional<Plan> Now;
};

/// The processor has its own sweep.
template <>
class ShadowVolume<HostDevice>
{
public:
  explicit ShadowVolume(const std::shared_ptr<HostDevice>&) {}

  void Fill(const DrawnPart& part, const float* extinction, const RaySource& light,
    double rayDensity, float* transmittance)
  {
    part.FillTransmittance(extinction, light, rayDensity, transmittance);
  }
};
}

#endif
