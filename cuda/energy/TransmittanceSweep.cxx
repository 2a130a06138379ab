// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled for each device, see CompiledDevice.h.

#include "energy/TransmittanceSweep.h"

#include "backend/CompiledDevice.h"
#include "energy/TransmittanceKernel.h"
#include "sweep/Sweeps.h"

namespace limpid
{
namespace
{
struct ClearNode
{
  float* transmittance;
  LIMPID_HD LIMPID_INLINE void operator()(Index node) const { this->transmittance[node] = 1; }
};
}

template <class AnyDevice>
TransmittanceSweep<AnyDevice>::TransmittanceSweep(std::shared_ptr<AnyDevice> device,
  const Grid& grid, const Occupancy& occupancy, const RaySource& source, double rayDensity)
  : Device(std::move(device))
  , Nodes(grid.nodes)
  , Rays(PlanRays(this->Device, grid, occupancy, source, { rayDensity, RayPlacement::ForNodes }))
{
}

template <class AnyDevice>
void TransmittanceSweep<AnyDevice>::Fill(const float* extinction, float* transmittance)
{
  const Index count = Index(this->Nodes.x) * this->Nodes.y * this->Nodes.z;
  this->Device->ForIndices("clear transmittance", count, ClearNode{ transmittance });
  this->Sweep(extinction, transmittance);
}

template <class AnyDevice>
void TransmittanceSweep<AnyDevice>::Sweep(const float* extinction, float* transmittance)
{
  const FieldBlocks<AnyDevice> dimming(this->Device, this->Nodes, extinction);
  for (FrustumRays<AnyDevice>& rays : this->Rays)
  {
    SweepFrontToBack(this->Device, rays, dimming,
      TransmittanceKernel<const float*, float*>{ extinction, transmittance });
  }
}

template class TransmittanceSweep<CompiledDevice>;
}
