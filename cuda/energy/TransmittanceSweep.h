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
/// Number of rays per voxel and axis at which the transmittance of nodes is within 2e-3 rms of a
/// march to the source, even behind the steep edges of an optimised extinction (DrawnScene tests).
constexpr double transmittanceRayDensity = 3;

/**
 * Transmittance from a source of rays to every node of a grid, Eqs. (15) and (16), in one
 * front-to-back sweep. The plan is valid for one grid and one source, and for every extinction
 * that is zero where the occupancy is empty. A device visits only what the extinction dims, which
 * it finds anew for each.
 *
 * On a device, at 256^3 nodes with three rays per voxel and axis, there are 66 thousand rays from
 * a light along an axis, 1.0 million from an oblique one and 1.5 million from a point outside. An
 * oblique light then takes two launches. One number per ray and slice is written and read once, and
 * one more near the sides of the box. The extinction is read once (67 MB) and the result written
 * twice (134 MB).
 */
template <class AnyDevice>
class TransmittanceSweep
{
public:
  /// `occupancy`: Occupancy(grid, extinction, extinction, true) for an extinction that is filled
  /// wherever others may be.
  TransmittanceSweep(std::shared_ptr<AnyDevice> device, const Grid& grid,
    const Occupancy& occupancy, const RaySource& source, double rayDensity);

  /// `extinction` [1/length] and `transmittance` [0, 1]: one value per node, on the device.
  /// Asynchronous.
  void Fill(const float* extinction, float* transmittance);

  /// Like Fill, but writes only nodes that rays reach.
  void Sweep(const float* extinction, float* transmittance);

  std::vector<FrustumRays<AnyDevice>>& Frusta() { return this->Rays; }

private:
  std::shared_ptr<AnyDevice> Device;
  Int3 Nodes{ 0 };
  std::vector<FrustumRays<AnyDevice>> Rays;
};

/// TransmittanceSweep on the processor, for a single extinction.
void FillTransmittance(const Grid& grid, const float* extinction, const RaySource& source,
  double rayDensity, float* transmittance);
}

#endif
