// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/ViewScore.h"

#include "backend/Backend.h"
#include "viewpoint/TurnRow.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
/// A move of the eye along the axes of a pyramid: u, v, depth [index].
struct Move
{
  double u;
  double v;
  double depth;
};

/// +1 or -1: whether depth grows with the index along the pyramid's depth axis.
double SignOf(const Pyramid& pyramid)
{
  const std::size_t last = pyramid.stations.size() - 1;
  return pyramid.stations[last].slice > pyramid.stations[last - 1].slice ? 1 : -1;
}

/// The forward sweep of one pyramid that follows two moves of the eye.
class TurnVisitor
{
public:
  /// `moves`: of the eye, across the way of length `distance` to the focal point [length].
  TurnVisitor(const ViewFields::Part& part, const Vec3 moves[2], double distance)
    : Source(part.pyramid)
    , Images(part.pyramid)
    , Extinction(part.pyramid, part.fields->grid, part.fields->extinction.data())
    , Importance(part.pyramid, part.fields->grid, part.fields->importance.data())
  {
    const Pyramid& pyramid = part.pyramid;
    const Eye& eye = part.eye;
    const double sign = SignOf(pyramid);
    const Station& first = pyramid.stations[std::size_t(pyramid.FirstSlice())];
    this->Distance.parallel = eye.parallel;
    this->Distance.front = pyramid.FrontDepth();
    this->Distance.depth = static_cast<float>(first.depth);
    this->Distance.inverse = static_cast<float>(1 / distance);
    for (int m = 0; m < 2; ++m)
    {
      const Vec3 move = part.fields->grid.DirectionToIndex(moves[m]);
      this->Moves[m] = { move[pyramid.axisU], move[pyramid.axisV], sign * move[pyramid.axisW] };
      this->Sides[m].assign(std::size_t(pyramid.RayCount()), 0.0f);
      this->Along[m].assign(std::size_t(pyramid.RayCount()), 0.0f);
      this->Push[m].assign(std::size_t(pyramid.RayCount()), 0.0f);
      this->Moment[m].assign(std::size_t(pyramid.RayCount()), 0.0f);
      this->Gain[m].assign(std::size_t(pyramid.RayCount()), 0.0f);
    }
    this->PlaceMoves(eye);
  }

  void Load(const Slab& slab)
  {
    this->Extinction.Load(slab, 1);
    this->Importance.Load(slab, 1);
  }

  void Row(const Slab& slab, int row)
  {
    const std::size_t columns = std::size_t(this->Source.columns);
    const std::size_t first = std::size_t(row) * columns;
    const std::size_t scratch = ScratchSize(this->Source);
    float* memory = ThreadScratch(8 * columns + 3 * scratch);
    for (int s = slab.begin; s < std::min(slab.end, this->Source.LastStation()); ++s)
    {
      RayRow rays = RaysOf(this->Source, this->Images, s, row);
      if (rays.work.Empty())
      {
        continue;
      }
      EyeMove moves[2];
      for (int m = 0; m < 2; ++m)
      {
        const double slope = this->Source.rowAxis.slope[std::size_t(row)];
        moves[m].side = this->Sides[m].data() + first;
        moves[m].along = this->Along[m].data() + first;
        moves[m].row = slope != 0 ? static_cast<float>(this->Moves[m].v / slope) : 0.0f;
        const bool atEye = this->Source.stations.front().slice < 0;
        moves[m].front = atEye ? 0.0f : static_cast<float>(this->Moves[m].depth);
        moves[m].push = this->Push[m].data() + first;
        moves[m].moment = this->Moment[m].data() + first;
        moves[m].gain = this->Gain[m].data() + first;
      }
      for (int half = 0; half < 2; ++half)
      {
        const Plane& plane = this->Source.stations[std::size_t(s)].planes[std::size_t(half)];
        float* samples = memory + std::size_t(half) * columns;
        float* importances = memory + std::size_t(half + 2) * columns;
        float* slopes[2] = { memory + std::size_t(4 + half) * columns,
          memory + std::size_t(6 + half) * columns };
        this->Sample(plane, row, rays.work, memory + 8 * columns, samples, slopes);
        SamplePlane(
          plane, row, rays.work, Slices::Both, this->Importance, memory + 8 * columns, importances);
        rays.extinction[half] = samples;
        rays.importance[half] = importances;
        moves[0].slope[half] = slopes[0];
        moves[1].slope[half] = slopes[1];
      }
      ForwardTurnRow(rays, this->Distance, moves, this->Images.opticalDepth.data() + first,
        this->Images.behind.data() + first, this->Images.plain.data() + first);
    }
  }

  Visible Score() const
  {
    return { SumOfRays(this->Source, this->Images, this->Images.behind.data()),
      SumOfRays(this->Source, this->Images, this->Images.plain.data()) };
  }

  double Slope(int move) const
  {
    return -SumOfRays(this->Source, this->Images, this->Gain[move].data());
  }

private:
  void PlaceMoves(const Eye& eye)
  {
    const Vec3& h = this->Source.spacing;
    for (int row = 0; row < this->Source.rows; ++row)
    {
      const double b = this->Source.rowAxis.slope[std::size_t(row)];
      for (int column = 0; column < this->Source.columns; ++column)
      {
        const std::size_t ray = std::size_t(row) * this->Source.columns + column;
        const double a = this->Source.columnAxis.slope[std::size_t(column)];
        const double length = this->Images.length[ray];
        for (int m = 0; m < 2; ++m)
        {
          const Move& e = this->Moves[m];
          this->Sides[m][ray] = a != 0 ? static_cast<float>(e.u / a * length) : 0.0f;
          const double along = a * h.x * e.u * h.x + b * h.y * e.v * h.y + h.z * e.depth * h.z;
          this->Along[m][ray] = eye.parallel ? 0.0f : static_cast<float>(along / (length * length));
        }
      }
    }
  }

  /// Extinction and its derivatives by the two moves at the rays of a plane. `memory`: three times
  /// ScratchSize(pyramid) values.
  void Sample(const Plane& plane, int row, const Interval& columns, float* memory, float* out,
    float* const slopes[2])
  {
    const auto r = std::size_t(row);
    const int v = plane.rayRows.index[r];
    const float across = plane.rayRows.weight[r];
    const Interval read =
      FilledRegisters({ plane.rayColumns.index[std::size_t(columns.begin)],
                        plane.rayColumns.index[std::size_t(columns.end) - 1] + 2 },
        { 0, this->Extinction.ColumnCount() });
    const float* rows[2][2] = { { this->Extinction.Row(plane.slices[0], v),
                                  this->Extinction.Row(plane.slices[0], v + 1) },
      { this->Extinction.Row(plane.slices[1], v), this->Extinction.Row(plane.slices[1], v + 1) } };
    const std::size_t size = ScratchSize(this->Source);
    float* blend = memory;
    float* steps = memory + size;
    float* moved = memory + 2 * size;
    BlendFourRows(rows, across, plane.fraction, read.begin, read.end, blend);
    DifferRow(blend, read.begin, read.end, steps);
    InterpolateRow(blend, plane.rayColumns, columns, out);
    for (int m = 0; m < 2; ++m)
    {
      const RowMove move{ static_cast<float>(this->Moves[m].v),
        static_cast<float>(this->Moves[m].depth) };
      DifferFourRows(rows, across, plane.fraction, move, read.begin, read.end, moved);
      InterpolateRow(moved, plane.rayColumns, columns, slopes[m]);
      AddSteps(plane.rayColumns, steps, static_cast<float>(this->Moves[m].u), columns, slopes[m]);
    }
  }

  const Pyramid& Source;
  RayImages Images;
  SliceWindow Extinction;
  SliceWindow Importance;
  EyeDistance Distance{};
  Move Moves[2];
  std::vector<float> Sides[2];
  std::vector<float> Along[2];
  std::vector<float> Push[2];
  std::vector<float> Moment[2];
  std::vector<float> Gain[2];
};
}

namespace
{
/// Rays across the longest side of a grid, at least. S is an integral over a picture, whose outline
/// the rays of a small grid would miss by more than half a percent.
constexpr double fewestRays = 96;
}

ViewScore::ViewScore(
  const Grid& grid, const float* extinction, const float* importance, double rayDensity)
  : Fields(grid, extinction, importance)
  , RayDensity(
      std::max(rayDensity, fewestRays / std::max({ grid.nodes.x, grid.nodes.y, grid.nodes.z, 1 })))
{
}

Visible ViewScore::At(const Camera& camera) const
{
  Visible sum;
  for (const ViewFields::Part& part : this->Fields.PartsOf(camera, this->RayDensity))
  {
    RayImages images(part.pyramid);
    const Visible score = SweepForward(part.pyramid, part.fields->grid,
      part.fields->extinction.data(), part.fields->importance.data(), images);
    sum.visible += score.visible;
    sum.plain += score.plain;
  }
  return sum;
}

ViewSlope ViewScore::SlopeAt(const Camera& camera) const
{
  const Vec3 way = camera.focalPoint - camera.position;
  const double distance = glm::length(way);
  const Vec3 forward = way / distance;
  const Vec3 right =
    glm::normalize(glm::cross(forward, std::abs(forward.x) < 0.7 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
  const Vec3 moves[2] = { right, glm::cross(right, forward) };

  constexpr Index rowsPerTask = 4;
  ViewSlope result;
  for (const ViewFields::Part& part : this->Fields.PartsOf(camera, this->RayDensity))
  {
    TurnVisitor visitor(part, moves, distance);
    for (const Slab& slab : SlabsOf(part.pyramid))
    {
      visitor.Load(slab);
      ParallelFor(part.pyramid.rows, rowsPerTask, [&](Index row) { visitor.Row(slab, int(row)); });
    }
    const Visible score = visitor.Score();
    result.score.visible += score.visible;
    result.score.plain += score.plain;
    result.slope += visitor.Slope(0) * moves[0] + visitor.Slope(1) * moves[1];
  }
  return result;
}
}
