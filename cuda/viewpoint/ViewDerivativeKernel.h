// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The derivative of the score of a source's rays by movements of the eye.

#ifndef limpid_viewpoint_ViewDerivativeKernel_h
#define limpid_viewpoint_ViewDerivativeKernel_h

#include "sweep/RaySteps.h"
#include "sweep/SliceWindow.h"
#include "viewpoint/ViewDerivativePlan.h"

namespace limpid
{
/**
 * The effect of moving the eye by e on rays in one layer. Summed over all rays and layers, the
 * gain is the integral of Eq. (29); Eq. (14) is included in d tau (deviation D13).
 *
 * Moving the eye along a ray changes nothing on that ray. Therefore e is projected along each ray
 * to the plane of the eye perpendicular to the depth axis, e' = e - e_w (a, b, 1) with the ray's
 * slopes a and b. A point x at depth D stays where it is; its optical depth changes by
 *
 *    d tau = (D P - M - c tau) / R, P = int e' . grad mu ds, M = int D' e' . grad mu ds
 *
 * over the medium in front of it, at depths D'. For a point eye, R is D. A parallel eye turns
 * about a point, and R is its distance divided by the length of a ray per unit of depth. c
 * accounts for the ray becoming longer. Where rays enter the box, grad mu is that of a step.
 */
struct EyeMove
{
  float across; ///< component of e along the columns [index]
  float down;   ///< component of e' along the rows [index]
  float depth;  ///< component of e along the depth axis [index]
  float row;    ///< P of a unit step through sides that face v, divided by the length per depth
  float front;  ///< P through the front, divided by the length per depth; 0 except at the eye
  const float* side;  ///< [ray]: P through sides that face u
  const float* along; ///< [ray]: c
  float* integral;    ///< [ray]: P so far
  float* moment;      ///< [ray]: M so far
  float* gain;        ///< [ray]: minus the derivative of the visible importance so far
};

/// Derivatives of the extinction across rays at the Gauss points, per ray [1/length/index].
struct RaySlopes
{
  const float* across[2]; ///< along the columns
  const float* down[2];   ///< along the rows
};

/// Returns a part of a layer. It ends at exactly the number at which the next part begins.
/// Otherwise a ray that enters the box between two parts could enter neither, or both.
LIMPID_HD LIMPID_INLINE Layer PartOf(const Layer& whole, int part, int parts)
{
  const auto depthOf = [&](int number)
  {
    const float share = static_cast<float>(number) / static_cast<float>(parts);
    return number == parts ? whole.front + whole.thickness : whole.front + share * whole.thickness;
  };
  const float share = 1.0f / static_cast<float>(parts);
  const float before = share * static_cast<float>(part);
  const float widening = whole.backScale - whole.frontScale;
  const float front = depthOf(part);
  return { front, depthOf(part + 1) - front, whole.frontScale + before * widening,
    whole.frontScale + (before + share) * widening };
}

/// The straight line through the samples at the two Gauss points of a layer.
struct Line
{
  float origin; ///< value at the front of the layer
  float slope;  ///< [1/index]

  LIMPID_HD LIMPID_INLINE Line(const Layer& layer, float first, float second)
  {
    constexpr float before = float(gaussPoints[0]);
    constexpr float between = float(gaussPoints[1] - gaussPoints[0]);
    this->slope = (second - first) / (between * layer.thickness);
    this->origin = first - this->slope * (before * layer.thickness);
  }

  LIMPID_HD LIMPID_INLINE float At(float depth) const { return this->origin + depth * this->slope; }
};

/// Front to back: adds the visible importance of a layer to `visible` and `unattenuated`, and its
/// derivative by two moves of the eye to their gains. Adds the layer's optical depth.
struct ViewDerivativeStep
{
  RayStates rays;
  RaySlopes slopes;
  const float* columnSlope; ///< [ray]: a
  float pointEye;           ///< 1 for a point eye, 0 for a parallel one
  float frontDepth;         ///< see ViewDerivativePlan, also for the next two
  float eyeDepth;
  float inverseDistance; ///< 0 for a point eye
  EyeMove moves[2];

  LIMPID_HD LIMPID_INLINE void operator()(
    const RayInLayer<LayerCrossing::Clipped>& here, Index i) const
  {
    const Layer& layer = here.layer;
    const float length = here.length;
    const float side = Most(here.column.begin, here.row.begin);
    const float entry = Most(side, this->frontDepth);
    const Range<float> inside{ entry - layer.front,
      Least(here.column.end, here.row.end) - layer.front };
    const Range<float> halves[2] = { Inside(inside, 0, 0.5f * layer.thickness),
      Inside(inside, 0.5f * layer.thickness, layer.thickness) };
    const Line extinction(layer, here.extinction[0], here.extinction[1]);
    const Line importance(layer, here.importance[0], here.importance[1]);
    const HalfLayer<float> sampled[2] = { HalfOf(here, 0, halves[0], extinction, importance),
      HalfOf(here, 1, halves[1], extinction, importance) };
    const float tau = static_cast<float>(this->rays[RayDepth::ToSlice][i]);
    const float transmittance = Attenuate(tau);
    const float gained[2] = { transmittance * sampled[0].visible,
      transmittance * sampled[0].Passed() * sampled[1].visible };
    this->rays[RayChannel::Visible][i] += gained[0] + gained[1];
    this->rays[RayChannel::Unattenuated][i] += sampled[0].unattenuated + sampled[1].unattenuated;

    // Where light is stopped in each half; the same for all moves.
    float stop[2];
    float deepened[2];
    float inverse[2];
    const Range<float> whole = Inside(inside, 0, layer.thickness);
    const float begin = whole.begin;
    LIMPID_UNROLL(2)
    for (int half = 0; half < 2; ++half)
    {
      const Range<float>& part = halves[half];
      stop[half] = part.begin + StopShare(half, sampled[half].opticalDepth) * part.Length() - begin;
      deepened[half] =
        tau + length * stop[half] * (extinction.At(begin) + 0.5f * stop[half] * extinction.slope);
      const float distance = layer.front + begin + stop[half] + this->eyeDepth; // 0 at the eye
      inverse[half] = length * this->inverseDistance + this->pointEye / Most(distance, 1e-6f);
    }
    const bool enters = entry >= layer.front && entry < layer.front + layer.thickness;
    const float step = enters ? Most(extinction.At(inside.begin), 0.0f) : 0.0f;
    const float way = whole.Length();
    LIMPID_UNROLL(2)
    for (const EyeMove& move : this->moves)
    {
      const float across = move.across - this->columnSlope[i] * move.depth;
      const Line slope(layer,
        length * (across * this->slopes.across[0][i] + move.down * this->slopes.down[0][i]),
        length * (across * this->slopes.across[1][i] + move.down * this->slopes.down[1][i]));
      const float throughSide = move.side[i]; // loaded in any case, so that rays fill registers
      const float through = side > this->frontDepth
        ? (here.column.begin > here.row.begin ? throughSide : move.row * length)
        : move.front * length;
      const float integral = move.integral[i] + step * through;
      const float moment = move.moment[i] + step * through * entry;
      const float first = slope.At(begin);
      const float at = layer.front + begin;
      float gain = 0;
      LIMPID_UNROLL(2)
      for (int half = 0; half < 2; ++half)
      {
        const float s = stop[half];
        const float change = (at + s) * integral - moment +
          s * s * (0.5f * first + (1.0f / 6) * s * slope.slope) - move.along[i] * deepened[half];
        gain += gained[half] > 0.0f ? gained[half] * change * inverse[half] : 0.0f;
      }
      const float ahead = way * (first + 0.5f * way * slope.slope);
      move.gain[i] += gain;
      move.integral[i] = integral + ahead;
      move.moment[i] =
        moment + at * ahead + way * way * (0.5f * first + (1.0f / 3) * way * slope.slope);
    }
    // Nothing is visible behind the exit, so the extra optical depth there does not matter.
    this->rays[RayDepth::ToSlice][i] += sampled[0].LimitedDepth() + sampled[1].LimitedDepth();
  }

private:
  LIMPID_HD static LIMPID_INLINE float Least(float a, float b) { return a < b ? a : b; }
  LIMPID_HD static LIMPID_INLINE float Most(float a, float b) { return a > b ? a : b; }

  /// Returns the part of [begin, end] inside the box, as depths from the front of a layer.
  LIMPID_HD static LIMPID_INLINE Range<float> Inside(
    const Range<float>& stay, float begin, float end)
  {
    const float first = Least(Most(stay.begin, begin), end);
    return { first, Most(first, Least(stay.end, end)) };
  }

  /// Evaluates one half of a layer with its samples. If the ray enters or leaves the box in it,
  /// values at the middle of the inside part are used.
  LIMPID_HD static LIMPID_INLINE HalfLayer<float> HalfOf(
    const RayInLayer<LayerCrossing::Clipped>& here, int half, const Range<float>& part,
    const Line& extinction, const Line& importance)
  {
    const float whole = 0.4999f * here.layer.thickness;
    const bool cut = part.Length() < whole;
    const float middle = 0.5f * (part.begin + part.end);
    const float mu = cut ? Most(extinction.At(middle), 0.0f) : here.extinction[half];
    const float g = cut ? Most(Least(importance.At(middle), 1.0f), 0.0f) : here.importance[half];
    const float widening = (here.layer.backScale - here.layer.frontScale) / here.layer.thickness;
    return HalfLayer<float>(here.length * part.Length(), mu, g,
      here.layer.frontScale + widening * part.begin, here.layer.frontScale + widening * part.end);
  }

  /// Returns where light is stopped in a half of optical depth x, as a fraction of the half: at
  /// the Gauss point for small x, at the front for large x (HalfLayer.h).
  LIMPID_HD static LIMPID_INLINE float StopShare(int half, float x)
  {
    constexpr float front = float(2 * gaussPoints[0]);
    constexpr float rear = float(2 * gaussPoints[1] - 1);
    return (half == 0 ? front : rear) * 2.0f / (2.0f + x * (1.0f / 3 + x * (1.0f / 18)));
  }
};

/// The values that rays carry for both moves of the eye; initially 0.
struct EyeMoveStates
{
  static constexpr int images = 6;

  float* values; ///< [move][integral, moment, gain][ray]
  Index rays;

  LIMPID_HD LIMPID_INLINE float* Integral(int move) const { return this->Image(3 * move); }
  LIMPID_HD LIMPID_INLINE float* Moment(int move) const { return this->Image(3 * move + 1); }
  LIMPID_HD LIMPID_INLINE float* Gain(int move) const { return this->Image(3 * move + 2); }

private:
  LIMPID_HD LIMPID_INLINE float* Image(int image) const
  {
    return this->values + image * this->rays;
  }
};

/// The score of a camera, Eq. (32), and its derivative by two moves of the eye, front to back. For
/// the samplers of SlopeSampler.h.
template <class Field>
struct ViewDerivativeKernel
{
  static constexpr const char* label = "derivative by the eye";

  Field extinction; ///< [1/length]
  Field importance; ///< [0, 1]
  ViewDerivativePlan plan;
  EyeMoveStates states;

  template <class Windows>
  ViewDerivativeKernel<SliceWindow*> With(Windows& windows) const
  {
    return { windows(this->extinction, FieldUse{ 1 }), windows(this->importance, FieldUse{ 1 }),
      this->plan, this->states };
  }

  /// Calls visit for the values that rays carry.
  template <class Visit>
  LIMPID_HD LIMPID_INLINE void ForCarried(const Visit& visit) const
  {
    ForValues(visit, RayDepth::ToSlice, RayChannel::Visible, RayChannel::Unattenuated);
  }

  /// Moves rays from slice `s` to the next one.
  template <class Rays>
  LIMPID_HD LIMPID_INLINE void RayStep(Rays& rays, int s) const
  {
    if (!rays.EnterLayer(s, true))
    {
      return;
    }
    const int row = rays.FirstRow();
    const int column = rays.FirstColumn();
    const EyeMove moves[2] = { this->MoveOf(0, row, rays.Plan().RayAt(column, row)),
      this->MoveOf(1, row, rays.Plan().RayAt(column, row)) };
    for (int part = 0; part < this->plan.parts; ++part)
    {
      rays.EnterPart(this->plan, part);
      rays.SampleImportance(this->importance);
      rays.SampleExtinctionAndSlopes(this->extinction);
      rays.ForEachClipped(ViewDerivativeStep{ rays.States(), rays.Slopes(),
        this->plan.Row(this->plan.columnSlope) + column, this->plan.parallel ? 0.0f : 1.0f,
        this->plan.front, this->plan.depth, this->plan.parallel ? this->plan.inverse : 0.0f,
        { moves[0], moves[1] } });
    }
  }

private:
  LIMPID_HD LIMPID_INLINE EyeMove MoveOf(int m, int row, Index ray) const
  {
    const ViewDerivativePlan& all = this->plan;
    return { all.moveAcross[m], all.Row(all.moveDown, m)[row], all.moveDepth[m],
      all.Row(all.moveRow, m)[row], all.moveFront[m], all.Row(all.moveSide, m) + ray,
      all.Row(all.moveAlong, m) + ray, this->states.Integral(m) + ray, this->states.Moment(m) + ray,
      this->states.Gain(m) + ray };
  }
};
}

#endif
