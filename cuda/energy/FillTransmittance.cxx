// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "energy/TransmittanceSweep.h"

namespace limpid
{
void FillTransmittance(const Grid& grid, const float* extinction, const RaySource& source,
  double rayDensity, float* transmittance)
{
  const Occupancy occupancy(grid, extinction, extinction, true);
  TransmittanceSweep<HostDevice>(HostDevice::Shared(), grid, occupancy, source, rayDensity)
    .Fill(extinction, transmittance);
}
}
