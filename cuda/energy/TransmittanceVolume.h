// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_TransmittanceVolume_h
#define limpid_energy_TransmittanceVolume_h

#include "scene/Grid.h"
#include "scene/RaySource.h"

namespace limpid
{
/// Rays per voxel and axis that keep the transmittance of nodes within 2e-3 rms of a march to the
/// eye, also behind the steep edges of an optimised extinction (DrawnScene tests).
constexpr double transmittanceRayDensity = 3;

/**
 * Transmittance from an eye to every node of a grid, Eqs. (15) and (16), by one sweep front to
 * back.
 *
 * `extinction`: grid.NodeCount() values >= 0 [1/length]; `rayDensity`: rays per voxel and axis;
 * `transmittance`: room for grid.NodeCount() values in [0, 1].
 */
void FillTransmittance(const Grid& grid, const float* extinction, const RaySource& eye,
  double rayDensity, float* transmittance);
}

#endif
