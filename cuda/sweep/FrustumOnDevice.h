// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_PyramidOnDevice_h
#define limpid_sweep_PyramidOnDevice_h

#include "backend/CompiledDevice.h"
#include "scene/Grid.h"
#include "sweep/FrustumView.h"
#include "sweep/Plan.h"

#include <memory>

namespace limpid
{
/// Who will read a frustum.
enum class Readers
{
  Rays, ///< tables of voxels are left out
  RaysAndVoxels
};

/// The tables of a frustum in the memory of a device.
template <class Device>
class FrustumOnDevice
{
public:
  /// `grid`, `occupancy`: those that the frustum was planned with.
  FrustumOnDevice(std::shared_ptr<Device> device, const FaceFrustum& frustum, const Grid& grid,
    const Occupancy& occupancy, Readers readers = Readers::RaysAndVoxels);

  const FrustumView& View() const { return this->Addresses; }
  Extent Rays() const { return { this->Addresses.columns, this->Addresses.rows }; }

  std::size_t RayCount() const
  {
    return std::size_t(this->Addresses.columns) * std::size_t(this->Addresses.rows);
  }

private:
  FrustumView Addresses;
  DeviceArray<Device, unsigned char> Tables;
};
}

#endif
