// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_TransmittanceVolumeOnDevice_h
#define limpid_energy_TransmittanceVolumeOnDevice_h

#include "energy/EnteredRays.h"
#include "sweep/FrustumOnDevice.h"

#include <memory>
#include <vector>

namespace limpid
{
/**
 * FillTransmittance on a device. Its plan holds for one grid and one eye, and for every extinction
 * that is zero where the occupancy is empty.
 *
 * At 256^3 nodes with three rays per voxel and axis there are 66 thousand rays from a light along
 * an axis, 1.0 million from an oblique one, 1.5 million from a point outside. For the oblique one
 * that is: 65 launches; per ray and slice one number written and read once (2 GB in all, 31 MB at a
 * time, which fit into the second-level cache of a large GPU); the extinction read once (67 MB),
 * the result written twice (134 MB); 94 MB of memory, of which the plan, 24 MB, travels to the
 * device when it is made.
 */
template <class Device>
class TransmittanceVolumeOnDevice
{
public:
  /// `occupancy`: Occupancy(grid, extinction, extinction, true) for any extinction that is filled
  /// wherever others may be.
  TransmittanceVolumeOnDevice(std::shared_ptr<Device> device, const Grid& grid,
    const Occupancy& occupancy, const RaySource& eye, double rayDensity);

  /// The arrays of FillTransmittance, on the device. Does not wait.
  void Fill(const float* extinction, float* transmittance);

private:
  struct FrustumOfNodes
  {
    FrustumOnDevice<Device> rays;
    DeviceArray<Device, EnteredRays> entered; ///< per slice
  };

  void Sweep(const FrustumOfNodes& frustum, const float* extinction, float* transmittance);

  std::shared_ptr<Device> Home;
  Index Nodes = 0;
  std::vector<FrustumOfNodes> Frusta;
  DeviceArray<Device, double> OpticalDepth; ///< of the rays of one frustum at a time
  DeviceArray<Device, float> Images;        ///< see TransmittanceRay
};
}

#endif
