// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How the processor sweeps: its threads share the rows of a slice. A kernel says what happens to
// the rays and to the voxels; SweepLaunches.h sweeps the same kernels on a device.

#ifndef limpid_sweep_SweepRows_h
#define limpid_sweep_SweepRows_h

#include "backend/Backend.h"
#include "sweep/FrustumRays.h"
#include "sweep/VoxelRow.h"

#include <algorithm>
#include <deque>
#include <vector>

namespace limpid
{
/// Rows of rays or voxels that are worth a task of their own.
constexpr Index rowsPerTask = 8;

/// The fields of a kernel as the processor reads them, slab by slab.
class FieldWindows
{
public:
  FieldWindows(const FrustumTables<HostDevice>& rays, const Occupancy* occupancy)
    : Rays(rays)
    , Occupied(occupancy)
  {
  }

  /// Null for a field that is not there.
  template <class Value>
  SliceWindow* operator()(Value* field, const FieldUse& use)
  {
    if (!field)
    {
      return nullptr;
    }
    this->All.emplace_back(this->Rays.Plan(), this->Occupied, this->Rays.Slabs(), field, use);
    if (this->Rays.Bands())
    {
      this->All.back().MoveNeeded(*this->Rays.Bands());
    }
    return &this->All.back();
  }

  void Load(const Range<int>& slab)
  {
    for (SliceWindow& window : this->All)
    {
      window.Load(slab);
    }
  }

  void Store(const Range<int>& slab)
  {
    for (SliceWindow& window : this->All)
    {
      window.Store(slab);
    }
  }

  /// Brings what the voxels of a slice have become to other ranks whose rays read it.
  void Exchange(int s)
  {
    std::vector<SliceWindow*> changed;
    for (SliceWindow& window : this->All)
    {
      if (window.IsReadBehind())
      {
        changed.push_back(&window);
      }
    }
    if (this->Rays.Bands() && !changed.empty())
    {
      this->Rays.Bands()->ExchangeVoxels(s, changed);
    }
  }

private:
  const FrustumTables<HostDevice>& Rays;
  const Occupancy* Occupied;
  std::deque<SliceWindow> All;
};

/// Brings what voxels of slice `s` read of the rays to them from other ranks, see RankBands.
inline void ExchangeRays(const FrustumRays<HostDevice>& rays, int s, bool cubic,
  const RayStates& states, float* seenBehind)
{
  if (rays.Bands())
  {
    rays.Bands()->ExchangeRays(s, cubic, { states.transmittance, states.density, seenBehind });
  }
}

/// Front to back: every row of rays through all layers. `Rays`: how they are sampled; `occupancy`:
/// see SliceWindow.
template <class Rays = RowSampler, class Kernel>
void SweepForward(
  HostDevice&, FrustumRays<HostDevice>& rays, const Occupancy& occupancy, const Kernel& kernel)
{
  const FaceFrustum& frustum = rays.Plan();
  const RayStates states = rays.States();
  const RowsHere rows = rays.RaysHere();
  ParallelFor(frustum.RayCount(), 8192, StartInFront{ states });
  FieldWindows windows(rays, &occupancy);
  const auto rowKernel = kernel.With(windows);
  for (const Range<int>& slab : SlabsOf(frustum))
  {
    windows.Load(slab);
    ParallelFor(rows.Length(), rowsPerTask / 2,
      [&](Index row)
      {
        Rays sampler(frustum, states, rows[row]);
        for (int s = slab.begin; s < std::min(slab.end, frustum.lastSlice); ++s)
        {
          rowKernel.RayStep(sampler, s);
        }
      });
  }
}

/**
 * Back to front over all slices of voxels. On each slice the kernel first moves all rays to it
 * (RayStep) and then does its work on the voxels of the slice (VoxelStep), which may depend on the
 * rays of the whole slice; in the end it moves all rays out of the volume (LeaveStep). After
 * each row of voxels there is a call of done(voxels, kernel, row).
 */
template <class Kernel, class Done>
void SweepBackwardByPhases(HostDevice&, FrustumRays<HostDevice>& rays, const Occupancy& occupancy,
  const Kernel& kernel, const Done& done)
{
  const FaceFrustum& frustum = rays.Plan();
  const RayStates states = rays.States();
  ParallelFor(frustum.RayCount(), 8192, StartBehind{ states });
  FieldWindows windows(rays, &occupancy);
  const auto rowKernel = kernel.With(windows);
  const RaysBeside beside{ states.transmittance, states.density, states.*Kernel::seenBehind };
  const RowsHere rowsOfRays = rays.RaysHere();
  const auto forRays = [&](const auto& step)
  {
    ParallelFor(rowsOfRays.Length(), rowsPerTask,
      [&](Index row)
      {
        RowSampler sampler(frustum, states, rowsOfRays[row]);
        step(sampler);
      });
  };
  const std::vector<Range<int>> slabs = SlabsOf(frustum);
  for (std::size_t index = slabs.size(); index-- > 0;)
  {
    const Range<int>& slab = slabs[index];
    windows.Load(slab);
    for (int s = slab.end; s-- > std::max(slab.begin, frustum.firstNodeSlice);)
    {
      forRays([&](RowSampler& sampler) { rowKernel.RayStep(sampler, s); });
      ExchangeRays(rays, s, false, states, states.*Kernel::seenBehind);
      const RowsHere rows = rays.VoxelsHere(s);
      ParallelFor(rows.Length(), rowsPerTask,
        [&](Index v)
        {
          VoxelRow voxels(frustum, s, rows[v]);
          if (!voxels.Filled().Empty())
          {
            rowKernel.VoxelStep(voxels, beside);
            done(voxels, rowKernel, rows[v]);
          }
        });
      windows.Exchange(s);
    }
    if (index == 0)
    {
      forRays([&](RowSampler& sampler) { rowKernel.LeaveStep(sampler); });
    }
    windows.Store(slab);
  }
  ParallelFor(frustum.RayCount(), 8192, FinishBehind{ states });
}

/// The same of a kernel whose rays do not depend on what it does to the voxels.
template <class Kernel>
void SweepBackward(HostDevice& device, FrustumRays<HostDevice>& rays, const Occupancy& occupancy,
  const Kernel& kernel)
{
  SweepBackwardByPhases(device, rays, occupancy, kernel, [](const VoxelRow&, const auto&, int) {});
}

/// Front to back over all slices, the source's own included: on each, the kernel lets the rays tell
/// what they have met and carries them on (RayStep); then the voxels of the slice read them.
template <class Kernel>
void SweepFrontToBack(HostDevice&, FrustumRays<HostDevice>& rays, const Kernel& kernel)
{
  const FaceFrustum& frustum = rays.Plan();
  const RayStates states = rays.States();
  ParallelFor(frustum.RayCount(), 8192, StartInFront{ states });
  FieldWindows windows(rays, nullptr);
  const auto rowKernel = kernel.With(windows);
  const RaysBeside beside{ states.transmittance, states.density, states.*Kernel::seenBehind };
  const RowsHere rowsOfRays = rays.RaysHere();
  std::vector<Range<int>> dimmed(std::size_t(frustum.rows)); // columns that have met something
  for (const Range<int>& slab : SlabsOf(frustum))
  {
    windows.Load(slab);
    for (int s = slab.begin; s < slab.end; ++s)
    {
      ParallelFor(rowsOfRays.Length(), rowsPerTask,
        [&](Index index)
        {
          const int row = rowsOfRays[index];
          Range<int>& met = dimmed[std::size_t(row)];
          RowSampler sampler(frustum, states, row);
          rowKernel.RayStep(sampler, s, met);
          met = s < frustum.lastSlice ? Hull(met, frustum.ActiveRays(s, row)) : met;
        });
      if (frustum.SliceAt(s).node < 0)
      {
        continue;
      }
      ExchangeRays(rays, s, true, states, states.*Kernel::seenBehind);
      const RowsHere rows = rays.VoxelsHere(s);
      ParallelFor(rows.Length(), rowsPerTask,
        [&](Index v)
        {
          VoxelRow voxels(frustum, s, rows[v]);
          rowKernel.VoxelStep(voxels, beside);
        });
    }
    windows.Store(slab);
  }
}
}

#endif
