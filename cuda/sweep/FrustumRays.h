// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The rays of a frustum on a device: the plan, and the values that the rays carry.

#ifndef limpid_sweep_FrustumRays_h
#define limpid_sweep_FrustumRays_h

#include "backend/DeviceArray.h"
#include "backend/HostDevice.h"
#include "math/Require.h"
#include "sweep/ActiveLayers.h"
#include "sweep/BandDecomposition.h"
#include "sweep/FieldSlabs.h"
#include "sweep/FillPlan.h"
#include "sweep/HatOfVoxel.h"
#include "sweep/PlanOnDevice.h"
#include "sweep/RayChannels.h"
#include "sweep/RayTiles.h"
#include "sweep/SlabTiles.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace limpid
{
/// Values of all rays of a frustum in device memory; initially unset.
template <class AnyDevice>
class RayImages
{
public:
  RayImages(std::shared_ptr<AnyDevice> device, Index rays)
    : Device(std::move(device))
    , Rays(rays)
    , ToSlice(this->Device, std::size_t(rays), "optical depths")
  {
  }

  RayStates States()
  {
    if (this->Channels.Empty())
    {
      this->Collected = { this->Device, std::size_t(this->Rays), "optical depths" };
      this->Channels = { this->Device, std::size_t(Index(RayChannel::Count) * this->Rays), "rays" };
    }
    return { this->ToSlice.Data(), this->Collected.Data(), this->Channels.Data(), this->Rays };
  }

  /// Returns states of which RayDepth::ToSlice alone may be used; the others are not allocated.
  RayStates DepthsToSlice()
  {
    double* depths = this->ToSlice.Data();
    return { depths, depths, reinterpret_cast<float*>(depths), 0 }; // From needs valid addresses
  }

  /// Replaces RayDepth::ToSlice by RayDepth::Collected.
  void KeepCollected() { std::swap(this->ToSlice, this->Collected); }

private:
  std::shared_ptr<AnyDevice> Device;
  Index Rays;
  DeviceArray<AnyDevice, double> ToSlice;
  DeviceArray<AnyDevice, double> Collected; ///< allocated on first use, like Channels
  DeviceArray<AnyDevice, float> Channels;   ///< [channel][ray]
};

/// The plan of a frustum in device memory.
template <class AnyDevice>
class FrustumTables
{
public:
  FrustumTables(const std::shared_ptr<AnyDevice>& device, const PlannedFrustum& outline,
    const Occupancy& occupancy)
    : Device(device)
    , Addresses(outline)
  {
    LIMPID_REQUIRE(!outline.banded,
      "From this position, a GPU cannot sweep an image that is so much longer than wide (it would "
      "need memory for "
        << double(outline.columns) * outline.rows
        << " rays, of which few meet the image). Use the processor, or look along the image or "
           "straight at one of its sides.");
    this->Tables = DeviceArray<AnyDevice, unsigned char>::Zeros(device, outline.bytes, what);
    device->Upload(this->Tables.Data(), outline.memory.get(), outline.outlineBytes);
    this->Addresses.tables = this->Tables.Data();
    FillPlanOnDevice(device, outline, this->Tables.Data(), occupancy);
  }

  const FaceFrustum& Plan() const { return this->Addresses; }

  /// Must not be called: Settings and Renderer refuse distributed fields for GPUs.
  void SweepFieldsOf(const FieldLayout&, const Occupancy*, int)
  {
    LIMPID_EXPECT(!"a GPU sweeps fields in place");
  }

  /// Returns the weights for means over voxels, for each slice (MadeHat); computed on first use.
  const HatOfVoxel* Hats()
  {
    if (this->Means.Empty())
    {
      const Index count = MadeHat::CountOf(this->Addresses);
      DeviceArray<AnyDevice, HatOfVoxel> hats(this->Device, std::size_t(count), what);
      this->Device->ForIndices("plan", count, MadeHat{ this->Addresses, hats.Data() });
      this->Means = std::move(hats); // only after they have been computed
    }
    return this->Means.Data();
  }

  /// Returns the tiles of rays for a back-to-front sweep; computed on first use.
  const TilePlan<AnyDevice>& Tiles()
  {
    if (!this->Tiling)
    {
      this->Tiling = std::make_unique<TilePlan<AnyDevice>>(this->Device, this->Addresses);
    }
    return *this->Tiling;
  }

  /// Returns the tiles of a back-to-front sweep by slabs of so many slices; computed on first use.
  const PhaseLists<AnyDevice>& SlabsFromBack(int slices)
  {
    if (!this->FromBack)
    {
      this->FromBack.emplace(ListSlabsFromBack(this->Device, this->Addresses, slices));
    }
    return *this->FromBack;
  }

  /// Returns the layers in which rays are active; computed on first use.
  const LayerMasks& Layers()
  {
    if (!this->Layering)
    {
      this->Layering = std::make_unique<ActiveLayers<AnyDevice>>(this->Device, this->Addresses);
    }
    return this->Layering->Masks();
  }

  /// Allocates `count` values for images of rays during one sweep.
  DeviceArray<AnyDevice, float> MakeImages(Index count) const
  {
    return { this->Device, static_cast<std::size_t>(count), "images of rays" };
  }

private:
  static constexpr const char* what = "the plan of a sweep";

  std::shared_ptr<AnyDevice> Device;
  DeviceArray<AnyDevice, unsigned char> Tables;
  DeviceArray<AnyDevice, HatOfVoxel> Means;
  std::unique_ptr<TilePlan<AnyDevice>> Tiling;
  std::optional<PhaseLists<AnyDevice>> FromBack;
  std::unique_ptr<ActiveLayers<AnyDevice>> Layering;
  FaceFrustum Addresses;
};

/// The plan of a frustum on the host, with the decomposition of its rays and the access to fields.
template <>
class FrustumTables<HostDevice>
{
public:
  FrustumTables(
    const std::shared_ptr<HostDevice>&, PlannedFrustum&& outline, const Occupancy& occupancy)
    : Planned(std::move(outline))
  {
    FillPlan(this->Planned, occupancy);
    this->ShareAmong(*ThisProcess());
  }

  /// Divides the rays among ranks, which must outlive this object. Sweeps read and write fields
  /// that hold the nodes which these rays read.
  void ShareAmong(const Communicator& ranks)
  {
    this->Shared = std::make_unique<BandDecomposition>(this->Planned, ranks);
    this->Slabs = FieldSlabs::Local(this->Planned, *this->Shared);
  }

  const FaceFrustum& Plan() const { return this->Planned; }
  const BandDecomposition& Bands() const { return *this->Shared; }
  FieldSlabs& Fields() const { return *this->Slabs; }

  /// Divides the rays among the ranks of a distribution. Sweeps read and write fields that are
  /// distributed so, see FieldSlabs::Redistributed.
  void SweepFieldsOf(const FieldLayout& home, const Occupancy* filled, int margin = 0)
  {
    if (&this->Shared->Ranks() != home.ranks)
    {
      this->ShareAmong(*home.ranks);
    }
    this->Slabs = FieldSlabs::Redistributed(this->Planned, *this->Shared, home, filled, margin);
  }

  /// Sweeps read fields that are made slab by slab. `fields` must outlive this object.
  void SweepMadeFields(MadeFields& fields)
  {
    this->Slabs = FieldSlabs::Made(this->Planned, *this->Shared, fields);
  }

  /// Splits a range of slices where the decomposition of the rays changes.
  std::vector<Range<int>> StretchesOf(const Range<int>& slices) const
  {
    std::vector<Range<int>> stretches;
    for (int begin = slices.begin; begin < slices.end; begin = stretches.back().end)
    {
      stretches.push_back({ begin, std::min(this->Shared->EndOfStretch(begin), slices.end) });
    }
    return stretches;
  }

  /// Owned rows of rays on slice `s`.
  Range<int> RaysHere(int s) const { return this->Shared->RaysHere(s); }

  /// Owned rows of rays between sweeps.
  Range<int> RaysAtRest() const { return this->RaysHere(this->Planned.lastSlice); }

  /// Owned and ghost rows of rays on any slice.
  const Range<int>& RaysReached() const { return this->Shared->RaysReached(); }

  /// Owned rows of voxels of slice `s`.
  Range<int> VoxelsHere(int s) const { return this->Shared->VoxelsHere(s); }

private:
  PlannedFrustum Planned;
  std::unique_ptr<BandDecomposition> Shared;
  std::unique_ptr<FieldSlabs> Slabs;
};

/// The plan of one frustum and the values of its rays on a device.
template <class AnyDevice>
class FrustumRays : public FrustumTables<AnyDevice>
{
public:
  /// `outline`: made by OutlineSweep.
  FrustumRays(
    const std::shared_ptr<AnyDevice>& device, PlannedFrustum&& outline, const Occupancy& occupancy)
    : FrustumTables<AnyDevice>(device, std::move(outline), occupancy)
    , Values(device, this->Plan().RayCount())
  {
  }

  RayStates States() { return this->Values.States(); }
  RayStates DepthsToSlice() { return this->Values.DepthsToSlice(); }

  /// Replaces the optical depths by those that a back-to-front sweep has collected.
  void KeepCollected() { this->Values.KeepCollected(); }

private:
  RayImages<AnyDevice> Values;
};

/// Plans a sweep on a device.
template <class AnyDevice>
std::vector<FrustumRays<AnyDevice>> PlanRays(const std::shared_ptr<AnyDevice>& device,
  const Grid& grid, const Occupancy& occupancy, const RaySource& source,
  const PlanSettings& settings)
{
  std::vector<FrustumRays<AnyDevice>> frusta;
  for (PlannedFrustum& outline : OutlineSweep(grid, source, settings))
  {
    frusta.emplace_back(device, std::move(outline), occupancy);
  }
  return frusta;
}
}

#endif
