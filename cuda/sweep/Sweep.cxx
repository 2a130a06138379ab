// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/Sweep.h"

#include "sweep/Cubic.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace limpid
{
RayImages::RayImages(const Pyramid& pyramid)
{
  const auto count = static_cast<std::size_t>(pyramid.RayCount());
  this->length.resize(count);
  for (int row = 0; row < pyramid.rows; ++row)
  {
    for (int column = 0; column < pyramid.columns; ++column)
    {
      this->length[std::size_t(row) * pyramid.columns + column] = pyramid.RayLength(column, row);
    }
  }
  this->opticalDepth.resize(count);
  this->behind.resize(count);
  this->visible.resize(count);
  this->plain.resize(count);
  this->transmittance.resize(count);
  this->density.resize(count);
}

RaysBehind RayImages::Behind(const Pyramid& pyramid, int row)
{
  const std::size_t first = std::size_t(row) * pyramid.columns;
  return { this->behind.data() + first, this->visible.data() + first, this->plain.data() + first,
    this->opticalDepth.data() + first };
}

Layer LayerOf(const Pyramid& pyramid, int front)
{
  const Station& near = pyramid.stations[std::size_t(front)];
  const Station& far = pyramid.stations[std::size_t(front) + 1];
  return { near.relativeDepth, far.relativeDepth - near.relativeDepth, near.scale, far.scale };
}

RayRow RaysOf(const Pyramid& pyramid, const RayImages& images, int front, int row)
{
  const Station& station = pyramid.stations[std::size_t(front)];
  RayRow rays{};
  rays.layer = LayerOf(pyramid, front);
  rays.row = { pyramid.rowAxis.entry[std::size_t(row)], pyramid.rowAxis.exit[std::size_t(row)] };
  rays.columnEntry = pyramid.columnAxis.entry.data();
  rays.columnExit = pyramid.columnAxis.exit.data();
  rays.length = images.length.data() + std::size_t(row) * pyramid.columns;
  rays.work = station.work[std::size_t(row)];
  rays.inside = station.insideColumns;
  return rays;
}

std::size_t ScratchSize(const Pyramid& pyramid)
{
  constexpr std::size_t readBeyond = 32; // see InterpolateRow
  return std::size_t(std::max(pyramid.nodesU, pyramid.columns)) + readBeyond;
}

void SamplePlane(const Plane& plane, int row, const Interval& columns, Slices slices,
  SliceWindow& field, float* scratch, float* out)
{
  if (columns.Empty())
  {
    return;
  }
  const auto r = std::size_t(row);
  const int v = plane.rayRows.index[r];
  const float across = plane.rayRows.weight[r];
  const Interval read =
    FilledRegisters({ plane.rayColumns.index[std::size_t(columns.begin)],
                      plane.rayColumns.index[std::size_t(columns.end) - 1] + 2 },
      { 0, field.ColumnCount() });
  const int soon = plane.rayRows.index[std::min(r + 2, plane.rayRows.index.size() - 1)] + 1;
  field.Prefetch(plane.slices[0], soon, read);
  field.Prefetch(plane.slices[1], soon, read);
  const float* back[2] = { field.Row(plane.slices[1], v), field.Row(plane.slices[1], v + 1) };
  if (slices == Slices::Rear)
  {
    BlendRows(back[0], back[1], across, read.begin, read.end, scratch);
  }
  else
  {
    const float* rows[2][2] = {
      { field.Row(plane.slices[0], v), field.Row(plane.slices[0], v + 1) }, { back[0], back[1] }
    };
    BlendFourRows(rows, across, plane.fraction, read.begin, read.end, scratch);
  }
  InterpolateRow(scratch, plane.rayColumns, columns, out);
}

void SampleRays(const Pyramid& pyramid, const Station& station, int v, const Interval& columns,
  const std::vector<float>& image, float* scratch, float* out)
{
  if (columns.Empty())
  {
    return;
  }
  const LinearMap& map = station.voxelColumns;
  const Interval read = FilledRegisters(
    { map.index[std::size_t(columns.begin)], map.index[std::size_t(columns.end) - 1] + 2 },
    { 0, pyramid.columns });
  const int row = station.voxelRows.index[std::size_t(v)];
  const float* first = image.data() + std::size_t(row) * pyramid.columns;
  BlendRows(first, first + pyramid.columns, station.voxelRows.weight[std::size_t(v)], read.begin,
    read.end, scratch);
  InterpolateRow(scratch, map, columns, out);
}

void TransmitRays(const Pyramid& pyramid, int s, int row, const Interval& columns,
  const float* extinction, Depths depths, RayImages& images)
{
  const std::size_t first = std::size_t(row) * pyramid.columns;
  const Station& station = pyramid.stations[std::size_t(s)];
  const double* opticalDepth = images.opticalDepth.data() + first;
  TransmitRow(opticalDepth, columns, images.transmittance.data() + first);
  const DensityRow rays{ station.relativeDepth,
    std::max(pyramid.rowAxis.entry[std::size_t(row)], pyramid.FrontDepth()),
    pyramid.columnAxis.entry.data(), opticalDepth, images.length.data() + first, extinction,
    depths == Depths::Unwound, depths == Depths::Unwound ? 1e30f : mostDepthBetweenRays };
  float* density = images.density.data() + first;
  // Of the rays that enter in front, a voxel beside one that does not reads up to three.
  constexpr int reach = 3;
  const Interval front = { pyramid.frontColumns.begin + reach, pyramid.frontColumns.end - reach };
  const bool nextToSide =
    row < pyramid.frontRows.begin + reach || row >= pyramid.frontRows.end - reach;
  if (nextToSide || front.Empty())
  {
    DensifyRow(rays, columns, density);
    return;
  }
  DensifyRow(rays, Intersection(columns, { columns.begin, front.begin }), density);
  DensifyRow(rays, Intersection(columns, { front.end, columns.end }), density);
}

void SampleTransmittance(const Pyramid& pyramid, const Station& station, int v,
  const Interval& columns, const RayImages& images, float* scratch, float* out)
{
  const auto fromSide = [&](const Interval& side)
  {
    SampleRays(pyramid, station, v, side, images.density, scratch, out);
    TransmitVoxelRow(station.relativeDepth,
      std::max(station.rowEntry[std::size_t(v)], pyramid.FrontDepth()), station.columnEntry.data(),
      side, out);
  };
  const int row = station.voxelRows.index[std::size_t(v)];
  const std::vector<int>& index = station.voxelColumns.index;
  // Voxels both of whose rays enter in front read index and index + 1.
  const auto begin = std::lower_bound(index.begin(), index.end(), pyramid.frontColumns.begin);
  const auto end = std::lower_bound(index.begin(), index.end(), pyramid.frontColumns.end - 1);
  const Interval front = Intersection(
    columns, { static_cast<int>(begin - index.begin()), static_cast<int>(end - index.begin()) });
  const bool rowInFront = row >= pyramid.frontRows.begin && row + 1 < pyramid.frontRows.end;
  if (!rowInFront || front.Empty())
  {
    fromSide(columns);
    return;
  }
  fromSide({ columns.begin, front.begin });
  SampleRays(pyramid, station, v, front, images.transmittance, scratch, out);
  fromSide({ front.end, columns.end });
}

void HideOutOfView(const Pyramid& pyramid, int row, const Interval& columns, float* importance)
{
  if (!pyramid.inView.empty())
  {
    MultiplyRow(importance, pyramid.inView.data() + std::size_t(row) * pyramid.columns, columns);
  }
}

std::size_t LayerMemory(const Pyramid& pyramid)
{
  return 4 * std::size_t(pyramid.columns) + ScratchSize(pyramid);
}

void SampleExtinction(
  const Pyramid& pyramid, int s, int row, SliceWindow& extinction, float* memory, RayRow& rays)
{
  const auto columns = std::size_t(pyramid.columns);
  for (int half = 0; half < 2; ++half)
  {
    const Plane& plane = pyramid.stations[std::size_t(s)].planes[std::size_t(half)];
    float* samples = memory + std::size_t(half) * columns;
    SamplePlane(plane, row, rays.work, Slices::Both, extinction, memory + 4 * columns, samples);
    rays.extinction[half] = rays.importance[half] = samples;
  }
}

void SampleLayer(const Pyramid& pyramid, int s, int row, SliceWindow& extinction,
  SliceWindow& importance, float* memory, RayRow& rays)
{
  const auto columns = std::size_t(pyramid.columns);
  SampleExtinction(pyramid, s, row, extinction, memory, rays);
  for (int half = 0; half < 2; ++half)
  {
    const Plane& plane = pyramid.stations[std::size_t(s)].planes[std::size_t(half)];
    float* samples = memory + std::size_t(half + 2) * columns;
    SamplePlane(plane, row, rays.work, Slices::Both, importance, memory + 4 * columns, samples);
    HideOutOfView(pyramid, row, rays.work, samples);
    rays.importance[half] = samples;
  }
}

namespace
{
/// The forward sweep of one pyramid; one call of Row moves a row of rays through a slab.
class ForwardVisitor
{
public:
  /// `importance`: null: optical depths are all that is wanted.
  ForwardVisitor(const Pyramid& pyramid, const Grid& grid, const float* extinction,
    const float* importance, RayImages& images)
    : Source(pyramid)
    , Images(images)
    , Scores(importance != nullptr)
    , Extinction(pyramid, grid, extinction)
    , Importance(pyramid, grid, importance)
  {
    std::fill(images.opticalDepth.begin(), images.opticalDepth.end(), 0.0);
    if (this->Scores)
    {
      std::fill(images.behind.begin(), images.behind.end(), 0.0f);
      std::fill(images.plain.begin(), images.plain.end(), 0.0f);
    }
  }

  void Sweep()
  {
    constexpr Index rowsPerTask = 4;
    for (const Slab& slab : SlabsOf(this->Source))
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
  void Row(const Slab& slab, int row)
  {
    const std::size_t first = std::size_t(row) * this->Source.columns;
    double* opticalDepth = this->Images.opticalDepth.data() + first;
    float* memory = ThreadScratch(LayerMemory(this->Source));
    for (int s = slab.begin; s < std::min(slab.end, this->Source.LastStation()); ++s)
    {
      RayRow rays = RaysOf(this->Source, this->Images, s, row);
      if (this->Scores)
      {
        SampleLayer(this->Source, s, row, this->Extinction, this->Importance, memory, rays);
        ForwardRow(rays, opticalDepth, this->Images.behind.data() + first,
          this->Images.plain.data() + first);
      }
      else
      {
        SampleExtinction(this->Source, s, row, this->Extinction, memory, rays);
        DeepenRow(rays, opticalDepth);
      }
    }
  }

  const Pyramid& Source;
  RayImages& Images;
  bool Scores;
  SliceWindow Extinction;
  SliceWindow Importance;
};
}

double SumOfRays(const Pyramid& pyramid, const RayImages& images, const float* values)
{
  constexpr Index rowsPerTask = 16;
  std::vector<double> rows(std::size_t(pyramid.rows));
  ParallelFor(pyramid.rows, rowsPerTask,
    [&](Index row)
    {
      double part = 0;
      for (int column = 0; column < pyramid.columns; ++column)
      {
        const std::size_t ray = std::size_t(row) * pyramid.columns + column;
        part +=
          pyramid.columnAxis.share[std::size_t(column)] / double(images.length[ray]) * values[ray];
      }
      rows[std::size_t(row)] = part * pyramid.rowAxis.share[std::size_t(row)];
    });
  return pyramid.cellMeasure * std::accumulate(rows.begin(), rows.end(), 0.0);
}

Visible SweepForward(const Pyramid& pyramid, const Grid& grid, const float* extinction,
  const float* importance, RayImages& images)
{
  ForwardVisitor(pyramid, grid, extinction, importance, images).Sweep();
  return { SumOfRays(pyramid, images, images.behind.data()),
    SumOfRays(pyramid, images, images.plain.data()) };
}

void SweepDepths(
  const Pyramid& pyramid, const Grid& grid, const float* extinction, RayImages& images)
{
  ForwardVisitor(pyramid, grid, extinction, nullptr, images).Sweep();
}

void StartBehind(RayImages& images)
{
  std::fill(images.behind.begin(), images.behind.end(), 0.0f);
  std::fill(images.visible.begin(), images.visible.end(), -1.0f);
  std::fill(images.plain.begin(), images.plain.end(), 0.0f);
}

Visible SumBehind(const Pyramid& pyramid, RayImages& images)
{
  for (std::size_t ray = 0; ray < images.visible.size(); ++ray)
  {
    const bool inFront = images.visible[ray] < 0; // where the ray enters the volume
    images.visible[ray] = inFront ? images.behind[ray] : images.visible[ray];
  }
  return { SumOfRays(pyramid, images, images.visible.data()),
    SumOfRays(pyramid, images, images.plain.data()) };
}
}
