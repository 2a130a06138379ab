// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The tiles that have work in a front-to-back sweep (SweepLaunches.h), found from the field that
// dims the rays. So they fit every field, and the plan of the rays may be that of another one.

#ifndef limpid_sweep_DimmedTiles_h
#define limpid_sweep_DimmedTiles_h

#include "backend/DeviceArray.h"
#include "backend/HostDevice.h"
#include "scene/IndexBox.h"
#include "sweep/PhaseLists.h"
#include "sweep/SlabTiles.h"

#include <cstddef>
#include <limits>
#include <memory>

namespace limpid
{
/// The blocks of nodes in which a field has a value above 0.
struct FilledBlocks
{
  static constexpr int size = 2; ///< nodes along each axis

  Int3 counts;                 ///< number of blocks along each axis
  const unsigned char* filled; ///< [block]

  static Int3 CountsFor(const Int3& nodes) { return (nodes + (size - 1)) / size; }

  /// Whether a block with any node of a box is filled.
  LIMPID_HD LIMPID_INLINE bool Any(const IndexBox& nodes) const
  {
    return IndexBox{ nodes.first / size, nodes.last / size }.Any(
      this->counts, [this](Index block) { return this->filled[block] != 0; });
  }
};

/// Computes FilledBlocks of a block.
struct MadeFilledBlock
{
  Int3 nodes; ///< of the field
  const float* field;
  unsigned char* filled;

  LIMPID_HD void operator()(Index block, int i, int j, int k) const
  {
    const Int3 first = FilledBlocks::size * Int3(i, j, k);
    const IndexBox here{ first, glm::min(first + FilledBlocks::size, this->nodes) - 1 };
    const bool any = here.Any(this->nodes, [this](Index node) { return this->field[node] > 0; });
    this->filled[block] = any ? 1 : 0;
  }
};

/// FilledBlocks of a field on a device, and their memory.
template <class AnyDevice>
class FieldBlocks
{
public:
  /// `field`: one value per node, on the device.
  FieldBlocks(const std::shared_ptr<AnyDevice>& device, const Int3& nodes, const float* field)
    : Counts(FilledBlocks::CountsFor(nodes))
    , Filled(device, std::size_t(Index(Counts.x) * Counts.y * Counts.z), "the plan of a sweep")
  {
    device->ForNodes("plan", this->Counts, MadeFilledBlock{ nodes, field, this->Filled.Data() });
  }

  FilledBlocks Blocks() const { return { this->Counts, this->Filled.Data() }; }

private:
  Int3 Counts;
  DeviceArray<AnyDevice, unsigned char> Filled;
};

/// The processor's sweep does not need them.
template <>
class FieldBlocks<HostDevice>
{
public:
  FieldBlocks(const std::shared_ptr<HostDevice>&, const Int3&, const float*) {}
};

/// Where tiles of rays may meet anything.
struct TilesMet
{
  static constexpr int never = std::numeric_limits<int>::max();

  const int* layers;      ///< [slab][tile]: the first layer in the slab where it may, or never
  const int* firstLayers; ///< [tile]: the first of all layers, or never
  int tiles;

  LIMPID_HD LIMPID_INLINE int FirstIn(int slab, int tile) const
  {
    return this->layers[Index(slab) * this->tiles + tile];
  }
};

/// Computes TilesMet::layers of a tile in a slab.
struct MadeTileMeets
{
  SlabLayout<SlabsFromFront> layout;
  FilledBlocks blocks;
  int* layers; ///< see TilesMet

  LIMPID_HD void operator()(int tile, int slab) const
  {
    const Range<int> layersOfSlab =
      Intersection(this->layout.SlabOf(slab), { 0, this->layout.frustum.lastSlice });
    int layer = layersOfSlab.begin;
    while (layer < layersOfSlab.end && !this->Meets(layer, tile))
    {
      ++layer;
    }
    this->layers[Index(slab) * this->layout.rays.Count() + tile] =
      layer < layersOfSlab.end ? layer : TilesMet::never;
  }

private:
  LIMPID_HD LIMPID_INLINE bool Meets(int layer, int tile) const
  {
    const Range<int> columns = this->layout.rays.ColumnsOf(tile);
    const Range<int> rows = this->layout.rays.RowsOf(tile);
    return AnyRayIsActive(this->layout.frustum, { layer, layer + 1 }, columns, rows) &&
      this->blocks.Any(this->NodesRead(layer, columns, rows));
  }

  /// Returns a box that contains all nodes which some rays read in a layer.
  LIMPID_HD LIMPID_INLINE IndexBox NodesRead(
    int layer, const Range<int>& columns, const Range<int>& rows) const
  {
    const FaceFrustum& plan = this->layout.frustum;
    const Slice& slice = plan.SliceAt(layer);
    const Range<double> depths{ slice.RelativeDepth(), plan.SliceAt(layer + 1).RelativeDepth() };
    const int front = slice.nodes[0];
    const int back = slice.nodes[1];
    IndexBox box{};
    this->Set(
      box, plan.axisU, NodesAlong(plan.Row(plan.columnLines), columns, depths, plan.nodesU));
    this->Set(box, plan.axisV, NodesAlong(plan.Row(plan.rowLines), rows, depths, plan.nodesV));
    this->Set(box, plan.axisW, Hull({ front, front + 1 }, Range<int>{ back, back + 1 }));
    return box;
  }

  LIMPID_HD static LIMPID_INLINE void Set(IndexBox& box, int axis, const Range<int>& nodes)
  {
    box.first[axis] = nodes.begin;
    box.last[axis] = nodes.end - 1;
  }

  /// Returns the nodes along one axis between which rays lie at some depths. Rays do not cross.
  LIMPID_HD static LIMPID_INLINE Range<int> NodesAlong(
    const RayLine* lines, const Range<int>& rays, const Range<double>& depths, int nodes)
  {
    constexpr double rounding = 1e-6; // the plan may round a position otherwise
    const double begins[] = { lines[rays.begin].At(depths.begin),
      lines[rays.begin].At(depths.end) };
    const double ends[] = { lines[rays.end - 1].At(depths.begin),
      lines[rays.end - 1].At(depths.end) };
    const double least = begins[0] < begins[1] ? begins[0] : begins[1];
    const double most = ends[0] > ends[1] ? ends[0] : ends[1];
    return { NodesAt(least - rounding, nodes).first, NodesAt(most + rounding, nodes).first + 2 };
  }
};

/// Computes TilesMet::firstLayers of a tile.
struct MadeFirstLayer
{
  TilesMet met;
  int slabs;
  int* firstLayers;

  LIMPID_HD void operator()(Index tile) const
  {
    int first = TilesMet::never;
    for (int slab = 0; slab < this->slabs && first == TilesMet::never; ++slab)
    {
      first = this->met.FirstIn(slab, static_cast<int>(tile));
    }
    this->firstLayers[tile] = first;
  }
};

/// Tells which tiles have work in a phase of a front-to-back sweep: rays that meet anything in the
/// slab, or whose image differs from that of two slabs before, and voxels that read rays which have
/// met anything.
struct SlabTileIsDimmed
{
  SlabLayout<SlabsFromFront> layout;
  TilesMet met;

  LIMPID_HD LIMPID_INLINE bool operator()(int number, int phase) const
  {
    const SlabTile tile = this->layout.TileAt(phase, number);
    if (tile.columns.Empty() || tile.rows.Empty())
    {
      return false;
    }
    return tile.hasRays ? this->MovesRays(tile, number) : this->DimsVoxels(tile);
  }

private:
  LIMPID_HD LIMPID_INLINE bool MovesRays(const SlabTile& tile, int number) const
  {
    const int first = tile.place > 2 ? tile.place - 2 : 0;
    for (int slab = first; slab <= tile.place; ++slab)
    {
      if (this->met.FirstIn(slab, number) != TilesMet::never)
      {
        return true;
      }
    }
    // The density of a ray that has met anything changes from slice to slice.
    const FaceFrustum& plan = this->layout.frustum;
    const bool nearSides = plan.IsNearSides(tile.columns.begin, tile.rows.begin) ||
      plan.IsNearSides(tile.columns.end - 1, tile.rows.end - 1);
    return nearSides && this->met.firstLayers[number] < this->layout.SlabOf(tile.place).end;
  }

  LIMPID_HD LIMPID_INLINE bool DimsVoxels(const SlabTile& tile) const
  {
    const FaceFrustum& plan = this->layout.frustum;
    const RayTiles& rays = this->layout.rays;
    const Range<int> across = TilesRead(
      plan.Row(plan.voxelColumns, tile.place), tile.columns, plan.columns, RayTiles::size.columns);
    const Range<int> down =
      TilesRead(plan.Row(plan.voxelRows, tile.place), tile.rows, plan.rows, RayTiles::size.rows);
    for (int row = down.begin; row < down.end; ++row)
    {
      for (int column = across.begin; column < across.end; ++column)
      {
        // The density of a ray on a slice depends on the layer behind it, too.
        if (this->met.firstLayers[row * rays.Across() + column] <= tile.place)
        {
          return true;
        }
      }
    }
    return false;
  }

  /// Returns the tiles along one axis with the rays that voxels read: four for a cubic
  /// (VoxelSampler::FindTransmittance). `toRays`: the map from voxels to rays; `length`: of a tile.
  LIMPID_HD static LIMPID_INLINE Range<int> TilesRead(
    const LinearMap& toRays, const Range<int>& voxels, int rays, int length)
  {
    const Range<int> read{ toRays.index[voxels.begin] - 1, toRays.index[voxels.end - 1] + 3 };
    const Range<int> there = Intersection(read, { 0, rays });
    return { there.begin / length, (there.end + length - 1) / length };
  }
};

/// Lists the tiles that a front-to-back sweep by slabs of so many slices visits.
template <class AnyDevice>
PhaseLists<AnyDevice> ListSlabsFromFront(const std::shared_ptr<AnyDevice>& device,
  const FaceFrustum& frustum, int slices, const FilledBlocks& blocks)
{
  const char* label = "plan";
  const char* what = "the plan of a sweep";
  const SlabLayout<SlabsFromFront> layout(frustum, slices);
  const int tiles = layout.rays.Count();
  DeviceArray<AnyDevice, int> layers(device, std::size_t(layout.slabs) * std::size_t(tiles), what);
  DeviceArray<AnyDevice, int> firstLayers(device, std::size_t(tiles), what);
  const TilesMet met{ layers.Data(), firstLayers.Data(), tiles };
  device->ForEach(label, { tiles, layout.slabs }, MadeTileMeets{ layout, blocks, layers.Data() });
  device->ForIndices(label, tiles, MadeFirstLayer{ met, layout.slabs, firstLayers.Data() });
  return { device, layout.TileCount(), layout.PhaseCount(), SlabTileIsDimmed{ layout, met } };
}
}

#endif
