// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_HalfLayer_h
#define limpid_sweep_HalfLayer_h

#include "math/Exp.h"
#include "math/Range.h"

namespace limpid
{
/// Shares of a layer's thickness at which rays are sampled: the two points of Gauss' quadrature.
constexpr double gaussPoints[2] = { 0.21132486540518712, 0.78867513459481288 };

/// The layer between two neighbouring slices, the same for all rays that cross it.
struct alignas(16) Layer
{
  float front = 0;      ///< relative depth of the slice in front [index]
  float thickness = 0;  ///< distance of the slices along the depth axis [index]
  float frontScale = 1; ///< width of a ray at the front, see Slice::scale
  float backScale = 1;  ///< ... and at the back
};

/**
 * What a half of a layer does to a ray (Documentation/Method.md, quadrature).
 *
 * Extinction mu and importance g are constant in the half, each with its value at the Gauss point.
 * With the optical depth x = mu h of the half, exactly:
 *
 *   it stops 1 - e^-x of what passes,                                       Eqs. (15), (16)
 *   its visible importance is  integral of g mu T dt = g (1 - e^-x),        Eqs. (19), (20)
 *                              with T = 1 at its front,
 *
 * so visible importance never exceeds max g, and for thin media the two halves together integrate
 * products g mu that are cubic along the layer without error. Where rays widen, g carries the
 * factor scale^2, averaged over where light is stopped: at the share c of the half's depth,
 * c = 1/x - 1/(e^x - 1), here to 1e-3 of its value for x < 1 as 1 / (2 + x/3 + x^2/18).
 */
template <class Real>
struct HalfLayer
{
  Real opticalDepth; ///< x [1]
  Real stopped;      ///< 1 - e^-x [0, 1]
  Real visible;      ///< visible importance times scale^2 [1]
  Real unattenuated; ///< the same without attenuation: g x times the mean of scale^2 [1]
  Real visibleSlope; ///< derivative of `visible` by the optical depth [1]

  /// The whole half. `length`: world length of the ray in it [length]; `extinction` [1/length];
  /// `importance` [0, 1]; the scales are those at its front and back.
  LIMPID_HD LIMPID_INLINE HalfLayer(
    Real length, Real extinction, Real importance, Real frontScale, Real backScale)
  {
    const Real x = length * extinction;
    const Real widening = backScale - frontScale;
    const Real centre = Quotient(Real(1), Real(2) + x * (Real(1) / 3 + x * (Real(1) / 18)));
    const Real area = frontScale * frontScale +
      widening * centre * (Real(2) * frontScale + (Real(4) / 3) * widening * centre);
    const Real meanArea =
      frontScale * frontScale + widening * (frontScale + (Real(1) / 3) * widening);
    this->opticalDepth = x;
    this->stopped = Stop(x);
    this->visible = importance * (this->stopped * area);
    this->unattenuated = importance * (x * meanArea);
    const Real areaSlope = -widening * (Real(2) * frontScale + (Real(8) / 3) * widening * centre) *
      centre * centre * (Real(1) / 3 + x * (Real(1) / 9));
    this->visibleSlope =
      importance * ((Real(1) - this->stopped) * area + this->stopped * areaSlope);
  }

  LIMPID_HD LIMPID_INLINE Real Passed() const { return Real(1) - this->stopped; }

  /// The same half, of whose extinction a share counts as important.
  LIMPID_HD LIMPID_INLINE HalfLayer CountingShare(Real share) const
  {
    HalfLayer half = *this;
    half.visible *= share;
    half.unattenuated *= share;
    return half;
  }

  /// Beyond an optical depth of 1e4 nothing changes any more; sums of such stay exact to 1e-8.
  LIMPID_HD LIMPID_INLINE Real LimitedDepth() const
  {
    return this->opticalDepth < Real(1e4) ? this->opticalDepth : Real(1e4);
  }
};

/// Where a half of a layer lies, as shares of the layer's thickness.
LIMPID_HD LIMPID_INLINE Range<float> RangeOfHalf(int half)
{
  return half == 0 ? Range<float>{ 0.0f, 0.5f } : Range<float>{ 0.5f, 1.0f };
}

/// A half of a layer that the ray crosses inside the box from front to back. `length`: world
/// length of the ray per unit of depth.
template <class Real>
LIMPID_HD LIMPID_INLINE HalfLayer<Real> WholeHalf(
  const Layer& layer, const Range<float>& half, Real length, Real extinction, Real importance)
{
  const Real widening = layer.backScale - layer.frontScale;
  return HalfLayer<Real>(Real(0.5) * layer.thickness * length, extinction, importance,
    layer.frontScale + half.begin * widening, layer.frontScale + half.end * widening);
}

/// The part of a layer's `half`, or of another range, between the clips of the ray's column and
/// row, all as shares of the layer's thickness.
LIMPID_HD LIMPID_INLINE Range<float> ClippedRange(
  const Layer& layer, const Range<float>& half, const Range<float>& column, const Range<float>& row)
{
  const float inverse = 1.0f / layer.thickness;
  const float entry =
    ((column.begin > row.begin ? column.begin : row.begin) - layer.front) * inverse;
  const float exit = ((column.end < row.end ? column.end : row.end) - layer.front) * inverse;
  const float begin = entry > half.begin ? (entry < half.end ? entry : half.end) : half.begin;
  const float last = exit < half.end ? exit : half.end;
  return { begin, last > begin ? last : begin };
}

/// That part of a half. Extinction and importance are sampled at the Gauss point even where that
/// lies outside the box: there on its border.
template <class Real>
LIMPID_HD LIMPID_INLINE HalfLayer<Real> ClippedHalf(const Layer& layer, const Range<float>& half,
  Real length, Real extinction, Real importance, const Range<float>& column,
  const Range<float>& row)
{
  const Range<float> inside = ClippedRange(layer, half, column, row);
  const Real widening = layer.backScale - layer.frontScale;
  return HalfLayer<Real>((inside.end - inside.begin) * layer.thickness * length, extinction,
    importance, layer.frontScale + inside.begin * widening,
    layer.frontScale + inside.end * widening);
}
}

#endif
