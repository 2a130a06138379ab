// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_HalfLayer_h
#define limpid_sweep_HalfLayer_h

#include "math/Exp.h"
#include "math/Range.h"

namespace limpid
{
/// Positions of the samples of a layer, as fractions of its thickness: the two-point Gauss rule.
constexpr double gaussPoints[2] = { 0.21132486540518712, 0.78867513459481288 };

/// The layer between two neighbouring slices, common to all rays that cross it.
struct alignas(16) Layer
{
  float front = 0;      ///< relative depth of the slice in front [index]
  float thickness = 0;  ///< distance between the slices along the depth axis [index]
  float frontScale = 1; ///< width of a ray at the front, see Slice::scale
  float backScale = 1;  ///< width of a ray at the back
};

/**
 * The effect of half a layer on a ray (Documentation/Method.md, quadrature).
 *
 * Extinction mu and importance g are constant in the half and equal to their values at its Gauss
 * point. With the optical depth x = mu h of the half and T = 1 at its front, exactly:
 *
 *    light stopped: 1 - e^-x, Eqs. (15), (16)
 *
 *    visible importance: integral of g mu T dt = g (1 - e^-x), Eqs. (19), (20)
 *
 * Visible importance therefore never exceeds max g. In thin media the two halves together
 * integrate products g mu exactly up to cubics along the layer. Where rays widen, g is multiplied
 * by the mean of scale^2, weighted by where light is stopped. That mean lies at the fraction c =
 * 1/x - 1/(e^x - 1) of the half's depth. For x < 1, c = 1 / (2 + x/3 + x^2/18) is accurate to
 * 1e-3.
 */
template <class Real>
struct HalfLayer
{
  Real opticalDepth; ///< x [1]
  Real stopped;      ///< 1 - e^-x [0, 1]
  Real visible;      ///< visible importance times scale^2 [1]
  Real unattenuated; ///< visible importance for T = 1: g x times the mean of scale^2 [1]
  Real visibleSlope; ///< derivative of `visible` by the optical depth [1]

  /// Evaluates a whole half. `length`: world length of the ray in it [length]; `extinction`
  /// [1/length]; `importance` [0, 1]; `frontScale`, `backScale`: ray widths at its ends.
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

  /// Returns this half with visible importance multiplied by `share`.
  LIMPID_HD LIMPID_INLINE HalfLayer CountingShare(Real share) const
  {
    HalfLayer half = *this;
    half.visible *= share;
    half.unattenuated *= share;
    return half;
  }

  /// Optical depth, at most 1e4. Larger values have no effect; with the limit, sums stay exact to
  /// 1e-8.
  LIMPID_HD LIMPID_INLINE Real LimitedDepth() const
  {
    return this->opticalDepth < Real(1e4) ? this->opticalDepth : Real(1e4);
  }
};

/// Returns the range of a half as fractions of the layer's thickness.
LIMPID_HD LIMPID_INLINE Range<float> RangeOfHalf(int half)
{
  return half == 0 ? Range<float>{ 0.0f, 0.5f } : Range<float>{ 0.5f, 1.0f };
}

/// Evaluates a half that the ray crosses completely inside the box. `length`: world length of the
/// ray per unit of depth.
template <class Real>
LIMPID_HD LIMPID_INLINE HalfLayer<Real> WholeHalf(
  const Layer& layer, const Range<float>& half, Real length, Real extinction, Real importance)
{
  const Real widening = layer.backScale - layer.frontScale;
  return HalfLayer<Real>(Real(0.5) * layer.thickness * length, extinction, importance,
    layer.frontScale + half.begin * widening, layer.frontScale + half.end * widening);
}

/// Returns the part of `half`, or of another range, in which the ray is inside the box in u
/// (`column`) and v (`row`), as fractions of the layer's thickness.
LIMPID_HD LIMPID_INLINE Range<float> ClippedRange(
  const Layer& layer, const Range<float>& half, const Range<float>& column, const Range<float>& row)
{
  const float inverse = 1.0f / layer.thickness;
  const float entry =
    ((column.begin > row.begin ? column.begin : row.begin) - layer.front) * inverse;
  const float exit = ((column.end < row.end ? column.end : row.end) - layer.front) * inverse;
  const float notBefore = entry > half.begin ? entry : half.begin;
  const float begin = notBefore < half.end ? notBefore : half.end;
  const float last = exit < half.end ? exit : half.end;
  return { begin, last > begin ? last : begin };
}

/// Evaluates a part of a half, given as fractions of the layer's thickness. Extinction and
/// importance are the values at the Gauss point of the half; if that lies outside the box, at the
/// nearest point of its border.
template <class Real>
LIMPID_HD LIMPID_INLINE HalfLayer<Real> ClippedHalf(
  const Layer& layer, const Range<float>& part, Real length, Real extinction, Real importance)
{
  const Real widening = layer.backScale - layer.frontScale;
  return HalfLayer<Real>((part.end - part.begin) * layer.thickness * length, extinction, importance,
    layer.frontScale + part.begin * widening, layer.frontScale + part.end * widening);
}
}

#endif
