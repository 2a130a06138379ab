// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Sweeps on the processor, whose threads share the rows of a slice. A kernel defines what happens
// to rays and voxels; SweepLaunches.h runs the same kernels on a device.

#ifndef limpid_sweep_SweepRows_h
#define limpid_sweep_SweepRows_h

#include "backend/Backend.h"
#include "sweep/DimmedTiles.h"
#include "sweep/FrustumRays.h"
#include "sweep/VoxelRow.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace limpid
{
/// Number of rows of rays or voxels per task.
constexpr Index rowsPerTask = 8;

/// Calls what(row) for a range of rows, in parallel.
template <class What>
void ForRows(const Range<int>& rows, Index perTask, const What& what)
{
  ParallelFor(rows.Length(), perTask,
    [&rows, &what](Index index) { what(rows.begin + static_cast<int>(index)); });
}

/// Calls act(ray) with the states of each owned or ghost ray.
template <class Act>
void ForRaysReached(FrustumRays<HostDevice>& rays, const Act& act)
{
  constexpr Index raysPerTask = 8192;
  const Range<int> rows = rays.RaysReached();
  const Index first = rays.Plan().RaysBefore(rows.begin);
  const RayStates states = rays.States().From(first);
  ParallelFor(rays.Plan().RaysBefore(rows.end) - first, raysPerTask,
    [&](Index ray) { act(states.From(ray)); });
}

/// Initialises what rays carry and what voxels read. `Start`: StartBehind or StartInFront.
template <class Start, class Kernel>
void StartRays(FrustumRays<HostDevice>& rays, const Kernel& kernel)
{
  ForRaysReached(rays,
    [&](const RayStates& ray)
    {
      const Start start{ ray };
      kernel.ForCarried(start);
      ForRead<Kernel::readByVoxels>(start);
    });
}

/// Host access to the fields of a kernel, slab by slab.
class FieldWindows
{
public:
  /// `occupancy`: see FieldSlabs::Load.
  FieldWindows(const FrustumTables<HostDevice>& rays, const Occupancy* occupancy)
    : Fields(rays.Fields())
    , Bands(rays.Bands())
    , Occupied(occupancy)
  {
  }

  /// Adds a field and returns its window; null for a null field.
  SliceWindow* operator()(const float* field, const FieldUse& use)
  {
    if (!field)
    {
      return nullptr;
    }
    this->All.push_back(this->Fields.Open(const_cast<float*>(field), use));
    if (use.writes && use.behind > 0)
    {
      this->Changing.push_back(&this->All.back());
    }
    return &this->All.back();
  }

  const std::vector<Range<int>>& Slabs() const { return this->Fields.Slabs(); }
  void Load(const Range<int>& slab) { this->Fields.Load(slab, this->Occupied, this->All); }
  void Store(const Range<int>& slab) { this->Fields.Store(slab, this->Occupied, this->All); }

  /// Sends the changed voxels of a slice to all whose rays read them.
  void Exchange(int s) const { this->Bands.ExchangeVoxels(s, this->Changing); }

private:
  FieldSlabs& Fields;
  const BandDecomposition& Bands;
  const Occupancy* Occupied;
  FieldSlabs::Windows All;
  std::vector<SliceWindow*> Changing; ///< those whose new values the sweep reads
};

/// Returns the images of the rays that voxels read.
template <class Kernel>
std::vector<float*> ImagesRead(const RayStates& states)
{
  std::vector<float*> images;
  ForRead<Kernel::readByVoxels>([&](RayChannel channel) { images.push_back(states[channel]); });
  return images;
}

/// Returns the rays' values that voxels read, see ForRead.
template <class Kernel>
RaysBeside RaysFor(const RayStates& states)
{
  return { states[RayChannel::Transmittance], states[RayChannel::Density],
    states[Kernel::readByVoxels] };
}

/// Returns the values that rays carry.
template <class Kernel>
std::vector<RayValues> CarriedBy(const Kernel& kernel, const RayStates& states)
{
  std::vector<RayValues> carried;
  kernel.ForCarried([&](auto value) { carried.push_back(states[value]); });
  return carried;
}

/// Returns the owned rows of rays in a stretch.
inline Range<int> RowsNear(const FrustumRays<HostDevice>& rays, const Range<int>& stretch)
{
  return Intersection(rays.RaysHere(stretch.begin), rays.Plan().RowsNear(stretch));
}

/// Returns the layers in a stretch that a row of rays may cross inside the box, by the slices in
/// front of them.
inline Range<int> LayersIn(const FaceFrustum& frustum, const Range<int>& stretch, int row)
{
  return Intersection(Intersection(stretch, { 0, frustum.lastSlice }), frustum.LayersOf(row));
}

/// Front to back: moves every row of rays through all layers. `Rays`: the sampler; `occupancy`:
/// see FieldSlabs::Load.
template <class Rays = RowSampler, class Kernel>
void SweepForward(
  HostDevice&, FrustumRays<HostDevice>& rays, const Occupancy& occupancy, const Kernel& kernel)
{
  const FaceFrustum& frustum = rays.Plan();
  const RayStates states = rays.States();
  const std::vector<RayValues> carried = CarriedBy(kernel, states);
  ForRaysReached(rays, [&](const RayStates& ray) { kernel.ForCarried(StartInFront{ ray }); });
  FieldWindows windows(rays, &occupancy);
  const auto rowKernel = kernel.With(windows);
  for (const Range<int>& slab : windows.Slabs())
  {
    windows.Load(slab);
    for (const Range<int>& stretch : rays.StretchesOf(slab))
    {
      rays.Bands().PassRays(stretch.begin - 1, stretch.begin, carried);
      ForRows(RowsNear(rays, stretch), rowsPerTask / 2,
        [&](int row)
        {
          Rays sampler(frustum, states, row);
          const Range<int> layers = LayersIn(frustum, stretch, row);
          for (int s = layers.begin; s < layers.end; ++s)
          {
            rowKernel.RayStep(sampler, s);
          }
        });
    }
  }
}

/// Back to front without voxels: moves every row of rays through all layers. Keeps the optical
/// depths.
template <class Kernel>
void SweepRaysBackward(
  HostDevice&, FrustumRays<HostDevice>& rays, const Occupancy& occupancy, const Kernel& kernel)
{
  const FaceFrustum& frustum = rays.Plan();
  const RayStates states = rays.States();
  const std::vector<RayValues> carried = CarriedBy(kernel, states);
  ForRaysReached(rays, [&](const RayStates& ray) { kernel.ForCarried(StartBehind{ ray }); });
  FieldWindows windows(rays, &occupancy);
  const auto rowKernel = kernel.With(windows);
  const std::vector<Range<int>>& slabs = windows.Slabs();
  for (std::size_t slab = slabs.size(); slab-- > 0;)
  {
    windows.Load(slabs[slab]);
    const std::vector<Range<int>> stretches = rays.StretchesOf(slabs[slab]);
    for (std::size_t index = stretches.size(); index-- > 0;)
    {
      const Range<int>& stretch = stretches[index];
      rays.Bands().PassRays(std::min(stretch.end, frustum.lastSlice), stretch.end - 1, carried);
      ForRows(RowsNear(rays, stretch), rowsPerTask / 2,
        [&](int row)
        {
          RowSampler sampler(frustum, states, row);
          const Range<int> layers = LayersIn(frustum, stretch, row);
          for (int s = layers.end; s-- > layers.begin;)
          {
            rowKernel.RayStep(sampler, s);
          }
        });
    }
  }
  ForRaysReached(rays, [&](const RayStates& ray) { kernel.ForCarried(FinishBehind{ ray }); });
  rays.Bands().PassRays(0, frustum.lastSlice, carried);
}

/**
 * Back to front over all slices of voxels. On each slice the kernel first moves all rays to it
 * (RayStep). It then works on the voxels of the slice (VoxelStep), which may depend on the rays of
 * the whole slice. Finally it moves all rays out of the volume (LeaveStep). After each row of
 * voxels, done(voxels, kernel, row) is called.
 */
template <class Kernel, class Done>
void SweepBackwardByPhases(HostDevice&, FrustumRays<HostDevice>& rays, const Occupancy& occupancy,
  const Kernel& kernel, const Done& done)
{
  const FaceFrustum& frustum = rays.Plan();
  const RayStates states = rays.States();
  StartRays<StartBehind>(rays, kernel);
  FieldWindows windows(rays, &occupancy);
  const auto rowKernel = kernel.With(windows);
  const RaysBeside beside = RaysFor<Kernel>(states);
  const std::vector<float*> images = ImagesRead<Kernel>(states);
  const std::vector<RayValues> carried = CarriedBy(kernel, states);
  const auto forRays = [&](int s, const auto& step)
  {
    const Range<int> layers{ std::max(s - 1, 0), std::min(s + 2, frustum.SliceCount()) };
    ForRows(Intersection(rays.RaysHere(s), frustum.RowsNear(layers)), rowsPerTask,
      [&](int row)
      {
        if (frustum.HasActive(layers, row))
        {
          RowSampler sampler(frustum, states, row);
          step(sampler);
        }
      });
  };
  const std::vector<Range<int>>& slabs = windows.Slabs();
  for (std::size_t index = slabs.size(); index-- > 0;)
  {
    const Range<int>& slab = slabs[index];
    windows.Load(slab);
    for (int s = slab.end; s-- > std::max(slab.begin, frustum.firstNodeSlice);)
    {
      rays.Bands().PassRays(std::min(s + 1, frustum.lastSlice), s, carried);
      forRays(s, [&](RowSampler& sampler) { rowKernel.RayStep(sampler, s); });
      rays.Bands().ExchangeRays(s, false, images);
      ForRows(rays.VoxelsHere(s), rowsPerTask,
        [&](int v)
        {
          VoxelRow voxels(frustum, s, v);
          if (!voxels.Filled().Empty())
          {
            rowKernel.VoxelStep(voxels, beside);
            done(voxels, rowKernel, v);
          }
        });
      windows.Exchange(s);
    }
    if (index == 0)
    {
      forRays(0, [&](RowSampler& sampler) { rowKernel.LeaveStep(sampler); });
    }
    windows.Store(slab);
  }
  ForRaysReached(rays, [&](const RayStates& ray) { kernel.ForCarried(FinishBehind{ ray }); });
  rays.Bands().PassRays(0, frustum.lastSlice, carried);
}

/// Back to front, for a kernel whose rays do not depend on the changes of voxels.
template <class Kernel>
void SweepBackward(HostDevice& device, FrustumRays<HostDevice>& rays, const Occupancy& occupancy,
  const Kernel& kernel)
{
  SweepBackwardByPhases(device, rays, occupancy, kernel, [](const VoxelRow&, const auto&, int) {});
}

/// Front to back over all slices, including the source's own. On each slice the kernel sets the
/// values that voxels read and moves the rays on (RayStep); then it visits the voxels.
template <class Kernel>
void SweepFrontToBack(const std::shared_ptr<HostDevice>&, FrustumRays<HostDevice>& rays,
  const FieldBlocks<HostDevice>&, const Kernel& kernel)
{
  const FaceFrustum& frustum = rays.Plan();
  const RayStates states = rays.States();
  StartRays<StartInFront>(rays, kernel);
  FieldWindows windows(rays, nullptr);
  const auto rowKernel = kernel.With(windows);
  const RaysBeside beside = RaysFor<Kernel>(states);
  const std::vector<float*> images = ImagesRead<Kernel>(states);
  const std::vector<RayValues> carried = CarriedBy(kernel, states);
  std::vector<Range<int>> dimmed(std::size_t(frustum.rows)); // [row]: columns of rays that have
                                                             // met anything
  for (const Range<int>& slab : windows.Slabs())
  {
    windows.Load(slab);
    for (int s = slab.begin; s < slab.end; ++s)
    {
      rays.Bands().PassRays(s - 1, s, carried);
      const Range<int>& near = frustum.SliceAt(s).rayRows;
      ForRows(Intersection(rays.RaysHere(s), near), rowsPerTask,
        [&](int row)
        {
          RowSampler sampler(frustum, states, row);
          rowKernel.RayStep(sampler, s, dimmed[std::size_t(row)]);
        });
      for (int row = near.begin; s < frustum.lastSlice && row < near.end; ++row)
      {
        Range<int>& met = dimmed[std::size_t(row)];
        met = Hull(met, frustum.ActiveRays(s, row));
      }
      if (frustum.SliceAt(s).node < 0)
      {
        continue;
      }
      rays.Bands().ExchangeRays(s, true, images);
      ForRows(rays.VoxelsHere(s), rowsPerTask,
        [&](int v)
        {
          VoxelRow voxels(frustum, s, v);
          rowKernel.VoxelStep(voxels, beside);
        });
    }
    windows.Store(slab);
  }
}
}

#endif
