// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_TransmittanceOnRanks_h
#define limpid_energy_TransmittanceOnRanks_h

#include "distributed/ScenePiece.h"
#include "scene/Occupancy.h"
#include "scene/RaySource.h"
#include "sweep/FrustumRays.h"

#include <vector>

namespace limpid
{
/// Makes sweeps use the fields of the ranks' subdomains. `filled`: see FieldSlabs.
void SweepSubdomains(
  std::vector<FrustumRays<HostDevice>>& frusta, const ScenePiece& piece, const Occupancy* filled);

/// Computes the transmittance from a source through an extinction of this rank's subdomain, see
/// TransmittanceSweep. `grid`: of the whole scene.
void FindTransmittanceOnRanks(const Grid& grid, const ScenePiece& piece, const RaySource& source,
  double rayDensity, const float* extinction, float* transmittance);

/// Applies RefineTransmittance in place to this rank's subdomain; bit-identical to one process.
void RefineTransmittanceOnRanks(const Grid& grid, const ScenePiece& piece, const RaySource& source,
  const float* extinction, float* transmittance);
}

#endif
