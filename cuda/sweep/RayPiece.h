// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The formulas for a short segment of a ray. `Number`: float for one ray, FloatLanes for several
// rays side by side, with the same bits for each.

#ifndef limpid_sweep_RayPiece_h
#define limpid_sweep_RayPiece_h

#include "math/Vec.h"
#include "sweep/RayLayer.h"

namespace limpid
{
/// The fields at a point of a ray.
template <class Number>
struct PointSampleOf
{
  Number extinction; ///< [1/length]
  Number importance; ///< [0, 1]
  Number kept;       ///< kept base extinction: min of extinction and base extinction [1/length]
};

using PointSample = PointSampleOf<float>;

/**
 * A short segment of a ray in which extinction mu and importance g are linear
 * (Documentation/Method.md, quadrature). It evaluates the integrals of Eqs. (19) and (20). With
 * the segment's optical depth x and mean transmittance m = (1 - e^-x) / x,
 *
 *    integral of g mu T dt = g0 (1 - m) + g1 (m - e^-x) + (g1 - g0) tilt m,
 *
 * where T = 1 at the front. The first two terms are exact for constant mu. The third term, with
 * tilt = (mu1 - mu0) length / 12, makes the sum exact for thin segments.
 */
template <class Number>
struct RayPieceOf
{
  Number place;        ///< position of its centre, as a fraction of the layer's thickness
  Number size;         ///< its extent, as a fraction of the layer's thickness
  Number opticalDepth; ///< x [1]
  Number tilt;         ///< [1]
  Number front;        ///< importance at the front, times scale^2
  Number back;         ///< importance at the back, times scale^2
  Number keptShare;    ///< share of the extinction that is kept base extinction [0, 1]
  Number keptTilt;     ///< tilt of the kept base extinction [1]

  LIMPID_HD LIMPID_INLINE Number Passed() const { return Attenuate(this->opticalDepth); }

  LIMPID_HD LIMPID_INLINE Number Visible() const { return this->Shown(1.0f, this->tilt); }

  /// Visible importance of the kept base extinction.
  LIMPID_HD LIMPID_INLINE Number KeptVisible() const
  {
    return this->Shown(this->keptShare, this->keptTilt);
  }

  /// The integral of g mu dt.
  LIMPID_HD LIMPID_INLINE Number Unattenuated() const { return this->Present(1.0f, this->tilt); }

  LIMPID_HD LIMPID_INLINE Number KeptUnattenuated() const
  {
    return this->Present(this->keptShare, this->keptTilt);
  }

  /// The derivative of Visible by the optical depth.
  LIMPID_HD LIMPID_INLINE Number VisibleSlope() const
  {
    const Number x = this->opticalDepth;
    const Number passed = this->Passed();
    const Number meanSlope =
      Select(x < series, -1.0f / 2 + x * (1.0f / 3 - x * (1.0f / 8 - x * (1.0f / 30))),
        Quotient(passed - this->MeanTransmittance(), x));
    return this->back * passed + (this->back - this->front) * meanSlope * (1.0f + this->tilt);
  }

  /// The derivative of Visible by the tilt.
  LIMPID_HD LIMPID_INLINE Number TiltSlope() const
  {
    return (this->back - this->front) * this->MeanTransmittance();
  }

private:
  static constexpr float series = 0.1f; ///< for smaller x, power series are used; exact to rounding

  /// Visible importance of a `share` of the extinction with the given tilt.
  LIMPID_HD LIMPID_INLINE Number Shown(const Number& share, const Number& tiltOfShare) const
  {
    const Number x = this->opticalDepth;
    const Number mean = this->MeanTransmittance();
    const auto thin = x < series;
    const Number ofFront = Select(
      thin, x * (1.0f / 2 - x * (1.0f / 6 - x * (1.0f / 24 - x * (1.0f / 120)))), 1.0f - mean);
    const Number ofBack = Select(thin,
      x * (1.0f / 2 - x * (1.0f / 3 - x * (1.0f / 8 - x * (1.0f / 30)))), mean - this->Passed());
    return share * (this->front * ofFront + this->back * ofBack) +
      (this->back - this->front) * tiltOfShare * mean;
  }

  LIMPID_HD LIMPID_INLINE Number Present(const Number& share, const Number& tiltOfShare) const
  {
    return share * (0.5f * (this->front + this->back) * this->opticalDepth) +
      (this->back - this->front) * tiltOfShare;
  }

  LIMPID_HD LIMPID_INLINE Number MeanTransmittance() const
  {
    const Number x = this->opticalDepth;
    return Select(x < series,
      1.0f - x * (1.0f / 2 - x * (1.0f / 6 - x * (1.0f / 24 - x * (1.0f / 120)))),
      Quotient(Stop(x), x));
  }
};

using RayPiece = RayPieceOf<float>;

/// A part of a layer with samples of its own at its Gauss points.
template <class Number>
struct PartOfLayer
{
  Number begin;  ///< where it begins, as a fraction of the layer's thickness
  Number size;   ///< its extent, as a fraction of the layer's thickness
  Number length; ///< world length of one of its segments [length]
  PointSampleOf<Number> first;
  PointSampleOf<Number> second;

  /// Returns segment `number` of piecesOfPart.
  LIMPID_HD LIMPID_INLINE RayPieceOf<Number> Piece(const Layer& layer, int number) const;

private:
  /// The mean of scale^2 over a segment.
  LIMPID_HD LIMPID_INLINE static Number AreaOf(
    const Layer& layer, const Number& place, const Number& size)
  {
    const float widening = layer.backScale - layer.frontScale;
    const Number scale = layer.frontScale + place * widening;
    return scale * scale + (1.0f / 12) * (size * widening) * (size * widening);
  }
};

constexpr int piecesOfPart = 4; ///< number of equal segments of a part

template <class Number>
LIMPID_HD LIMPID_INLINE RayPieceOf<Number> PartOfLayer<Number>::Piece(
  const Layer& layer, int number) const
{
  constexpr float origin = float(gaussPoints[0]);
  constexpr float inverse = float(1.0 / (gaussPoints[1] - gaussPoints[0]));
  const float shares[2] = { static_cast<float>(number) * (1.0f / piecesOfPart),
    (static_cast<float>(number) + 1.0f) * (1.0f / piecesOfPart) };
  const auto line = [&](const Number& one, const Number& other, int end)
  { return one + (other - one) * ((shares[end] - origin) * inverse); };
  const auto extinction = [&](int end)
  { return AtLeast(line(this->first.extinction, this->second.extinction, end), 0.0f); };
  const auto importance = [&](int end)
  { return Clamp(line(this->first.importance, this->second.importance, end), 0.0f, 1.0f); };
  const auto kept = [&](int end)
  { return AtLeast(line(this->first.kept, this->second.kept, end), 0.0f); };
  const Number ends[2] = { extinction(0), extinction(1) };
  const Number mean = 0.5f * (ends[0] + ends[1]);
  const Number keptEnds[2] = { kept(0), kept(1) };
  const Number keptMean = 0.5f * (keptEnds[0] + keptEnds[1]);
  RayPieceOf<Number> piece;
  piece.place = this->begin + this->size * (0.5f * (shares[0] + shares[1]));
  piece.size = this->size * (shares[1] - shares[0]);
  piece.opticalDepth = mean * this->length;
  piece.tilt = (ends[1] - ends[0]) * this->length * (1.0f / 12);
  const Number area = AreaOf(layer, piece.place, piece.size);
  piece.front = area * importance(0);
  piece.back = area * importance(1);
  piece.keptShare = Select(keptMean < mean, Quotient(keptMean, AtLeast(mean, leastNormal)), 1.0f);
  piece.keptTilt = (keptEnds[1] - keptEnds[0]) * this->length * (1.0f / 12);
  return piece;
}

/// The effects of extinction at the two ends of a layer, see EffectStep; T = 1 at the front.
template <class Number>
struct LayerEffectOf
{
  Number front;
  Number back;
};

using LayerEffect = LayerEffectOf<float>;

/// The light that passes the segments of a layer, front to back.
template <class Number>
struct LightOfPieces
{
  static constexpr float nothing = 1e-5f; ///< transmittance below which segments are ignored

  Number transmittance = 1.0f;
  Number opticalDepth = 0.0f;
  Number visible = 0.0f;
  Number unattenuated = 0.0f;
  Number keptVisible = 0.0f;
  Number keptUnattenuated = 0.0f;

  LIMPID_HD LIMPID_INLINE auto IsLit() const { return this->transmittance > nothing; }

  /// Adds the next segment.
  template <class Condition>
  LIMPID_HD LIMPID_INLINE void Add(const RayPieceOf<Number>& piece, const Condition& isThere)
  {
    const Condition isLit = And(isThere, this->IsLit());
    this->unattenuated = this->unattenuated + Select(isThere, piece.Unattenuated(), 0.0f);
    this->keptUnattenuated =
      this->keptUnattenuated + Select(isThere, piece.KeptUnattenuated(), 0.0f);
    this->opticalDepth = this->opticalDepth + Select(isThere, piece.opticalDepth, 0.0f);
    this->visible = this->visible + Select(isLit, this->transmittance * piece.Visible(), 0.0f);
    this->keptVisible =
      this->keptVisible + Select(isLit, this->transmittance * piece.KeptVisible(), 0.0f);
    this->transmittance = Select(isLit, this->transmittance * piece.Passed(), this->transmittance);
  }
};

/**
 * The effect of the segments of a layer, front to back, before it is known what is seen behind the
 * layer. A segment attenuates whatever is seen behind it. So the visible importance of a segment
 * adds to the effect of all segments in front of it, with the sum of their weights:
 *
 *    sum over k of c_k S_k = sum over j of v_j sum over k < j of c_k,
 *
 * where v_j is visible in segment j and S_k = sum over j > k of v_j behind segment k. Unlike S_k as
 * the difference of two sums, no term cancels another one.
 */
template <class Number>
struct EffectOfPieces
{
  LayerEffectOf<Number> found{ 0.0f, 0.0f };
  LayerEffectOf<Number> weight{ 0.0f, 0.0f }; ///< effect per visible importance behind [index]

  /// Adds the next segment, if light reaches it. `transmittance`: in front of it.
  template <class Condition>
  LIMPID_HD LIMPID_INLINE void Add(const RayPieceOf<Number>& piece, const Number& transmittance,
    const Condition& isLit, float thickness)
  {
    const Number unit = Select(isLit, thickness * piece.size, 0.0f);
    const Number arriving = Select(isLit, transmittance, 0.0f);
    const Number ofFront = (1.0f - piece.place) * unit;
    const Number ofBack = piece.place * unit;
    const Number visible = arriving * piece.Visible();
    const Number ofDepth = arriving * piece.VisibleSlope();
    const Number ofTilt = piece.size * (1.0f / 12) * unit * (arriving * piece.TiltSlope());
    this->found.front =
      this->found.front + (visible * this->weight.front - ofFront * ofDepth + ofTilt);
    this->found.back = this->found.back + (visible * this->weight.back - ofBack * ofDepth - ofTilt);
    this->weight.front = this->weight.front + ofFront;
    this->weight.back = this->weight.back + ofBack;
  }

  /// Returns the effect. `seen`: visible importance behind the last segment, for T = 1 at the
  /// front.
  LIMPID_HD LIMPID_INLINE LayerEffectOf<Number> With(const Number& seen) const
  {
    return { this->found.front + seen * this->weight.front,
      this->found.back + seen * this->weight.back };
  }
};
}

#endif
