// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled twice, see CompiledDevice.h.

#include "render/ExtinctionOverlayOnDevice.h"

#include <algorithm>

namespace limpid
{
template <class Device>
void ExtinctionOverlayOnDevice<Device>::Clear()
{
  *this = ExtinctionOverlayOnDevice(this->Home);
}

template <class Device>
void ExtinctionOverlayOnDevice<Device>::Fit(const Grid& grid)
{
  const bool same = !this->Empty() && grid.nodes == this->Place.nodes &&
    grid.spacing == this->Place.spacing && grid.origin == this->Place.origin;
  if (same)
  {
    return;
  }
  const Index count = grid.NodeCount();
  DeviceArray<Device, std::int16_t> numbers(this->Home, std::size_t(4 * count), "the overlay");
  if (this->Empty())
  {
    this->Home->ForIndices("clear the overlay", count, UnchangedNode{ numbers.Data() });
  }
  else
  {
    ResampledNode body{ CellGrid(this->Count),
      reinterpret_cast<const FourPacked*>(this->Numbers.Data()), CountsOf(grid.nodes), {},
      reinterpret_cast<FourPacked*>(numbers.Data()) };
    for (int axis = 0; axis < 3; ++axis)
    {
      body.scale[axis] = float(this->Count[axis] - 1) / float(std::max(grid.nodes[axis] - 1, 1));
    }
    this->Home->ForIndices("resample the overlay", count, body);
  }
  this->Numbers = std::move(numbers);
  this->HasShadow = false;
  this->Place = grid;
  this->Count = grid.nodes;
}

template <class Device>
void ExtinctionOverlayOnDevice<Device>::MoveTo(const Grid& grid, const float* base,
  const float* extinction, float unit, double share, float* shown)
{
  const float rescale = unit > 0 && !this->Empty() ? this->Unit / unit : 1.0f;
  this->Fit(grid);
  this->Unit = unit;
  this->MayChange = this->MayChange || base != extinction;
  const OverlayNode node{ { grid.nodes.x, grid.nodes.y, grid.nodes.z }, base, extinction,
    unit > 0 ? 1 / unit : 0.0f, static_cast<float>(share), rescale, this->Numbers.Data() };
  this->Home->ForIndices("move the overlay", grid.NodeCount(), MovedNode{ node, unit, shown });
}

template <class Device>
void ExtinctionOverlayOnDevice<Device>::ClearShadow()
{
  this->HasShadow = false;
  this->Home->ForIndices(
    "clear shadows", this->Place.NodeCount(), UnshadowedNode{ this->Numbers.Data() });
}

template <class Device>
void ExtinctionOverlayOnDevice<Device>::SetShadow(const Int3& nodes, const float* transmittance)
{
  this->HasShadow = true;
  this->Home->ForIndices("take shadows", this->Place.NodeCount(),
    ShadowedNode{ CountsOf(nodes), transmittance, CountsOf(this->Count), this->Numbers.Data() });
}

template class ExtinctionOverlayOnDevice<CompiledDevice>;
}
