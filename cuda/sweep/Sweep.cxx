// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/Sweep.h"

#include "sweep/Cubic.h"
#include "sweep/Registers.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace limpid
{
RayImages::RayImages(const FaceFrustum& frustum)
{
  const auto count = static_cast<std::size_t>(frustum.RayCount());
  this->length.resize(count);
  for (int row = 0; row < frustum.rows; ++row)
  {
    for (int column = 0; column < frustum.columns; ++column)
    {
      this->length[std::size_t(row) * frustum.columns + column] = frustum.RayLength(column, row);
    }
  }
  this->opticalDepth.resize(count);
  this->behind.resize(count);
  this->visible.resize(count);
  this->unattenuated.resize(count);
  this->transmittance.resize(count);
  this->density.resize(count);
}

RaysBehind RayImages::Behind(const FaceFrustum& frustum, int row)
{
  const std::size_t first = std::size_t(row) * frustum.columns;
  return { this->behind.data() + first, this->visible.data() + first,
    this->unattenuated.data() + first, this->opticalDepth.data() + first };
}

Layer LayerOf(const FaceFrustum& frustum, int front)
{
  const Slice& near = frustum.slices[std::size_t(front)];
  const Slice& far = frustum.slices[std::size_t(front) + 1];
  return { near.relativeDepth, far.relativeDepth - near.relativeDepth, near.scale, far.scale };
}

RayRow RaysOf(const FaceFrustum& frustum, const RayImages& images, int front, int row)
{
  const Slice& slice = frustum.slices[std::size_t(front)];
  RayRow rays{};
  rays.layer = LayerOf(frustum, front);
  rays.row = { frustum.rowAxis.entry[std::size_t(row)], frustum.rowAxis.exit[std::size_t(row)] };
  rays.columnEntry = frustum.columnAxis.entry.data();
  rays.columnExit = frustum.columnAxis.exit.data();
  rays.length = images.length.data() + std::size_t(row) * frustum.columns;
  rays.work = slice.work[std::size_t(row)];
  rays.inside = slice.insideColumns;
  return rays;
}

namespace
{
/// Values that a row of samples takes.
std::size_t RowScratch(int columns)
{
  constexpr std::size_t readBeyond = 32; // see InterpolateRow
  return std::size_t(columns) + readBeyond;
}
}

std::size_t ScratchSize(const FaceFrustum& frustum)
{
  return RowScratch(std::max(frustum.nodesU, frustum.columns));
}

namespace
{
/// Columns of a field that a row of rays is interpolated from.
Range<int> ColumnsRead(const Plane& plane, const Range<int>& rays, const SliceWindow& field)
{
  return WholeRegisters({ plane.rayColumns.index[std::size_t(rays.begin)],
                          plane.rayColumns.index[std::size_t(rays.end) - 1] + 2 },
    { 0, field.ColumnCount() });
}

/// The two rows of voxels on both slices of a plane that a row of rays is interpolated from.
struct FourRows
{
  const float* rows[2][2];

  FourRows(const Plane& plane, int v, SliceWindow& field)
  {
    for (int slice = 0; slice < 2; ++slice)
    {
      this->rows[slice][0] = field.Row(plane.nodes[slice], v);
      this->rows[slice][1] = field.Row(plane.nodes[slice], v + 1);
    }
  }
};

/// Brings what a later row of rays will read.
LIMPID_INLINE void PrefetchPlane(
  const Plane& plane, int row, const Range<int>& columns, SliceWindow& field)
{
  const auto later = std::min(std::size_t(row) + 2, plane.rayRows.index.size() - 1);
  const int soon = plane.rayRows.index[later] + 1;
  field.Prefetch(plane.nodes[0], soon, columns);
}
}

void SamplePlane(const Plane& plane, int row, const Range<int>& columns, SliceBlend blend,
  SliceWindow& field, float* scratch, float* out)
{
  if (columns.Empty())
  {
    return;
  }
  const Range<int> read = ColumnsRead(plane, columns, field);
  PrefetchPlane(plane, row, read, field);
  const float across = plane.rayRows.weight[std::size_t(row)];
  const FourRows four(plane, plane.rayRows.index[std::size_t(row)], field);
  if (blend == SliceBlend::RearAlone)
  {
    BlendRows(four.rows[1][0], four.rows[1][1], across, read.begin, read.end, scratch);
  }
  else
  {
    BlendFourRows(four.rows, across, plane.fraction, read.begin, read.end, scratch);
  }
  InterpolateRow(scratch, plane.rayColumns, columns, out);
}

void SamplePlanes(const std::array<Plane, 2>& planes, int row, const Range<int>& columns,
  SliceWindow& field, float* scratch, float* const out[2])
{
  const auto r = std::size_t(row);
  const int v = planes[0].rayRows.index[r];
  if (columns.Empty() || v != planes[1].rayRows.index[r])
  {
    SamplePlane(planes[0], row, columns, SliceBlend::Both, field, scratch, out[0]);
    SamplePlane(planes[1], row, columns, SliceBlend::Both, field, scratch, out[1]);
    return;
  }
  const Range<int> read =
    Hull(ColumnsRead(planes[0], columns, field), ColumnsRead(planes[1], columns, field));
  PrefetchPlane(planes[0], row, read, field);
  const float across[2] = { planes[0].rayRows.weight[r], planes[1].rayRows.weight[r] };
  const float along[2] = { planes[0].fraction, planes[1].fraction };
  const FourRows four(planes[0], v, field);
  float* second = scratch + RowScratch(field.ColumnCount());
  BlendFourRowsTwice(four.rows, across, along, read.begin, read.end, scratch, second);
  InterpolateRow(scratch, planes[0].rayColumns, columns, out[0]);
  InterpolateRow(second, planes[1].rayColumns, columns, out[1]);
}

void SampleRays(const FaceFrustum& frustum, const Slice& slice, int v, const Range<int>& columns,
  const std::vector<float>& image, float* scratch, float* out)
{
  if (columns.Empty())
  {
    return;
  }
  const LinearMap& map = slice.voxelColumns;
  const Range<int> read = WholeRegisters(
    { map.index[std::size_t(columns.begin)], map.index[std::size_t(columns.end) - 1] + 2 },
    { 0, frustum.columns });
  const int row = slice.voxelRows.index[std::size_t(v)];
  const float* first = image.data() + std::size_t(row) * frustum.columns;
  BlendRows(first, first + frustum.columns, slice.voxelRows.weight[std::size_t(v)], read.begin,
    read.end, scratch);
  InterpolateRow(scratch, map, columns, out);
}

void TransmitRays(const FaceFrustum& frustum, int s, int row, const Range<int>& columns,
  const float* extinction, Depths depths, RayImages& images)
{
  const std::size_t first = std::size_t(row) * frustum.columns;
  const Slice& slice = frustum.slices[std::size_t(s)];
  const double* opticalDepth = images.opticalDepth.data() + first;
  TransmitRow(opticalDepth, columns, images.transmittance.data() + first);
  const DensityRow rays{ slice.relativeDepth,
    std::max(frustum.rowAxis.entry[std::size_t(row)], frustum.FrontDepth()),
    frustum.columnAxis.entry.data(), opticalDepth, images.length.data() + first, extinction,
    depths == Depths::Unwound, depths == Depths::Unwound ? 1e30f : mostDepthBetweenRays };
  float* density = images.density.data() + first;
  // Of the rays that enter in front, a voxel beside one that does not reads up to three.
  constexpr int reach = 3;
  const Range<int> front = { frustum.frontColumns.begin + reach, frustum.frontColumns.end - reach };
  const bool nextToSide =
    row < frustum.frontRows.begin + reach || row >= frustum.frontRows.end - reach;
  if (nextToSide || front.Empty())
  {
    DensifyRow(rays, columns, density);
    return;
  }
  DensifyRow(rays, Intersection(columns, { columns.begin, front.begin }), density);
  DensifyRow(rays, Intersection(columns, { front.end, columns.end }), density);
}

Range<int> ColumnsBetweenFrontRays(
  const FaceFrustum& frustum, const Slice& slice, int v, const Range<int>& columns)
{
  const int row = slice.voxelRows.index[std::size_t(v)];
  // Both rays of a voxel have to.
  const Range<int> front = Intersection(columns,
    { slice.firstVoxels[std::size_t(frustum.frontColumns.begin)],
      slice.firstVoxels[std::size_t(frustum.frontColumns.end) - 1] });
  const bool rowInFront = row >= frustum.frontRows.begin && row + 1 < frustum.frontRows.end;
  return rowInFront && !front.Empty() ? front : Range<int>{ columns.end, columns.end };
}

void TransmitFromSide(const FaceFrustum& frustum, const Slice& slice, int v,
  const Range<int>& columns, const RayImages& images, float* scratch, float* out)
{
  SampleRays(frustum, slice, v, columns, images.density, scratch, out);
  TransmitVoxelRow(slice.relativeDepth,
    std::max(slice.rowEntry[std::size_t(v)], frustum.FrontDepth()), slice.columnEntry.data(),
    columns, out);
}

void SampleTransmittance(const FaceFrustum& frustum, const Slice& slice, int v,
  const Range<int>& columns, const RayImages& images, float* scratch, float* out)
{
  const Range<int> front = ColumnsBetweenFrontRays(frustum, slice, v, columns);
  TransmitFromSide(frustum, slice, v, { columns.begin, front.begin }, images, scratch, out);
  SampleRays(frustum, slice, v, front, images.transmittance, scratch, out);
  TransmitFromSide(frustum, slice, v, { front.end, columns.end }, images, scratch, out);
}

void HideOutOfView(
  const FaceFrustum& frustum, int row, const Range<int>& columns, float* importance)
{
  if (!frustum.inView.empty())
  {
    MultiplyRow(importance, frustum.inView.data() + std::size_t(row) * frustum.columns, columns);
  }
}

std::size_t LayerMemory(const FaceFrustum& frustum)
{
  return 4 * std::size_t(frustum.columns) + 2 * ScratchSize(frustum);
}

void SampleExtinction(
  const FaceFrustum& frustum, int s, int row, SliceWindow& extinction, float* memory, RayRow& rays)
{
  const auto columns = std::size_t(frustum.columns);
  float* const samples[2] = { memory, memory + columns };
  SamplePlanes(frustum.slices[std::size_t(s)].planes, row, rays.work, extinction,
    memory + 4 * columns, samples);
  for (int half = 0; half < 2; ++half)
  {
    rays.extinction[half] = rays.importance[half] = samples[half];
  }
}

void SampleLayer(const FaceFrustum& frustum, int s, int row, SliceWindow& extinction,
  SliceWindow& importance, float* memory, RayRow& rays)
{
  const auto columns = std::size_t(frustum.columns);
  SampleExtinction(frustum, s, row, extinction, memory, rays);
  float* const samples[2] = { memory + 2 * columns, memory + 3 * columns };
  SamplePlanes(frustum.slices[std::size_t(s)].planes, row, rays.work, importance,
    memory + 4 * columns, samples);
  for (int half = 0; half < 2; ++half)
  {
    HideOutOfView(frustum, row, rays.work, samples[half]);
    rays.importance[half] = samples[half];
  }
}

namespace
{
/// The forward sweep of one frustum; one call of Row moves a row of rays through a slab.
class ForwardVisitor
{
public:
  /// `scores`: or optical depths are all that is wanted.
  ForwardVisitor(
    const FaceFrustum& frustum, const RayFields& fields, bool scores, RayImages& images)
    : Source(frustum)
    , Images(images)
    , Scores(scores)
    , Extinction(frustum, *fields.grid, fields.extinction, images.slabs, fields.occupancy)
    , Importance(frustum, *fields.grid, fields.importance, images.slabs, fields.occupancy)
  {
    FillImage(images.opticalDepth, 0.0);
    if (this->Scores)
    {
      FillImage(images.behind, 0.0f);
      FillImage(images.unattenuated, 0.0f);
    }
  }

  void Sweep()
  {
    constexpr Index rowsPerTask = 4;
    for (const Range<int>& slab : SlabsOf(this->Source))
    {
      this->Extinction.Load(slab, 1);
      if (this->Scores)
      {
        this->Importance.Load(slab, 1);
      }
      ParallelFor(this->Source.rows, rowsPerTask, [&](Index row) { this->Row(slab, int(row)); });
    }
  }

private:
  void Row(const Range<int>& slab, int row)
  {
    const std::size_t first = std::size_t(row) * this->Source.columns;
    double* opticalDepth = this->Images.opticalDepth.data() + first;
    float* memory = ThreadScratch(LayerMemory(this->Source));
    for (int s = slab.begin; s < std::min(slab.end, this->Source.LastSlice()); ++s)
    {
      RayRow rays = RaysOf(this->Source, this->Images, s, row);
      if (rays.work.Empty())
      {
        continue;
      }
      if (this->Scores)
      {
        SampleLayer(this->Source, s, row, this->Extinction, this->Importance, memory, rays);
        ForwardRow(rays, opticalDepth, this->Images.behind.data() + first,
          this->Images.unattenuated.data() + first);
      }
      else
      {
        SampleExtinction(this->Source, s, row, this->Extinction, memory, rays);
        DeepenRow(rays, opticalDepth);
      }
    }
  }

  const FaceFrustum& Source;
  RayImages& Images;
  bool Scores;
  SliceWindow Extinction;
  SliceWindow Importance;
};
}

double SumOfRays(const FaceFrustum& frustum, const RayImages& images, const float* values)
{
  constexpr Index rowsPerTask = 16;
  std::vector<double> rows(std::size_t(frustum.rows));
  ParallelFor(frustum.rows, rowsPerTask,
    [&](Index row)
    {
      double part = 0;
      for (int column = 0; column < frustum.columns; ++column)
      {
        const std::size_t ray = std::size_t(row) * frustum.columns + column;
        part +=
          frustum.columnAxis.share[std::size_t(column)] / double(images.length[ray]) * values[ray];
      }
      rows[std::size_t(row)] = part * frustum.rowAxis.share[std::size_t(row)];
    });
  return frustum.cellMeasure * std::accumulate(rows.begin(), rows.end(), 0.0);
}

Visible SweepForward(const FaceFrustum& frustum, const RayFields& fields, RayImages& images)
{
  ForwardVisitor(frustum, fields, true, images).Sweep();
  return { SumOfRays(frustum, images, images.behind.data()),
    SumOfRays(frustum, images, images.unattenuated.data()) };
}

void SweepDepths(const FaceFrustum& frustum, const RayFields& fields, RayImages& images)
{
  ForwardVisitor(frustum, fields, false, images).Sweep();
}

void StartBehind(RayImages& images)
{
  FillImage(images.behind, 0.0f);
  FillImage(images.visible, -1.0f);
  FillImage(images.unattenuated, 0.0f);
  FillImage(images.transmittance, 1.0f);
  FillImage(images.density, 0.0f);
}

Visible SumBehind(const FaceFrustum& frustum, RayImages& images)
{
  ParallelFor(Index(images.visible.size()), raysPerTask,
    [&](Index ray)
    {
      const auto r = static_cast<std::size_t>(ray);
      const bool inFront = images.visible[r] < 0; // where the ray enters the volume
      images.visible[r] = inFront ? images.behind[r] : images.visible[r];
    });
  return { SumOfRays(frustum, images, images.visible.data()),
    SumOfRays(frustum, images, images.unattenuated.data()) };
}
}
