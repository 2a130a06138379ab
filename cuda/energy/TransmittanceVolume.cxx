// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "energy/TransmittanceVolume.h"

#include "energy/EnteredRays.h"
#include "sweep/Sweep.h"

#include <algorithm>

namespace limpid
{
namespace
{
/// Sources of an interpolation to `targets` and one more on either side, as cubics need them.
Interval Reads(const LinearMap& map, const Interval& targets, int sources)
{
  if (targets.Empty())
  {
    return {};
  }
  return Intersection(
    { map.index[std::size_t(targets.begin)] - 1, map.index[std::size_t(targets.end) - 1] + 3 },
    { 0, sources });
}

/// Targets in `targets` whose four sources for a cubic lie in `sources`.
Interval CubicTargets(const LinearMap& map, const Interval& targets, const Interval& sources)
{
  const auto first = map.index.begin() + targets.begin;
  const auto last = map.index.begin() + targets.end;
  const auto begin = std::lower_bound(first, last, sources.begin + 1);
  const auto end = std::lower_bound(begin, last, sources.end - 2);
  return { static_cast<int>(begin - map.index.begin()), static_cast<int>(end - map.index.begin()) };
}

/// The forward sweep of one pyramid that writes the transmittance of the voxels as it goes.
class TransmittanceVisitor
{
public:
  TransmittanceVisitor(const Pyramid& pyramid, const Grid& grid, const float* extinction,
    float* transmittance, RayImages& images)
    : Source(pyramid)
    , Images(images)
    , Extinction(pyramid, grid, extinction, images.slabs)
    , Target(pyramid, grid, transmittance, images.slabs)
    , Dimmed(std::size_t(pyramid.rows))
  {
    FillImage(images.opticalDepth, 0.0);
    FillImage(images.transmittance, 1.0f);
    FillImage(images.density, 0.0f);
  }

  void Load(const Slab& slab)
  {
    this->Extinction.Load(slab, 1);
    this->Target.Load(slab, 0);
  }

  /// What a row of rays has met on its way to station `s`, and what it meets in the layer behind.
  void RayRow(int s, int row)
  {
    const Station& station = this->Source.stations[std::size_t(s)];
    const Interval& work = station.work[std::size_t(row)];
    const auto columns = static_cast<std::size_t>(this->Source.columns);
    float* memory = ThreadScratch(LayerMemory(this->Source));
    limpid::RayRow rays{};
    const bool meets = s < this->Source.LastStation() && !work.Empty();
    if (meets)
    {
      rays = RaysOf(this->Source, this->Images, s, row);
      SampleExtinction(this->Source, s, row, this->Extinction, memory, rays);
    }
    this->Tell(station, s, row, meets ? work : Interval{}, memory);
    if (meets)
    {
      DeepenRow(rays, this->Images.opticalDepth.data() + std::size_t(row) * columns);
      this->Dimmed[std::size_t(row)] = Hull(this->Dimmed[std::size_t(row)], work);
    }
  }

  void VoxelRow(int s, int v)
  {
    const Station& station = this->Source.stations[std::size_t(s)];
    const Interval owned = station.ownedColumns;
    float* out = this->Target.Row(station.slice, v);
    float* memory = ThreadScratch(3 * ScratchSize(this->Source));
    const auto linear = [&](const Interval& columns)
    { SampleTransmittance(this->Source, station, v, columns, this->Images, memory, out); };

    // Ahead of its entry into the box a ray says nothing that four rays could bend by.
    const LinearMap& map = station.voxelColumns;
    const int row = station.voxelRows.index[std::size_t(v)];
    const Interval rows = RaysEnteredBy(this->Source.rowAxis, station.relativeDepth);
    const Interval cubic = row > rows.begin && row + 2 < rows.end
      ? CubicTargets(map, owned, RaysEnteredBy(this->Source.columnAxis, station.relativeDepth))
      : Interval{};
    if (cubic.Empty())
    {
      linear(owned);
      return;
    }
    const Interval frontRows = this->Source.frontRows;
    const Interval front = row > frontRows.begin && row + 2 < frontRows.end
      ? CubicTargets(map, cubic, this->Source.frontColumns)
      : Interval{ cubic.end, cubic.end };
    linear({ owned.begin, cubic.begin });
    this->SampleSide(station, v, { cubic.begin, front.begin }, memory, out);
    this->SampleFront(station, v, front, memory, out);
    this->SampleSide(station, v, { front.end, cubic.end }, memory, out);
    linear({ cubic.end, owned.end });
  }

  void Store(const Slab& slab) { this->Target.Store(slab); }

private:
  /// Turns optical depths into what the voxels of a station read. `extinction`: just behind the
  /// station, of the columns in `filled`.
  void Tell(const Station& station, int s, int row, const Interval& filled, float* extinction)
  {
    if (station.slice < 0)
    {
      return; // nobody reads at the eye
    }
    const Interval rows = Reads(station.voxelRows, station.ownedRows, this->Source.rows);
    const Interval columns =
      Reads(station.voxelColumns, station.ownedColumns, this->Source.columns);
    if (row < rows.begin || row >= rows.end || columns.Empty())
    {
      return;
    }
    if (filled.Empty())
    {
      TransmitRays(this->Source, s, row, Intersection(columns, this->Dimmed[std::size_t(row)]),
        nullptr, Depths::Wound, this->Images);
      return;
    }
    const Interval dimmed = Hull(filled, this->Dimmed[std::size_t(row)]);
    const Interval told = Intersection(columns, dimmed);
    std::fill(extinction + told.begin, extinction + std::max(told.begin, filled.begin), 0.0f);
    std::fill(extinction + std::min(told.end, filled.end), extinction + told.end, 0.0f);
    TransmitRays(this->Source, s, row, told, extinction, Depths::Wound, this->Images);
  }

  /// Transmittance at voxels whose sixteen rays all enter the box in its front.
  void SampleFront(
    const Station& station, int v, const Interval& columns, float* memory, float* out) const
  {
    this->SampleCubic(station, v, columns, this->Images.transmittance, memory, out);
    ClampRow(columns, out);
  }

  /// The same where some enter through a side, see SampleTransmittance.
  void SampleSide(
    const Station& station, int v, const Interval& columns, float* memory, float* out) const
  {
    this->SampleCubic(station, v, columns, this->Images.density, memory, out);
    TransmitVoxelRow(station.relativeDepth,
      std::max(station.rowEntry[std::size_t(v)], this->Source.FrontDepth()),
      station.columnEntry.data(), columns, out);
  }

  /// Cubic interpolation of an image of the rays. `memory`: three times ScratchSize(pyramid)
  /// values.
  void SampleCubic(const Station& station, int v, const Interval& columns,
    const std::vector<float>& image, float* memory, float* out) const
  {
    if (columns.Empty())
    {
      return;
    }
    const LinearMap& map = station.voxelColumns;
    const int row = station.voxelRows.index[std::size_t(v)];
    const int begin = map.index[std::size_t(columns.begin)];
    const int end = map.index[std::size_t(columns.end) - 1] + 2;
    const std::size_t size = ScratchSize(this->Source);
    float* blend = memory;
    float* curvature = memory + size;
    float* bend = memory + 2 * size;
    const float* rows[4];
    for (int i = 0; i < 4; ++i)
    {
      rows[i] = image.data() + std::size_t(row - 1 + i) * std::size_t(this->Source.columns);
    }
    BlendCubic(rows, station.voxelRows.weight[std::size_t(v)], begin - 1, end + 1, blend);
    Curve(blend, begin, end, curvature);
    InterpolateRow(blend, map, columns, out);
    InterpolateRow(curvature, map, columns, bend);
    BendRow(map, bend, columns, out);
  }

  const Pyramid& Source;
  RayImages& Images;
  SliceWindow Extinction;
  SliceWindow Target;
  std::vector<Interval> Dimmed; ///< per row: columns of rays that have met something
};
}

void FillTransmittance(const Grid& grid, const float* extinction, const Eye& eye, double rayDensity,
  float* transmittance)
{
  ParallelFor(grid.NodeCount(), 65536, [&](Index node) { transmittance[node] = 1.0f; });
  const Occupancy occupancy(grid, extinction, extinction, true);
  for (const Pyramid& pyramid : PlanSweep(grid, occupancy, eye, rayDensity, Placement::ForNodes))
  {
    RayImages images(pyramid);
    TransmittanceVisitor visitor(pyramid, grid, extinction, transmittance, images);
    SweepFrontToBack(pyramid, visitor);
  }
}
}
