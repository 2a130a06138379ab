// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What the rule of quadrature along a ray is worth: S by a simple scorer, rule by rule, with the
// same rays, samples by trilinear interpolation, and clipping at the sides of the box.

#include "Errors.h"
#include "PlanSweep.h"

#include "PaperScheme/Launch.h"
#include "PaperScheme/Views.h"
#include "sweep/HalfLayer.h"

#include <cmath>

namespace limpid::benchmark
{
namespace
{
/// An end or the middle of a piece of a ray.
struct Place
{
  float extinction;
  float importance;
  float scale; ///< width of the ray there, see Slice::scale
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

  static void Add(float length, const Place& front, const Place&, RayIntegral& sum)
  {
    const float depth = front.extinction * length;
    sum.visible += double(sum.Passing() * front.importance * depth * front.scale * front.scale);
    sum.opticalDepth += depth;
  }
};

/// The mean of the integrand at both ends.
struct Trapezoid
{
  static constexpr bool atEnds = true;

  static void Add(float length, const Place& front, const Place& back, RayIntegral& sum)
  {
    const float atFront =
      sum.Passing() * front.importance * front.extinction * front.scale * front.scale;
    sum.opticalDepth += 0.5f * length * (front.extinction + back.extinction);
    const float atBack =
      sum.Passing() * back.importance * back.extinction * back.scale * back.scale;
    sum.visible += double(0.5f * length * (atFront + atBack));
  }
};

/// Extinction linear in depth and importance linear in optical depth, integrated exactly.
struct ConservativeLinear
{
  static constexpr bool atEnds = true;

  static void Add(float length, const Place& front, const Place& back, RayIntegral& sum)
  {
    const float x = 0.5f * length * (front.extinction + back.extinction);
    const float stopped = x < 0.02f ? x * (1 - x * (0.5f - x / 6)) : -std::expm1(-x);
    const float ofBack =
      x < 0.02f ? x * (0.5f - x * (1.0f / 3 - x / 8)) : (stopped - x * (1 - stopped)) / x;
    const float atFront = front.importance * front.scale * front.scale;
    const float atBack = back.importance * back.scale * back.scale;
    sum.visible += double(sum.Passing() * ((stopped - ofBack) * atFront + ofBack * atBack));
    sum.opticalDepth += x;
  }
};

/// Limpid's: constant halves about the two Gauss points, whose fields both places have.
struct TwoGaussPoints
{
  static constexpr bool atEnds = false;

  static void Add(float length, const Place& front, const Place& back, RayIntegral& sum)
  {
    const HalfLayer<float> half(
      length, front.extinction, front.importance, front.scale, back.scale);
    sum.visible += double(sum.Passing() * half.visible);
    sum.opticalDepth += half.opticalDepth;
  }
};

/// One index is one ray of the frustum; it writes its own integral and nothing else.
template <class Rule>
struct QuadratureRay
{
  const PlannedFrustum& frustum;
  reference::FieldView<float> extinction; ///< [1/length]
  reference::FieldView<float> importance; ///< [0, 1]
  int steps;                              ///< per layer
  double* visible;                        ///< one per ray [scale^2]

  void operator()(Index ray) const
  {
    const int column = static_cast<int>(ray % frustum.columns);
    const int row = static_cast<int>(ray / frustum.columns);
    const Range<float> inColumn = frustum.StayOfColumn(column);
    const Range<float> inRow = frustum.StayOfRow(row);
    const float enter = std::max(inColumn.begin, inRow.begin);
    const float leave = std::min(inColumn.end, inRow.end);
    const float length = frustum.Row(frustum.length)[ray];
    constexpr int parts = Rule::atEnds ? 1 : 2;

    RayIntegral sum;
    Place before{};
    float reached = -1; // relative depth of `before`
    for (int piece = 0; piece < frustum.lastSlice * steps * parts; ++piece)
    {
      const int step = piece / parts;
      const Slice& front = frustum.SliceAt(step / steps);
      const Slice& back = frustum.SliceAt(step / steps + 1);
      const float thickness = (back.RelativeDepth() - front.RelativeDepth()) / float(steps);
      const float start = front.RelativeDepth() + float(step % steps) * thickness;
      const float size = thickness / parts;
      const float begin = std::max(start + float(piece % parts) * size, enter);
      const float end = std::min(start + float(piece % parts + 1) * size, leave);
      if (!(begin < end))
      {
        continue;
      }
      const float slope =
        (back.scale - front.scale) / (back.RelativeDepth() - front.RelativeDepth());
      const auto place = [&](float depth, float ofFields) {
        return At(
          column, row, front, ofFields, front.scale + slope * (depth - front.RelativeDepth()));
      };
      const float middle = start + float(gaussPoints[piece % 2]) * thickness;
      const Place near =
        Rule::atEnds && reached == begin ? before : place(begin, Rule::atEnds ? begin : middle);
      Place far = near;
      far.scale = front.scale + slope * (end - front.RelativeDepth());
      if (Rule::atEnds)
      {
        far = place(end, end);
      }
      Rule::Add((end - begin) * length, near, far, sum);
      before = far;
      reached = end;
    }
    visible[ray] = sum.visible;
  }

  /// The fields on a ray at a relative depth.
  Place At(int column, int row, const Slice& front, float relativeDepth, float scale) const
  {
    const double depth = front.depth + double(relativeDepth - front.RelativeDepth());
    const double sign = frustum.SliceAt(0).node <= frustum.SliceAt(frustum.lastSlice).node ? 1 : -1;
    const Slice& last = frustum.SliceAt(frustum.lastSlice);
    reference::Vec3Of<float> position;
    position[frustum.axisU] =
      float(frustum.lateralU.Position(frustum.lateralU.Coordinate(column), depth));
    position[frustum.axisV] =
      float(frustum.lateralV.Position(frustum.lateralV.Coordinate(row), depth));
    position[frustum.axisW] = float(last.node - sign * (last.depth - depth));
    const auto place = reference::LocateInNodes(extinction.nodes, position);
    return { reference::Interpolate(extinction.values, place),
      reference::Interpolate(importance.values, place), scale };
  }
};

template <class Rule>
double ScoreOf(const SceneOfFile& scene, const std::vector<PlannedFrustum>& frusta,
  const std::vector<float>& extinction, int steps)
{
  double score = 0;
  for (const PlannedFrustum& frustum : frusta)
  {
    std::vector<double> visible(std::size_t(frustum.RayCount()));
    reference::Launch(frustum.RayCount(),
      QuadratureRay<Rule>{ frustum, { extinction.data(), scene.grid.nodes },
        { scene.importance.data(), scene.grid.nodes }, steps, visible.data() });
    for (int row = 0; row < frustum.rows; ++row)
    {
      for (int column = 0; column < frustum.columns; ++column)
      {
        score += visible[std::size_t(row) * frustum.columns + column] *
          frustum.Row(frustum.columnShare)[column] * frustum.Row(frustum.rowShare)[row] /
          double(frustum.OfRow(frustum.length, row)[column]) * frustum.cellMeasure;
      }
    }
  }
  return score;
}

template <class Rule>
Json Measure(
  const Truth& truth, const std::vector<PlannedFrustum>& frusta, const char* name, int steps)
{
  double scores[2] = { 0, 0 };
  std::vector<double> times;
  for (int which = 0; which < 2; ++which)
  {
    Stopwatch watch;
    scores[which] = ScoreOf<Rule>(truth.Source(), frusta, truth.Extinction(which), steps);
    times.push_back(watch.Lap());
  }
  Json result{ { "rule", name }, { "steps", steps }, { "seconds", Median(times) } };
  truth.AddErrors(result, scores[0], scores[1]);
  return result;
}
}

Json MeasureQuadratures(const Truth& truth, const Effort& effort)
{
  const SceneOfFile& scene = truth.Source();
  const Occupancy everything(scene.grid, scene.extinction.data(), scene.importance.data(), false);
  const std::vector<PlannedFrustum> frusta = PlanSweep(scene.grid, everything,
    SourceOfCamera(scene.camera, scene.grid, false), { effort.quadratureRays });
  Json results;
  for (const int steps : effort.quadratureSteps)
  {
    results.push_back(Measure<LeftRiemann>(truth, frusta, "left Riemann", steps));
    results.push_back(Measure<Trapezoid>(truth, frusta, "trapezoid", steps));
    results.push_back(Measure<ConservativeLinear>(truth, frusta, "conservative linear", steps));
    results.push_back(Measure<TwoGaussPoints>(truth, frusta, "two Gauss points", steps));
  }
  return results;
}
}
