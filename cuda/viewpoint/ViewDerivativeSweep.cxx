// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/ViewDerivativeSweep.h"

#include "backend/Backend.h"
#include "sweep/Registers.h"
#include "sweep/RowInterpolation.h"
#include "viewpoint/ViewDerivativeRow.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
/// What travels with the rays for one move of the eye, one value per ray, and its constants.
struct ViewDerivativeImages
{
  Vec3 move; ///< along u, v, depth [index]
  std::vector<float> side;
  std::vector<float> along;
  std::vector<float> integral;
  std::vector<float> moment;
  std::vector<float> gain;
};

class ViewDerivativeVisitor
{
public:
  ViewDerivativeVisitor(
    const ViewFields::Part& part, const Vec3 moves[2], double distance, double rayDensity)
    : Source(part.frustum)
    , Planes(part.frustum, std::max(1, static_cast<int>(std::lround(rayDensity))))
    , OpticalDepth(std::size_t(part.frustum.RayCount()), 0.0)
    , Visible(std::size_t(part.frustum.RayCount()), 0.0f)
    , Unattenuated(std::size_t(part.frustum.RayCount()), 0.0f)
    , Extinction(part.frustum, nullptr, this->Slabs, part.fields->extinction.data(), { 1 })
    , Importance(part.frustum, nullptr, this->Slabs, part.fields->importance.data(), { 1 })
  {
    const PlannedFrustum& frustum = part.frustum;
    for (int column = 0; column < frustum.columns; ++column)
    {
      this->ColumnSlopes.push_back(static_cast<float>(frustum.lateralU.Slope(column)));
    }
    const Slice& first = frustum.SliceAt(frustum.firstNodeSlice);
    this->Distance.parallel = part.eye.parallel;
    this->Distance.slope = this->ColumnSlopes.data();
    this->Distance.front = frustum.frontDepth;
    this->Distance.depth = static_cast<float>(first.depth);
    this->Distance.inverse = static_cast<float>(1 / distance);
    const int* nodes = frustum.SliceAt(0).nodes;
    const double sign = nodes[1] - nodes[0]; // whether depth grows with the index
    for (int m = 0; m < 2; ++m)
    {
      const Vec3 move = part.fields->grid.DirectionToIndex(moves[m]);
      this->Place(
        { move[frustum.axisU], move[frustum.axisV], sign * move[frustum.axisW] }, this->Moves[m]);
    }
  }

  void Load(const Range<int>& slab)
  {
    this->Extinction.Load(slab);
    this->Importance.Load(slab);
  }

  void Row(const Range<int>& slab, int row)
  {
    const std::size_t first = std::size_t(row) * this->Source.columns;
    EyeMove moves[2] = { this->MoveOf(0, row), this->MoveOf(1, row) };
    float* memory = ThreadScratch(SampleCount * this->Pitch() +
      RowScratch(std::max(this->Source.nodesU, this->Source.columns)));
    RayRow rays{};
    rays.EnterRow(this->Source, row);
    for (int s = slab.begin; s < std::min(slab.end, this->Source.lastSlice); ++s)
    {
      if (!rays.EnterLayer(this->Source, s, row))
      {
        continue;
      }
      const Layer whole = rays.layer;
      for (int part = 0; part < this->Planes.Parts(); ++part)
      {
        rays.layer = PartOf(whole, part, this->Planes.Parts());
        const RowSlopes slopes = this->Sample(s, part, row, memory, rays);
        ForwardViewDerivativeRow(rays, slopes, this->Distance, moves,
          this->OpticalDepth.data() + first, this->Visible.data() + first,
          this->Unattenuated.data() + first);
      }
    }
  }

  ViewDerivative Result() const
  {
    ViewDerivative result;
    result.score = { SumOfRays(this->Source, this->Visible.data()),
      SumOfRays(this->Source, this->Unattenuated.data()) };
    for (int m = 0; m < 2; ++m)
    {
      result.slope[m] = -SumOfRays(this->Source, this->Moves[m].gain.data());
    }
    return result;
  }

private:
  static constexpr std::size_t SampleCount = 9; // rows of samples of a layer

  /// Values per row of samples: also of those between the rays.
  std::size_t Pitch() const { return std::size_t(this->Source.columns) + 3; }

  /// A part ends with the very number that the next one begins with: a ray that enters the box
  /// between two parts would else enter neither, or both.
  static Layer PartOf(const Layer& whole, int part, int parts)
  {
    const auto depthOf = [&](int number)
    {
      const float share = static_cast<float>(number) / static_cast<float>(parts);
      return number == parts ? whole.front + whole.thickness
                             : whole.front + share * whole.thickness;
    };
    const float share = 1.0f / static_cast<float>(parts);
    const float before = share * static_cast<float>(part);
    const float widening = whole.backScale - whole.frontScale;
    const float front = depthOf(part);
    return { front, depthOf(part + 1) - front, whole.frontScale + before * widening,
      whole.frontScale + (before + share) * widening };
  }

  void Place(const Vec3& move, ViewDerivativeImages& derivative) const
  {
    derivative.move = move;
    const auto count = std::size_t(this->Source.RayCount());
    for (std::vector<float>* image : { &derivative.side, &derivative.along, &derivative.integral,
           &derivative.moment, &derivative.gain })
    {
      image->assign(count, 0.0f);
    }
    const Vec3& h = this->Source.spacing;
    for (std::size_t ray = 0; ray < count; ++ray)
    {
      const double a =
        this->Source.lateralU.Slope(static_cast<int>(ray % std::size_t(this->Source.columns)));
      const double b =
        this->Source.lateralV.Slope(static_cast<int>(ray / std::size_t(this->Source.columns)));
      const double u = move.x - a * move.z;
      const double v = move.y - b * move.z;
      const double length = this->Source.Row(this->Source.length)[ray];
      derivative.side[ray] = a != 0 ? static_cast<float>(u / a * length) : 0.0f;
      derivative.along[ray] =
        static_cast<float>((a * h.x * u * h.x + b * h.y * v * h.y) / (length * length));
    }
  }

  EyeMove MoveOf(int m, int row)
  {
    ViewDerivativeImages& derivative = this->Moves[m];
    const std::size_t first = std::size_t(row) * this->Source.columns;
    const double slope = this->Source.lateralV.Slope(row);
    const double down = derivative.move.y - slope * derivative.move.z;
    const bool atEye = this->Source.SliceAt(0).node < 0;
    EyeMove move{};
    move.across = static_cast<float>(derivative.move.x);
    move.down = static_cast<float>(down);
    move.depth = static_cast<float>(derivative.move.z);
    move.along = derivative.along.data() + first;
    move.side = derivative.side.data() + first;
    move.row = slope != 0 ? static_cast<float>(down / slope) : 0.0f;
    // An eye in the medium that moves on along a ray leaves some of it behind.
    move.front = atEye ? static_cast<float>(-derivative.move.z) : 0.0f;
    move.integral = derivative.integral.data() + first;
    move.moment = derivative.moment.data() + first;
    move.gain = derivative.gain.data() + first;
    return move;
  }

  /// Samples a part of the layer behind slice `s`.
  RowSlopes Sample(int s, int part, int row, float* memory, RayRow& rays)
  {
    RowSlopes slopes{};
    const std::size_t pitch = this->Pitch();
    float* scratch = memory + SampleCount * pitch;
    for (int half = 0; half < 2; ++half)
    {
      const ViewDerivativePlane& plane = this->Planes.At(s, part, half);
      float* extinction = memory + std::size_t(half) * pitch;
      float* importance = memory + std::size_t(half + 2) * pitch;
      float* across = memory + std::size_t(half + 4) * pitch;
      float* down = memory + std::size_t(half + 6) * pitch;
      float* between = memory + 8 * pitch;
      const Range<int> read = this->ReadBy(plane, rays.columns);
      this->Blend(this->Importance, plane, row, read, scratch);
      InterpolateRow(scratch, plane.columns.View(), rays.columns, importance);
      this->Blend(this->Extinction, plane, row, read, scratch);
      InterpolateRow(scratch, plane.columns.View(), rays.columns, extinction);
      InterpolateRow(
        scratch, plane.between.View(), { rays.columns.begin, rays.columns.end + 3 }, between);
      const std::array<std::vector<float>, 4>& weights = this->Planes.Columns().Weights;
      const float* perColumn[4] = { weights[0].data(), weights[1].data(), weights[2].data(),
        weights[3].data() };
      DifferRow(between, perColumn, plane.perIndex, rays.columns, across);
      this->Differ(this->Extinction, plane, row, read, scratch);
      InterpolateRow(scratch, plane.columns.View(), rays.columns, down);
      rays.extinction[half] = extinction;
      rays.importance[half] = importance;
      slopes.across[half] = across;
      slopes.down[half] = down;
    }
    return slopes;
  }

  /// Voxel columns that rays and the places between them read.
  Range<int> ReadBy(const ViewDerivativePlane& plane, const Range<int>& columns)
  {
    const std::vector<int>& index = plane.between.index;
    return WholeRegisters(
      { index[std::size_t(columns.begin)], index[std::size_t(columns.end) + 2] + 2 },
      { 0, this->Extinction.ColumnCount() });
  }

  void Blend(SliceWindow& field, const ViewDerivativePlane& plane, int row, const Range<int>& read,
    float* out) const
  {
    const RowPlace place = this->Planes.RowAt(plane, row);
    const int v = place.row;
    const float* rows[2][2] = { { field.Row(plane.nodes[0], v), field.Row(plane.nodes[0], v + 1) },
      { field.Row(plane.nodes[1], v), field.Row(plane.nodes[1], v + 1) } };
    BlendFourRows(rows, place.weight, plane.fraction, read.begin, read.end, out);
  }

  /// The derivative across the rows, of voxel columns.
  void Differ(SliceWindow& field, const ViewDerivativePlane& plane, int row, const Range<int>& read,
    float* out) const
  {
    const RowStencil stencil = this->Planes.StencilOf(plane, row);
    for (int v = stencil.row[0]; v <= stencil.row[3] + 1; ++v)
    {
      AddRow(field.Row(plane.nodes[0], v), field.Row(plane.nodes[1], v), plane.fraction,
        stencil.FactorOf(v), v == stencil.row[0], read.begin, read.end, out);
    }
  }

  const PlannedFrustum& Source;
  ViewDerivativePlanes Planes;
  std::vector<double> OpticalDepth;
  std::vector<float> Visible;
  std::vector<float> Unattenuated;
  SlabPool Slabs;
  SliceWindow Extinction;
  SliceWindow Importance;
  std::vector<float> ColumnSlopes;
  EyeDistance Distance{};
  ViewDerivativeImages Moves[2];
};
}

ViewDerivative SweepViewDerivative(
  const ViewFields::Part& part, const Vec3 moves[2], double distance, double rayDensity)
{
  constexpr Index rowsPerTask = 4;
  ViewDerivativeVisitor visitor(part, moves, distance, rayDensity);
  for (const Range<int>& slab : SlabsOf(part.frustum))
  {
    visitor.Load(slab);
    ParallelFor(part.frustum.rows, rowsPerTask, [&](Index row) { visitor.Row(slab, int(row)); });
  }
  return visitor.Result();
}
}
