// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/RowSampler.h"

#include "backend/Backend.h"
#include "sweep/Registers.h"
#include "sweep/RowInterpolation.h"

#include <algorithm>

namespace limpid
{
namespace
{
/// The two rows of voxels on both slices of a layer that a row of rays interpolates.
struct FourRows
{
  const float* rows[2][2];
};

/// Rows of one field.
struct RowsOfField
{
  SliceWindow* field;

  /// Returns rows v and v + 1 on two slices; the last argument is the range of columns to read.
  FourRows At(const int nodes[2], int v, const Range<int>&) const
  {
    FourRows four{};
    for (int i = 0; i < 2; ++i)
    {
      four.rows[i][0] = this->field->Row(nodes[i], v);
      four.rows[i][1] = this->field->Row(nodes[i], v + 1);
    }
    return four;
  }
};

/// Rows of the lesser of two fields.
struct RowsOfLesser
{
  SliceWindow* field;
  SliceWindow* other;
  float* const (&memory)[2][2]; ///< memory for the four rows

  FourRows At(const int nodes[2], int v, const Range<int>& read) const
  {
    const FourRows first = RowsOfField{ this->field }.At(nodes, v, read);
    const FourRows second = RowsOfField{ this->other }.At(nodes, v, read);
    FourRows four{};
    for (int i = 0; i < 4; ++i)
    {
      float* lesser = this->memory[i / 2][i % 2];
      LesserRow(first.rows[i / 2][i % 2], second.rows[i / 2][i % 2], read, lesser);
      four.rows[i / 2][i % 2] = lesser;
    }
    return four;
  }
};

/// Returns the columns of a field that a row of rays interpolates.
Range<int> ColumnsRead(const LinearMap& map, const Range<int>& rays, const SliceWindow& field)
{
  return WholeRegisters(
    { map.index[rays.begin], map.index[rays.end - 1] + 2 }, { 0, field.columns });
}

/// Returns the sources of a cubic interpolation to `targets`: one more on either side than linear.
Range<int> ReadByCubics(const LinearMap& map, const Range<int>& targets, const Range<int>& sources)
{
  if (targets.Empty())
  {
    return {};
  }
  const Range<int> read{ map.index[targets.begin] - 1, map.index[targets.end - 1] + 3 };
  return Intersection(read, sources);
}
}

std::size_t RowScratch(int columns)
{
  constexpr std::size_t readBeyond = 32;
  return std::size_t(columns) + readBeyond;
}

void RayRow::EnterRow(const FaceFrustum& frustum, int number)
{
  this->row = frustum.StayOfRow(number);
  this->columnEntry = frustum.Row(frustum.columnEntry);
  this->columnExit = frustum.Row(frustum.columnExit);
  this->length = frustum.OfRow(frustum.length, number);
}

bool RayRow::EnterLayer(const FaceFrustum& frustum, int s, int number)
{
  this->columns = frustum.ActiveRays(s, number);
  if (this->columns.Empty())
  {
    return false;
  }
  const Slice& slice = frustum.SliceAt(s);
  this->layer = slice.layer;
  this->inside = slice.insideColumns;
  return true;
}

RowSampler::RowSampler(
  const FaceFrustum& frustum, const RayStates& states, int row, std::size_t more)
  : Frustum(frustum)
  , RowNumber(row)
  , All(states)
  , First(frustum.RayAt(0, row))
{
  const auto columns = std::size_t(frustum.columns);
  const std::size_t blend = RowScratch(std::max(frustum.nodesU, frustum.columns));
  float* memory = ThreadScratch(8 * columns + 6 * blend + more);
  const auto take = [&memory](std::size_t count)
  {
    float* taken = memory;
    memory += count;
    return taken;
  };
  for (int half = 0; half < 2; ++half)
  {
    this->Samples.extinction[half] = take(columns);
    this->Samples.importance[half] = take(columns);
    this->Samples.kept[half] = take(columns);
    this->Samples.blend[half] = take(blend);
    this->Samples.lesser[half][0] = take(blend);
    this->Samples.lesser[half][1] = take(blend);
    // Steps that count no importance never read it, but the pointer must be valid.
    this->Rays.extinction[half] = this->Rays.importance[half] = this->Samples.extinction[half];
    this->Rays.kept[half] = this->Samples.extinction[half];
  }
  this->Samples.densest = take(columns);
  this->Samples.important = take(columns);
  this->More = memory;
  this->Rays.EnterRow(frustum, row);
}

bool RowSampler::EnterLayer(int s, bool areaWeighted)
{
  this->S = s;
  if (!this->Rays.EnterLayer(this->Frustum, s, this->RowNumber))
  {
    return false;
  }
  if (!areaWeighted)
  {
    this->Rays.layer.frontScale = this->Rays.layer.backScale = 1;
  }
  return true;
}

/// Prefetches the values that a later row of rays reads.
LIMPID_INLINE void RowSampler::Prefetch(Field field, const Range<int>& columns) const
{
  const int later = std::min(this->RowNumber + 2, this->Frustum.SliceAt(this->S).rayRows.end - 1);
  const int soon = this->Frustum.PlaneRows(2 * this->S).index[later] + 1;
  field->Prefetch(this->Frustum.SliceAt(this->S).nodes[0], soon, columns);
}

template <class Source>
void RowSampler::SamplePlane(const Source& source, int half, float* out)
{
  const Slice& slice = this->Frustum.SliceAt(this->S);
  const int plane = 2 * this->S + half;
  const LinearMap columns = this->Frustum.PlaneColumns(plane);
  const LinearMap rows = this->Frustum.PlaneRows(plane);
  const Range<int> read = ColumnsRead(columns, this->Rays.columns, *source.field);
  this->Prefetch(source.field, read);
  const FourRows four = source.At(slice.nodes, rows.index[this->RowNumber], read);
  BlendFourRows(four.rows, rows.weight[this->RowNumber], slice.fractions[half], read.begin,
    read.end, this->Samples.blend[0]);
  InterpolateRow(this->Samples.blend[0], columns, this->Rays.columns, out);
}

template <class Source>
void RowSampler::SamplePlanes(const Source& source, float* const out[2])
{
  const int plane = 2 * this->S;
  const LinearMap columns[2] = { this->Frustum.PlaneColumns(plane),
    this->Frustum.PlaneColumns(plane + 1) };
  const LinearMap rows[2] = { this->Frustum.PlaneRows(plane), this->Frustum.PlaneRows(plane + 1) };
  const int v = rows[0].index[this->RowNumber];
  if (v != rows[1].index[this->RowNumber])
  {
    this->SamplePlane(source, 0, out[0]);
    this->SamplePlane(source, 1, out[1]);
    return;
  }
  const Range<int> read = Hull(ColumnsRead(columns[0], this->Rays.columns, *source.field),
    ColumnsRead(columns[1], this->Rays.columns, *source.field));
  this->Prefetch(source.field, read);
  const float across[2] = { rows[0].weight[this->RowNumber], rows[1].weight[this->RowNumber] };
  const Slice& slice = this->Frustum.SliceAt(this->S);
  const FourRows four = source.At(slice.nodes, v, read);
  BlendFourRowsTwice(four.rows, across, slice.fractions, read.begin, read.end,
    this->Samples.blend[0], this->Samples.blend[1]);
  InterpolateRow(this->Samples.blend[0], columns[0], this->Rays.columns, out[0]);
  InterpolateRow(this->Samples.blend[1], columns[1], this->Rays.columns, out[1]);
}

void RowSampler::SampleExtinction(Field field)
{
  this->SamplePlanes(RowsOfField{ field }, this->Samples.extinction);
  this->Rays.extinction[0] = this->Samples.extinction[0];
  this->Rays.extinction[1] = this->Samples.extinction[1];
}

void RowSampler::SampleImportance(Field field)
{
  this->SamplePlanes(RowsOfField{ field }, this->Samples.importance);
  for (int half = 0; half < 2; ++half)
  {
    this->HideOutOfView(this->Samples.importance[half]);
    this->Rays.importance[half] = this->Samples.importance[half];
  }
}

void RowSampler::SampleExtinctionBehind(Field field)
{
  this->SampleBehind(field, this->Samples.extinction[0]);
  this->Rays.extinction[0] = this->Rays.extinction[1] = this->Samples.extinction[0];
}

void RowSampler::SampleNothing()
{
  for (int half = 0; half < 2; ++half)
  {
    std::fill(this->Samples.extinction[half] + this->Rays.columns.begin,
      this->Samples.extinction[half] + this->Rays.columns.end, 0.0f);
    this->Rays.extinction[half] = this->Samples.extinction[half];
  }
}

void RowSampler::SampleFrontImportance(Field field)
{
  this->SamplePlane(RowsOfField{ field }, 0, this->Samples.importance[0]);
  this->HideOutOfView(this->Samples.importance[0]);
  this->Rays.importance[0] = this->Samples.importance[0];
}

void RowSampler::SampleRearImportance(Field field)
{
  float* rear = this->States()[RayChannel::RearImportance];
  this->SamplePlane(RowsOfField{ field }, 1, rear);
  this->HideOutOfView(rear);
  this->Rays.importance[0] = this->Rays.importance[1] = rear;
}

void RowSampler::SampleKept(Field extinction, Field base)
{
  const Range<int> columns = this->Rays.columns;
  const Range<int> important = Hull(ColumnsAboveZero(this->Rays.importance[0], columns),
    ColumnsAboveZero(this->Rays.importance[1], columns));
  for (int half = 0; half < 2; ++half)
  {
    float* kept = this->Samples.kept[half];
    std::fill(kept + columns.begin, kept + columns.end, 0.0f); // outside `important` it is not used
    this->Rays.kept[half] = kept;
  }
  if (!important.Empty())
  {
    this->Rays.columns = important;
    this->SamplePlanes(RowsOfLesser{ extinction, base, this->Samples.lesser }, this->Samples.kept);
    this->Rays.columns = columns;
  }
}

void RowSampler::SampleAlternative(Field extinction)
{
  this->SamplePlanes(RowsOfField{ extinction }, this->Samples.kept);
  this->Rays.kept[0] = this->Samples.kept[0];
  this->Rays.kept[1] = this->Samples.kept[1];
}

bool RowSampler::SelectBeside(int s)
{
  const int behind = std::min(s + 1, this->Frustum.lastSlice);
  this->Rays.columns = Hull(this->Frustum.ActiveRays(s, this->RowNumber),
    this->Frustum.ActiveRays(behind, this->RowNumber));
  return !this->Rays.columns.Empty();
}

float RowSampler::LongestWay(const Range<int>& columns) const
{
  // The length of a ray grows with its slope, so it is largest at one of the ends.
  return columns.Empty() ? 0.0f
                         : this->Rays.layer.thickness *
      std::max(this->Rays.length[columns.begin], this->Rays.length[columns.end - 1]);
}

bool RowSampler::HasAbove(const Range<int>& columns, float bound) const
{
  return AnyAbove(this->Rays.extinction[0], columns, bound) ||
    AnyAbove(this->Rays.extinction[1], columns, bound);
}

RowSampler::LayerPlace RowSampler::PlaceAt(float share, int column) const
{
  const Slice& slice = this->Frustum.SliceAt(this->S);
  const double depth = this->Rays.layer.front + double(share) * this->Rays.layer.thickness;
  return { slice.nodes,
    NodesAt(
      this->Frustum.Row(this->Frustum.rowLines)[this->RowNumber].At(depth), this->Frustum.nodesV),
    NodesAt(this->Frustum.Row(this->Frustum.columnLines)[column].At(depth), this->Frustum.nodesU),
    slice.FractionAt(share) };
}

PointSample RowSampler::SampleAt(const RayFields<Field>& fields, float share, int column) const
{
  const LayerPlace place = this->PlaceAt(share, column);
  const auto extinction = ValuesOf(fields.extinction);
  const float inView = this->Frustum.seesAll
    ? 1.0f
    : this->Frustum.OfRow(this->Frustum.inView, this->RowNumber)[column];
  const auto lesser = [&](int node, int row, int at)
  { return std::min(extinction(node, row, at), ValuesOf(fields.base)(node, row, at)); };
  PointSample found;
  found.extinction = place.Blend(extinction);
  found.importance = inView * place.Blend(ValuesOf(fields.importance));
  found.kept = fields.base ? place.Blend(lesser) : found.extinction;
  return found;
}

void RowSampler::SampleLeast(Field extinction)
{
  if (extinction)
  {
    this->SampleAlternative(extinction);
    return;
  }
  for (int half = 0; half < 2; ++half)
  {
    std::fill(this->Samples.kept[half] + this->Rays.columns.begin,
      this->Samples.kept[half] + this->Rays.columns.end, 0.0f);
    this->Rays.kept[half] = this->Samples.kept[half];
  }
}

bool RowSampler::SelectReadBySlice(int s, bool entered, const Range<int>& dimmed)
{
  const Slice& slice = this->Frustum.SliceAt(s);
  if (slice.node < 0)
  {
    return false; // no voxels read rays at the source
  }
  const Range<int> sampled = entered ? this->Rays.columns : Range<int>{};
  const Range<int> rows =
    ReadByCubics(this->Frustum.Row(this->Frustum.voxelRows, s), slice.ownedRows, slice.rayRows);
  const Range<int> read = ReadByCubics(
    this->Frustum.Row(this->Frustum.voxelColumns, s), slice.ownedColumns, slice.rayColumns);
  this->Rays.columns = Intersection(read, Hull(sampled, dimmed));
  if (!rows.Contains(this->RowNumber) || this->Rays.columns.Empty())
  {
    return false;
  }
  if (!entered)
  {
    this->Rays.layer = slice.layer;
    this->SampleNothing();
    return true;
  }
  const Range<int>& told = this->Rays.columns;
  float* extinction = this->Samples.extinction[0];
  std::fill(extinction + told.begin, extinction + std::max(told.begin, sampled.begin), 0.0f);
  std::fill(extinction + std::min(told.end, sampled.end), extinction + told.end, 0.0f);
  return true;
}

/// A voxel beside a ray that enters through a side interpolates up to three rays that enter in
/// front.
Range<int> RowSampler::ColumnsFarFromSides() const
{
  constexpr int reach = 3;
  const Range<int>& columns = this->Rays.columns;
  const Range<int>& rows = this->Frustum.frontRows;
  const Range<int> front{ this->Frustum.frontColumns.begin + reach,
    this->Frustum.frontColumns.end - reach };
  const bool nextToSide =
    this->RowNumber < rows.begin + reach || this->RowNumber >= rows.end - reach;
  return nextToSide || front.Empty() ? Range<int>{ columns.end, columns.end } : front;
}

void RowSampler::HideOutOfView(float* importance) const
{
  if (!this->Frustum.seesAll)
  {
    MultiplyRow(
      importance, this->Frustum.OfRow(this->Frustum.inView, this->RowNumber), this->Rays.columns);
  }
}

/// Samples the slice behind where the rays meet the plane of the rear Gauss point.
void RowSampler::SampleBehind(Field field, float* out)
{
  const int plane = 2 * this->S + 1;
  const LinearMap columns = this->Frustum.PlaneColumns(plane);
  const LinearMap rows = this->Frustum.PlaneRows(plane);
  const Range<int> read = ColumnsRead(columns, this->Rays.columns, *field);
  this->Prefetch(field, read);
  const FourRows four = RowsOfField{ field }.At(
    this->Frustum.SliceAt(this->S).nodes, rows.index[this->RowNumber], read);
  BlendRows(four.rows[1][0], four.rows[1][1], rows.weight[this->RowNumber], read.begin, read.end,
    this->Samples.blend[0]);
  InterpolateRow(this->Samples.blend[0], columns, this->Rays.columns, out);
}
}
