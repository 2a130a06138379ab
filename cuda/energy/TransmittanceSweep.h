// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_TransmittanceSweep_h
#define limpid_energy_TransmittanceSweep_h

#include "scene/Grid.h"
#include "scene/RaySource.h"
#include "sweep/FrustumRays.h"

#include <memory>
#include <vector>

namespace limpid
{
/// Rays per voxel and axis that keep the transmittance of nodes within 2e-3 rms of a march to the
/// source, also behind the steep edges of an optimised extinction (DrawnScene tests).
constexpr double transmittanceRayDensity = 3;

/**
 * Transmittance from a source of rays to every node of a grid, Eqs. (15) and (16), by one sweep
 * front to back. The plan holds for one grid and one source, and for every extinction that is zero
 * where the occupancy is empty.
 *
 * On a device, at 256^3 nodes with three rays per voxel and axis, there are 66 thousand rays from a
 * light along an axis, 1.0 million from an oblique one, 1.5 million from a point outside. For the
 * oblique one that is: two launches; per ray and slice three numbers written and read once; the
 * extinction read once (67 MB), the result written twice (134 MB).
 */
template <class AnyDevice>
class TransmittanceSweep
{
public:
  /// `occupancy`: Occupancy(grid, extinction, extinction, true) for any extinction that is filled
  /// wherever others may be. `ranks`: see PlanSettings.
  TransmittanceSweep(std::shared_ptr<AnyDevice> device, const Grid& grid,
    const Occupancy& occupancy, const RaySource& source, double rayDensity,
    const Communicator* ranks = nullptr);

  /// `extinction` [1/length] and `transmittance` [0, 1]: a value per node, on the device. Does not
  /// wait.
  void Fill(const float* extinction, float* transmittance);

  /// The same at nodes that rays come to, and nowhere else.
  void Sweep(const float* extinction, float* transmittance);

  std::vector<FrustumRays<AnyDevice>>& Frusta() { return this->Rays; }

private:
  std::shared_ptr<AnyDevice> Device;
  Index Nodes = 0;
  std::vector<FrustumRays<AnyDevice>> Rays;
};

/// TransmittanceSweep on the processor, for one extinction.
void FillTransmittance(const Grid& grid, const float* extinction, const RaySource& source,
  double rayDensity, float* transmittance);
}

#endif
