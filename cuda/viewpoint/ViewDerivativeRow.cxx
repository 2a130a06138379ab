// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/ViewDerivativeRow.h"

#include "backend/Simd.h"

namespace limpid
{
namespace
{
LIMPID_INLINE float Least(float a, float b)
{
  return a < b ? a : b;
}

LIMPID_INLINE float Most(float a, float b)
{
  return a > b ? a : b;
}

/// The straight line through the samples at the two Gauss points of a layer.
struct Line
{
  float origin; ///< at depth 0 from the front of the layer
  float slope;  ///< [1/index]

  LIMPID_INLINE Line(const Layer& layer, float first, float second)
    : slope((second - first) / (float(gaussPoints[1] - gaussPoints[0]) * layer.thickness))
  {
    this->origin = first - this->slope * (float(gaussPoints[0]) * layer.thickness);
  }

  LIMPID_INLINE float At(float depth) const { return this->origin + depth * this->slope; }
};

/// Depths from the front of a layer: the part of [begin, end] that is inside the box.
LIMPID_INLINE Range<float> Inside(const Range<float>& stay, float begin, float end)
{
  const float first = Least(Most(stay.begin, begin), end);
  return { first, Most(first, Least(stay.end, end)) };
}

LIMPID_INLINE float MiddleOf(const Range<float>& part)
{
  return 0.5f * (part.begin + part.end);
}

/// One half of a layer with its samples; if the ray enters or leaves within, with those in the
/// middle of what is inside.
LIMPID_INLINE HalfLayer<float> HalfOf(const RayRow& rays, int half, const Range<float>& part,
  const Line& extinction, const Line& importance, int i)
{
  const float whole = 0.4999f * rays.layer.thickness;
  const bool cut = part.Length() < whole;
  const float mu = cut ? Most(extinction.At(MiddleOf(part)), 0.0f) : rays.extinction[half][i];
  const float g =
    cut ? Most(Least(importance.At(MiddleOf(part)), 1.0f), 0.0f) : rays.importance[half][i];
  const float widening = (rays.layer.backScale - rays.layer.frontScale) / rays.layer.thickness;
  return HalfLayer<float>(rays.length[i] * part.Length(), mu, g,
    rays.layer.frontScale + widening * part.begin, rays.layer.frontScale + widening * part.end);
}

/// Where light is stopped in a half of the optical depth x, as a share of it: at the Gauss point if
/// x is small, at the front if it is large (HalfLayer.h).
LIMPID_INLINE float StopShare(int half, float x)
{
  constexpr float gauss[2] = { float(2 * gaussPoints[0]), float(2 * gaussPoints[1] - 1) };
  return gauss[half] * 2.0f / (2.0f + x * (1.0f / 3 + x * (1.0f / 18)));
}

struct ViewDerivativeColumn
{
  RayRow rays;
  RowSlopes slopes;
  EyeDistance eye;
  EyeMove moves[2];
  double* opticalDepth;
  float* visible;
  float* unattenuated;

  LIMPID_INLINE void operator()(int i) const
  {
    const Layer& layer = this->rays.layer;
    const float length = this->rays.length[i];
    const float side = Most(this->rays.columnEntry[i], this->rays.row.begin);
    const float entry = Most(side, this->eye.front);
    const Range<float> inside{ entry - layer.front,
      Least(this->rays.columnExit[i], this->rays.row.end) - layer.front };
    const Range<float> halves[2] = { Inside(inside, 0, 0.5f * layer.thickness),
      Inside(inside, 0.5f * layer.thickness, layer.thickness) };
    const Line extinction(layer, this->rays.extinction[0][i], this->rays.extinction[1][i]);
    const Line importance(layer, this->rays.importance[0][i], this->rays.importance[1][i]);
    const HalfLayer<float> sampled[2] = { HalfOf(
                                            this->rays, 0, halves[0], extinction, importance, i),
      HalfOf(this->rays, 1, halves[1], extinction, importance, i) };
    const float tau = static_cast<float>(this->opticalDepth[i]);
    const float transmittance = Attenuate(tau);
    const float gained[2] = { transmittance * sampled[0].visible,
      transmittance * sampled[0].Passed() * sampled[1].visible };
    this->visible[i] += gained[0] + gained[1];
    this->unattenuated[i] += sampled[0].unattenuated + sampled[1].unattenuated;

    // Where light is stopped in the halves, and the same for all moves.
    float stop[2];
    float deepened[2];
    float inverse[2];
    const Range<float> whole = Inside(inside, 0, layer.thickness);
    const float begin = whole.begin;
    for (int half = 0; half < 2; ++half)
    {
      const Range<float>& part = halves[half];
      stop[half] = part.begin + StopShare(half, sampled[half].opticalDepth) * part.Length() - begin;
      deepened[half] =
        tau + length * stop[half] * (extinction.At(begin) + 0.5f * stop[half] * extinction.slope);
      const float distance = layer.front + begin + stop[half] + this->eye.depth; // 0 at the eye
      inverse[half] =
        this->eye.parallel ? length * this->eye.inverse : 1.0f / Most(distance, 1e-6f);
    }
    const bool enters = entry >= layer.front && entry < layer.front + layer.thickness;
    const float step = enters ? Most(extinction.At(inside.begin), 0.0f) : 0.0f;
    const float way = whole.Length();
    for (const EyeMove& move : this->moves)
    {
      const float across = move.across - this->eye.slope[i] * move.depth;
      const Line slope(layer,
        length * (across * this->slopes.across[0][i] + move.down * this->slopes.down[0][i]),
        length * (across * this->slopes.across[1][i] + move.down * this->slopes.down[1][i]));
      const float through = side > this->eye.front
        ? (this->rays.columnEntry[i] > this->rays.row.begin ? move.side[i] : move.row * length)
        : move.front * length;
      const float integral = move.integral[i] + step * through;
      const float moment = move.moment[i] + step * through * entry;
      const float first = slope.At(begin);
      const float at = layer.front + begin;
      float gain = 0;
      for (int half = 0; half < 2; ++half)
      {
        const float s = stop[half];
        const float change = (at + s) * integral - moment +
          s * s * (0.5f * first + (1.0f / 6) * s * slope.slope) - move.along[i] * deepened[half];
        gain += gained[half] > 0.0f ? gained[half] * change * inverse[half] : 0.0f;
      }
      const float here = way * (first + 0.5f * way * slope.slope);
      move.gain[i] += gain;
      move.integral[i] = integral + here;
      move.moment[i] =
        moment + at * here + way * way * (0.5f * first + (1.0f / 3) * way * slope.slope);
    }
    // Behind the exit nothing is visible, so what is deepened there does not matter.
    this->opticalDepth[i] += sampled[0].LimitedDepth() + sampled[1].LimitedDepth();
  }
};
}

LIMPID_MULTIVERSION
void AddRow(const float* __restrict front, const float* __restrict back, float along, float factor,
  bool first, int begin, int end, float* __restrict out)
{
  for (int u = begin; u < end; ++u)
  {
    out[u] = (first ? 0.0f : out[u]) + factor * (front[u] + along * (back[u] - front[u]));
  }
}

LIMPID_MULTIVERSION
void DifferRow(const float* __restrict samples, const float* const weights[4], float factor,
  const Range<int>& columns, float* __restrict out)
{
  const float* __restrict first = weights[0];
  const float* __restrict second = weights[1];
  const float* __restrict third = weights[2];
  const float* __restrict fourth = weights[3];
  for (int i = columns.begin; i < columns.end; ++i)
  {
    out[i] = factor *
      (first[i] * samples[i] + second[i] * samples[i + 1] + third[i] * samples[i + 2] +
        fourth[i] * samples[i + 3]);
  }
}

LIMPID_MULTIVERSION
void ForwardViewDerivativeRow(const RayRow& rays, const RowSlopes& slopes, const EyeDistance& eye,
  const EyeMove moves[2], double* opticalDepth, float* visible, float* unattenuated)
{
  const ViewDerivativeColumn column{ rays, slopes, eye, { moves[0], moves[1] }, opticalDepth,
    visible, unattenuated };
#pragma GCC ivdep
  for (int i = rays.columns.begin; i < rays.columns.end; ++i)
  {
    column(i);
  }
}
}
