// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled for GPUs; RefineRows.cxx is for the processor.

#include "energy/NodeTransmittance.h"

#include "backend/CompiledDevice.h"

namespace limpid
{
namespace
{
struct RefineNode
{
  NodeRays rays;
  NodesWithin cells;
  FieldWithin extinction;
  FieldWithin swept;
  float* transmittance;

  LIMPID_HD void operator()(Index index, int i, int j, int k) const
  {
    const Int3 node(i, j, k);
    this->transmittance[index] = this->swept.IsSteepAt(node) && this->rays.See(node)
      ? TransmittanceOf(this->rays.DepthTo(node, this->extinction, this->cells, AllCells()))
      : this->swept.values[index];
  }

  struct AllCells
  {
    LIMPID_HD bool operator()(const Int3&) const { return true; }
  };
};
}

template <class AnyDevice>
void RefineTransmittance(AnyDevice& device, const Grid& grid, const RaySource& source,
  const float* extinction, const float* swept, float* transmittance)
{
  const NodesWithin all = NodesWithin::Whole(grid);
  device.ForNodes("refine transmittance", grid.nodes,
    RefineNode{ NodeRays(grid, source), NodesWithin::CellsOf(grid), { extinction, all },
      { swept, all }, transmittance });
}

template void RefineTransmittance<CompiledDevice>(
  CompiledDevice&, const Grid&, const RaySource&, const float*, const float*, float*);
}
