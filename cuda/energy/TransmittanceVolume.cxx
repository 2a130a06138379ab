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
Range<int> Reads(const LinearMap& map, const Range<int>& targets, int sources)
{
  if (targets.Empty())
  {
    return {};
  }
  return Intersection(Range<int>{ map.index[std::size_t(targets.begin)] - 1,
                        map.index[std::size_t(targets.end) - 1] + 3 },
    { 0, sources });
}

/// Targets in `targets` whose four sources for a cubic lie in `sources`.
Range<int> CubicTargets(const LinearMap& map, const Range<int>& targets, const Range<int>& sources)
{
  const auto first = map.index.begin() + targets.begin;
  const auto last = map.index.begin() + targets.end;
  const auto begin = std::lower_bound(first, last, sources.begin + 1);
  const auto end = std::lower_bound(begin, last, sources.end - 2);
  return { static_cast<int>(begin - map.index.begin()), static_cast<int>(end - map.index.begin()) };
}

/// The forward sweep of one frustum that writes the transmittance of the voxels as it goes.
class TransmittanceVisitor
{
public:
  TransmittanceVisitor(const FaceFrustum& frustum, const Grid& grid, const float* extinction,
    float* transmittance, RayImages& images)
    : Source(frustum)
    , Images(images)
    , Extinction(frustum, grid, extinction, images.slabs)
    , Target(frustum, grid, transmittance, images.slabs)
    , Dimmed(std::size_t(frustum.rows))
  {
    FillImage(images.opticalDepth, 0.0);
    FillImage(images.transmittance, 1.0f);
    FillImage(images.density, 0.0f);
  }

  void Load(const Range<int>& slab)
  {
    this->Extinction.Load(slab, 1);
    this->Target.Load(slab, 0);
  }

  /// What a row of rays has met on its way to slice `s`, and what it meets in the layer behind.
  void RayRow(int s, int row)
  {
    const Slice& slice = this->Source.slices[std::size_t(s)];
    const Range<int>& work = slice.work[std::size_t(row)];
    const auto columns = static_cast<std::size_t>(this->Source.columns);
    float* memory = ThreadScratch(LayerMemory(this->Source));
    limpid::RayRow rays{};
    const bool meets = s < this->Source.LastSlice() && !work.Empty();
    if (meets)
    {
      rays = RaysOf(this->Source, this->Images, s, row);
      SampleExtinction(this->Source, s, row, this->Extinction, memory, rays);
    }
    this->Tell(slice, s, row, meets ? work : Range<int>{}, memory);
    if (meets)
    {
      DeepenRow(rays, this->Images.opticalDepth.data() + std::size_t(row) * columns);
      this->Dimmed[std::size_t(row)] = Hull(this->Dimmed[std::size_t(row)], work);
    }
  }

  void VoxelRow(int s, int v)
  {
    const Slice& slice = this->Source.slices[std::size_t(s)];
    const Range<int> owned = slice.ownedColumns;
    float* out = this->Target.Row(slice.node, v);
    float* memory = ThreadScratch(3 * ScratchSize(this->Source));
    const auto linear = [&](const Range<int>& columns)
    { SampleTransmittance(this->Source, slice, v, columns, this->Images, memory, out); };

    // Ahead of its entry into the box a ray says nothing that four rays could bend by.
    const LinearMap& map = slice.voxelColumns;
    const int row = slice.voxelRows.index[std::size_t(v)];
    const Range<int> rows = RaysEnteredBy(this->Source.rowAxis, slice.relativeDepth);
    const Range<int> cubic = row > rows.begin && row + 2 < rows.end
      ? CubicTargets(map, owned, RaysEnteredBy(this->Source.columnAxis, slice.relativeDepth))
      : Range<int>{};
    if (cubic.Empty())
    {
      linear(owned);
      return;
    }
    const Range<int> frontRows = this->Source.frontRows;
    const Range<int> front = row > frontRows.begin && row + 2 < frontRows.end
      ? CubicTargets(map, cubic, this->Source.frontColumns)
      : Range<int>{ cubic.end, cubic.end };
    linear({ owned.begin, cubic.begin });
    this->SampleSide(slice, v, { cubic.begin, front.begin }, memory, out);
    this->SampleFront(slice, v, front, memory, out);
    this->SampleSide(slice, v, { front.end, cubic.end }, memory, out);
    linear({ cubic.end, owned.end });
  }

  void Store(const Range<int>& slab) { this->Target.Store(slab); }

private:
  /// Moves optical depths into what the voxels of a slice read. `extinction`: just behind the
  /// slice, of the columns in `filled`.
  void Tell(const Slice& slice, int s, int row, const Range<int>& filled, float* extinction)
  {
    if (slice.node < 0)
    {
      return; // nobody reads at the eye
    }
    const Range<int> rows = Reads(slice.voxelRows, slice.ownedRows, this->Source.rows);
    const Range<int> columns = Reads(slice.voxelColumns, slice.ownedColumns, this->Source.columns);
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
    const Range<int> dimmed = Hull(filled, this->Dimmed[std::size_t(row)]);
    const Range<int> told = Intersection(columns, dimmed);
    std::fill(extinction + told.begin, extinction + std::max(told.begin, filled.begin), 0.0f);
    std::fill(extinction + std::min(told.end, filled.end), extinction + told.end, 0.0f);
    TransmitRays(this->Source, s, row, told, extinction, Depths::Wound, this->Images);
  }

  /// Transmittance at voxels whose sixteen rays all enter the box in its front.
  void SampleFront(
    const Slice& slice, int v, const Range<int>& columns, float* memory, float* out) const
  {
    this->SampleCubic(slice, v, columns, this->Images.transmittance, memory, out);
    ClampRow(columns, out);
  }

  /// The same where some enter through a side, see SampleTransmittance.
  void SampleSide(
    const Slice& slice, int v, const Range<int>& columns, float* memory, float* out) const
  {
    this->SampleCubic(slice, v, columns, this->Images.density, memory, out);
    TransmitVoxelRow(slice.relativeDepth,
      std::max(slice.rowEntry[std::size_t(v)], this->Source.FrontDepth()), slice.columnEntry.data(),
      columns, out);
  }

  /// Cubic interpolation of an image of the rays. `memory`: three times ScratchSize(frustum)
  /// values.
  void SampleCubic(const Slice& slice, int v, const Range<int>& columns,
    const std::vector<float>& image, float* memory, float* out) const
  {
    if (columns.Empty())
    {
      return;
    }
    const LinearMap& map = slice.voxelColumns;
    const int row = slice.voxelRows.index[std::size_t(v)];
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
    BlendCubic(rows, slice.voxelRows.weight[std::size_t(v)], begin - 1, end + 1, blend);
    Curve(blend, begin, end, curvature);
    InterpolateRow(blend, map, columns, out);
    InterpolateRow(curvature, map, columns, bend);
    BendRow(map, bend, columns, out);
  }

  const FaceFrustum& Source;
  RayImages& Images;
  SliceWindow Extinction;
  SliceWindow Target;
  std::vector<Range<int>> Dimmed; ///< per row: columns of rays that have met something
};
}

void FillTransmittance(const Grid& grid, const float* extinction, const RaySource& eye,
  double rayDensity, float* transmittance)
{
  ParallelFor(grid.NodeCount(), 65536, [&](Index node) { transmittance[node] = 1.0f; });
  const Occupancy occupancy(grid, extinction, extinction, true);
  for (const FaceFrustum& frustum :
    PlanSweep(grid, occupancy, eye, rayDensity, Placement::ForNodes))
  {
    RayImages images(frustum);
    TransmittanceVisitor visitor(frustum, grid, extinction, transmittance, images);
    SweepFrontToBack(frustum, visitor);
  }
}
}
