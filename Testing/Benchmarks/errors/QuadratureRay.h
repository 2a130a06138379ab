// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// One ray of a frustum with one of four rules of quadrature, for comparison: same rays, same
// samples by trilinear interpolation, same clipping at the sides of the box. Only the rule differs.

#ifndef limpid_testing_benchmarks_errors_QuadratureRay_h
#define limpid_testing_benchmarks_errors_QuadratureRay_h

#include "PaperScheme/Views.h"
#include "sweep/HalfLayer.h"
#include "sweep/Plan.h"

#include <cmath>

namespace limpid::benchmark
{
/// A piece of a ray, and what has passed it so far. Lengths are world lengths.
struct RaySegment
{
  float length;
  float frontScale; ///< width of the ray at its front, see Slice::scale
  float backScale;
};

/// Extinction and importance at a place.
struct RaySample
{
  float extinction;
  float importance;
};

/// Integral of importance x extinction x transmittance x scale^2 along a ray, piece by piece.
struct RayIntegral
{
  float opticalDepth = 0;
  double visible = 0;

  float Passing() const { return std::exp(-this->opticalDepth); }
};

/// Eqs. 17 to 20: everything is as at the front of the piece.
struct LeftRiemann
{
  static constexpr bool atEnds = true;

  static void Add(
    const RaySegment& segment, const RaySample& front, const RaySample&, RayIntegral& sum)
  {
    const float depth = front.extinction * segment.length;
    sum.visible +=
      double(sum.Passing() * front.importance * depth * segment.frontScale * segment.frontScale);
    sum.opticalDepth += depth;
  }
};

/// The mean of the integrand at both ends.
struct Trapezoid
{
  static constexpr bool atEnds = true;

  static void Add(
    const RaySegment& segment, const RaySample& front, const RaySample& back, RayIntegral& sum)
  {
    const float atFront =
      sum.Passing() * front.importance * front.extinction * segment.frontScale * segment.frontScale;
    sum.opticalDepth += 0.5f * segment.length * (front.extinction + back.extinction);
    const float atBack =
      sum.Passing() * back.importance * back.extinction * segment.backScale * segment.backScale;
    sum.visible += double(0.5f * segment.length * (atFront + atBack));
  }
};

/// Extinction linear in depth and importance linear in optical depth, integrated exactly.
struct ConservativeLinear
{
  static constexpr bool atEnds = true;

  static void Add(
    const RaySegment& segment, const RaySample& front, const RaySample& back, RayIntegral& sum)
  {
    const float x = 0.5f * segment.length * (front.extinction + back.extinction);
    const float stopped = x < 0.02f ? x * (1 - x * (0.5f - x / 6)) : -std::expm1(-x);
    const float ofBack =
      x < 0.02f ? x * (0.5f - x * (1.0f / 3 - x / 8)) : (stopped - x * (1 - stopped)) / x;
    const float atFront = front.importance * segment.frontScale * segment.frontScale;
    const float atBack = back.importance * segment.backScale * segment.backScale;
    sum.visible += double(sum.Passing() * ((stopped - ofBack) * atFront + ofBack * atBack));
    sum.opticalDepth += x;
  }
};

/// Limpid's: constant halves about the two Gauss points.
struct TwoGaussPoints
{
  static constexpr bool atEnds = false;

  static void Add(
    const RaySegment& segment, const RaySample& front, const RaySample&, RayIntegral& sum)
  {
    const HalfLayer<float> half(
      segment.length, front.extinction, front.importance, segment.frontScale, segment.backScale);
    sum.visible += double(sum.Passing() * half.visible);
    sum.opticalDepth += half.opticalDepth;
  }
};

/// One index is one ray of the frustum; it writes its own integral and nothing else.
template <class Rule>
struct QuadratureRay
{
  const FaceFrustum* frustum = nullptr;
  reference::FieldView<float> extinction; ///< [1/length]
  reference::FieldView<float> importance; ///< [0, 1]
  int steps = 1;                          ///< per layer
  double* visible = nullptr;              ///< one per ray [scale^2]

  void operator()(Index ray) const
  {
    const int column = static_cast<int>(ray % frustum->columns);
    const int row = static_cast<int>(ray / frustum->columns);
    const float enter = Deepest(
      frustum->columnAxis.entry[std::size_t(column)], frustum->rowAxis.entry[std::size_t(row)]);
    const float leave = Shallowest(
      frustum->columnAxis.exit[std::size_t(column)], frustum->rowAxis.exit[std::size_t(row)]);
    const float length = frustum->RayLength(column, row);

    RayIntegral sum;
    RaySample before{ 0, 0 };
    float reached = -1; // relative depth of `before`
    for (int s = 0; s < frustum->LastSlice() * steps; ++s)
    {
      const Slice& front = frustum->slices[std::size_t(s / steps)];
      const Slice& back = frustum->slices[std::size_t(s / steps) + 1];
      const float thickness = (back.relativeDepth - front.relativeDepth) / float(steps);
      const float start = front.relativeDepth + float(s % steps) * thickness;
      const float slope = (back.scale - front.scale) / (back.relativeDepth - front.relativeDepth);
      for (int part = 0; part < (Rule::atEnds ? 1 : 2); ++part)
      {
        const float size = Rule::atEnds ? thickness : 0.5f * thickness;
        const float begin = Deepest(start + float(part) * size, enter);
        const float end = Shallowest(start + float(part + 1) * size, leave);
        if (!(begin < end))
        {
          continue;
        }
        const RaySegment segment{ (end - begin) * length,
          front.scale + slope * (begin - front.relativeDepth),
          front.scale + slope * (end - front.relativeDepth) };
        if (Rule::atEnds)
        {
          before = reached == begin ? before : At(column, row, front, begin);
          const RaySample behind = At(column, row, front, end);
          Rule::Add(segment, before, behind, sum);
          before = behind;
          reached = end;
        }
        else
        {
          const RaySample middle =
            At(column, row, front, start + float(gaussPoints[part]) * thickness);
          Rule::Add(segment, middle, middle, sum);
        }
      }
    }
    visible[ray] = sum.visible;
  }

private:
  static float Deepest(float a, float b) { return a > b ? a : b; }
  static float Shallowest(float a, float b) { return a < b ? a : b; }

  /// The fields on a ray at a relative depth.
  RaySample At(int column, int row, const Slice& front, float relativeDepth) const
  {
    const double depth = front.depth + double(relativeDepth - front.relativeDepth);
    const double sign = frustum->slices.front().node <= frustum->slices.back().node ? 1 : -1;
    const Slice& last = frustum->slices.back();
    reference::Vec3Of<float> position;
    position[frustum->axisU] =
      float(frustum->lateralU.Position(frustum->lateralU.Coordinate(column), depth));
    position[frustum->axisV] =
      float(frustum->lateralV.Position(frustum->lateralV.Coordinate(row), depth));
    position[frustum->axisW] = float(last.node - sign * (last.depth - depth));
    const reference::TrilinearPlace<float> place =
      reference::LocateInNodes(extinction.nodes, position);
    return { reference::Interpolate(extinction.values, place),
      reference::Interpolate(importance.values, place) };
  }
};
}

#endif
