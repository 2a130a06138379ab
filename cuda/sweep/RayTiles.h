// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Tiles of rays for a sweep in which rays depend on the voxels behind (SweepTiles.h): the voxels
// that each tile computes on each slice, and the phases in which it has work.

#ifndef limpid_sweep_RayTiles_h
#define limpid_sweep_RayTiles_h

#include "backend/DeviceArray.h"
#include "backend/Extent.h"
#include "sweep/FaceFrustum.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

namespace limpid
{
/// The decomposition of all rays into tiles, which are numbered row by row.
struct RayTiles
{
  /// Rays of a tile; a block has one thread per ray.
  static constexpr Extent size{ 32, 8 };

  int columns = 0; ///< number of columns of all rays
  int rows = 0;

  LIMPID_HD LIMPID_INLINE int Across() const
  {
    return (this->columns + size.columns - 1) / size.columns;
  }

  LIMPID_HD LIMPID_INLINE int Down() const { return (this->rows + size.rows - 1) / size.rows; }
  LIMPID_HD LIMPID_INLINE int Count() const { return this->Across() * this->Down(); }

  LIMPID_HD LIMPID_INLINE Range<int> ColumnsOf(int number) const
  {
    return Part(number % this->Across(), size.columns, this->columns);
  }

  LIMPID_HD LIMPID_INLINE Range<int> RowsOf(int number) const
  {
    return Part(number / this->Across(), size.rows, this->rows);
  }

  LIMPID_HD static LIMPID_INLINE Range<int> Part(int number, int length, int all)
  {
    return Intersection(Range<int>{ number * length, (number + 1) * length }, { 0, all });
  }
};

/// The voxels that tiles compute on every slice: those that their rays read, and those between
/// them and the next tile that no ray reads.
struct VoxelsOfTiles
{
  RayTiles tiles;
  const Range<int>* ranges; ///< [slice][tile]: along u for tiles of a row, then along v

  LIMPID_HD LIMPID_INLINE const Range<int>& AlongU(int s, int number) const
  {
    return this->Slice(s)[number % this->tiles.Across()];
  }

  LIMPID_HD LIMPID_INLINE const Range<int>& AlongV(int s, int number) const
  {
    return this->Slice(s)[this->tiles.Across() + number / this->tiles.Across()];
  }

private:
  LIMPID_HD LIMPID_INLINE const Range<int>* Slice(int s) const
  {
    return this->ranges + Index(s) * (this->tiles.Across() + this->tiles.Down());
  }
};

/// Computes entry `number` of VoxelsOfTiles on slice `s`.
struct MadeVoxelsOfTile
{
  FaceFrustum frustum;
  RayTiles tiles;
  Range<int>* ranges;

  Extent ExtentOfRanges() const
  {
    return { this->tiles.Across() + this->tiles.Down(), this->frustum.SliceCount() };
  }

  LIMPID_HD void operator()(int number, int s) const
  {
    const FaceFrustum& plan = this->frustum;
    const Slice& slice = plan.SliceAt(s);
    const int row = number - this->tiles.Across();
    this->ranges[Index(s) * (this->tiles.Across() + this->tiles.Down()) + number] = row < 0
      ? this->VoxelsOf(s,
          { plan.planeColumns, true, plan.Row(plan.columnLines), plan.columns, plan.nodesU },
          RayTiles::Part(number, RayTiles::size.columns, plan.columns), slice.ownedColumns)
      : this->VoxelsOf(s,
          { plan.planeRows, false, plan.Row(plan.rowLines), plan.rows, plan.nodesV },
          RayTiles::Part(row, RayTiles::size.rows, plan.rows), slice.ownedRows);
  }

private:
  /// The rays along one axis.
  struct Axis
  {
    const MapTable& planes; ///< see FaceFrustum
    bool isColumns;         ///< or rows
    const RayLine* lines;
    int count;
    int nodes;
  };

  /// Returns the `owned` voxels of slice `s` along one axis that `rays` read in the layers in
  /// front of and behind it, and those up to what the next rays read.
  LIMPID_HD LIMPID_INLINE Range<int> VoxelsOf(
    int s, const Axis& axis, const Range<int>& rays, const Range<int>& owned) const
  {
    const FaceFrustum& plan = this->frustum;
    const int first = s > 0 ? 2 * (s - 1) : 0; // two planes in a layer
    const int end = s < plan.lastSlice ? 2 * (s + 1) : 2 * s;
    Range<int> read{ owned.end, owned.begin };
    const auto add = [&](int begin, int last, int next)
    {
      next = rays.end < axis.count ? next : owned.end;
      const int behind = last + 2 > next ? last + 2 : next;
      read = { begin < read.begin ? begin : read.begin, behind > read.end ? behind : read.end };
    };
    const int beside = rays.end < axis.count ? rays.end : rays.end - 1;
    for (int plane = first; plane < end; ++plane)
    {
      // All rays beside those that the plan describes read the border that the last of them reads.
      const Slice& slice = plan.SliceAt(plane / 2);
      const Range<int>& described = axis.isColumns ? slice.rayColumns : slice.rayRows;
      const int* nodes = plan.Row(axis.planes, plane).index;
      const auto nodeOf = [&](int ray)
      {
        const int before = ray < described.end ? ray : described.end - 1;
        return nodes[before > described.begin ? before - described.begin : 0];
      };
      add(nodeOf(rays.begin), nodeOf(rays.end - 1), nodeOf(beside));
    }
    // Layers may be sampled at other points (ResolvedRay), up to their ends.
    for (int slice = s; slice <= s + 1 && slice <= plan.lastSlice; ++slice)
    {
      const double depth = plan.SliceAt(slice).RelativeDepth();
      const auto nodeOf = [&](int ray)
      { return NodesAt(axis.lines[ray].At(depth), axis.nodes).first; };
      add(nodeOf(rays.begin), nodeOf(rays.end - 1), nodeOf(beside));
    }
    read.begin = rays.begin == 0 ? owned.begin : read.begin;
    const Range<int> found = Intersection(read, owned);
    return found.Empty() ? Range<int>{} : found;
  }
};

/// In phase `phase` of a back-to-front sweep the rays move to slice `lastSlice - phase`; in the
/// last phase they stay. Marks the tiles that have work in a phase: rays whose image differs from
/// that of two slices before, or active voxels on the slice behind.
struct MarkedTile
{
  FaceFrustum frustum;
  VoxelsOfTiles voxels;
  unsigned char* marks; ///< [phase][tile]

  static int PhasesOf(const FaceFrustum& frustum)
  {
    return frustum.SliceCount() - frustum.firstNodeSlice + 1;
  }

  LIMPID_HD void operator()(int number, int phase) const
  {
    const int s = this->frustum.lastSlice - phase;
    const bool works = this->MovesRays(s, number) || this->FindsVoxels(s + 1, number);
    this->marks[Index(phase) * this->voxels.tiles.Count() + number] = works ? 1 : 0;
  }

private:
  /// A ray changes if it is active in the layer behind the slice or in the one behind that. Its
  /// image must be renewed as long as the image of two slices before differs.
  LIMPID_HD LIMPID_INLINE bool MovesRays(int slice, int number) const
  {
    if (slice < this->frustum.firstNodeSlice)
    {
      return false;
    }
    const Range<int> columns = this->voxels.tiles.ColumnsOf(number);
    const Range<int> rows = this->voxels.tiles.RowsOf(number);
    for (int s = slice; s <= slice + 2 && s <= this->frustum.lastSlice; ++s)
    {
      for (int row = rows.begin; row < rows.end; ++row)
      {
        if (!Intersection(this->frustum.ActiveRays(s, row), columns).Empty())
        {
          return true;
        }
      }
    }
    return false;
  }

  LIMPID_HD LIMPID_INLINE bool FindsVoxels(int s, int number) const
  {
    if (s > this->frustum.lastSlice)
    {
      return false;
    }
    const Range<int> columns = this->voxels.AlongU(s, number);
    const Range<int> rows = this->voxels.AlongV(s, number);
    for (int v = rows.begin; v < rows.end; ++v)
    {
      if (!Intersection(this->frustum.ActiveVoxels(s, v), columns).Empty())
      {
        return true;
      }
    }
    return false;
  }
};

/// Lists the marked tiles of a phase.
struct ListedTiles
{
  const unsigned char* marks; ///< [phase][tile]
  int tiles;
  int* numbers; ///< [phase][]
  int* counts;  ///< [phase]

  LIMPID_HD void operator()(Index phase) const
  {
    const unsigned char* marksHere = this->marks + phase * this->tiles;
    int* numbersHere = this->numbers + phase * this->tiles;
    int count = 0;
    for (int number = 0; number < this->tiles; ++number)
    {
      if (marksHere[number] != 0)
      {
        numbersHere[count] = number;
        ++count;
      }
    }
    this->counts[phase] = count;
  }
};

/// A phase in which at least one tile has work.
struct alignas(16) PhaseOfTiles
{
  int slice;   ///< the slice that rays move to
  int count;   ///< number of tiles
  Index first; ///< position of the first tile in TileLists::numbers
};

/// The data of a TilePlan that a sweep reads.
struct TileLists
{
  VoxelsOfTiles voxels;
  const int* numbers;
  const PhaseOfTiles* phases;
  int phaseCount;
  int mostTiles; ///< largest number of tiles in a phase
};

/// The tiles that a back-to-front sweep visits in each phase, and the voxels that they compute.
template <class AnyDevice>
class TilePlan
{
public:
  TilePlan(const std::shared_ptr<AnyDevice>& device, const FaceFrustum& frustum)
    : Device(device)
  {
    this->FindVoxels(frustum);
    this->ListPhases(frustum, this->ListTiles(frustum));
  }

  const TileLists& Lists() const { return this->Addresses; }

private:
  static constexpr const char* what = "the plan of a sweep";

  template <class Value>
  DeviceArray<AnyDevice, Value> Make(Index count) const
  {
    return { this->Device, static_cast<std::size_t>(count), what };
  }

  void FindVoxels(const FaceFrustum& frustum)
  {
    const RayTiles tiles{ frustum.columns, frustum.rows };
    this->Voxels =
      this->Make<Range<int>>(Index(frustum.SliceCount()) * (tiles.Across() + tiles.Down()));
    const MadeVoxelsOfTile made{ frustum, tiles, this->Voxels.Data() };
    this->Device->ForEach("plan", made.ExtentOfRanges(), made);
    this->Addresses.voxels = { tiles, this->Voxels.Data() };
  }

  /// Returns the number of tiles in each phase.
  std::vector<int> ListTiles(const FaceFrustum& frustum)
  {
    const int tiles = this->Addresses.voxels.tiles.Count();
    const int phases = MarkedTile::PhasesOf(frustum);
    DeviceArray<AnyDevice, unsigned char> marks = this->Make<unsigned char>(Index(phases) * tiles);
    DeviceArray<AnyDevice, int> counts = this->Make<int>(phases);
    this->Numbers = this->Make<int>(Index(phases) * tiles);
    this->Device->ForEach(
      "plan", { tiles, phases }, MarkedTile{ frustum, this->Addresses.voxels, marks.Data() });
    this->Device->ForIndices(
      "plan", phases, ListedTiles{ marks.Data(), tiles, this->Numbers.Data(), counts.Data() });
    std::vector<int> found(static_cast<std::size_t>(phases));
    counts.Download(found.data());
    this->Addresses.numbers = this->Numbers.Data();
    return found;
  }

  /// `counts`: number of tiles in each phase.
  void ListPhases(const FaceFrustum& frustum, const std::vector<int>& counts)
  {
    std::vector<PhaseOfTiles> phases;
    for (std::size_t phase = 0; phase < counts.size(); ++phase)
    {
      if (counts[phase] > 0)
      {
        phases.push_back({ frustum.lastSlice - static_cast<int>(phase), counts[phase],
          Index(phase) * this->Addresses.voxels.tiles.Count() });
      }
    }
    this->Phases = { this->Device, phases, what };
    this->Addresses.phases = this->Phases.Data();
    this->Addresses.phaseCount = static_cast<int>(phases.size());
    this->Addresses.mostTiles = *std::max_element(counts.begin(), counts.end());
  }

  std::shared_ptr<AnyDevice> Device;
  DeviceArray<AnyDevice, Range<int>> Voxels;
  DeviceArray<AnyDevice, int> Numbers;
  DeviceArray<AnyDevice, PhaseOfTiles> Phases;
  TileLists Addresses{};
};
}

#endif
