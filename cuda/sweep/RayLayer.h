// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A ray in a layer that it may enter or leave, and the visible importance that it carries through.

#ifndef limpid_sweep_RayLayer_h
#define limpid_sweep_RayLayer_h

#include "sweep/HalfLayer.h"

namespace limpid
{
/// Which ends of a ray's interval inside the box clip a half.
enum class Cut
{
  Entry,
  Exit,
  Both
};

/// Returns the part of a half, as fractions of the layer's thickness, clipped as `cut` says. An end
/// that does not clip is not computed: compilers vectorise no selection by a condition that all
/// rays share.
template <Cut cut>
LIMPID_HD LIMPID_INLINE Range<float> CutRange(
  const Layer& layer, const Range<float>& half, const Range<float>& column, const Range<float>& row)
{
  if (cut == Cut::Both)
  {
    return ClippedRange(layer, half, column, row);
  }
  const float inverse = 1.0f / layer.thickness;
  const float entry = column.begin > row.begin ? column.begin : row.begin;
  if (cut == Cut::Entry)
  {
    return { Clamp((entry - layer.front) * inverse, half.begin, half.end), half.end };
  }
  const float exit = column.end < row.end ? column.end : row.end;
  constexpr float never = -1e30f; // a ray that misses the box crosses nothing
  const float end = entry < exit ? exit : never;
  return { half.begin, Clamp((end - layer.front) * inverse, half.begin, half.end) };
}

/// Evaluates a half of a layer, clipped as `cut` says.
template <Cut cut>
LIMPID_HD LIMPID_INLINE HalfLayer<float> CutHalf(const Layer& layer, int half, float length,
  float extinction, float importance, const Range<float>& column, const Range<float>& row)
{
  return ClippedHalf<float>(
    layer, CutRange<cut>(layer, RangeOfHalf(half), column, row), length, extinction, importance);
}

/// Whether a ray is inside the box throughout a layer.
enum class LayerCrossing
{
  Through,
  Clipped
};

/// Whether a ray with this range inside the box (RayInLayer::Inside) is there throughout the layer.
LIMPID_HD LIMPID_INLINE bool IsWhole(const Range<float>& inside)
{
  return inside.begin <= 0.0f && inside.end >= 1.0f;
}

/// The effect of a layer on the light of a ray, inside the box.
struct LayerLight
{
  float passed;           ///< share of the light that passes [0, 1]
  float visible;          ///< visible importance times scale^2, for T = 1 at the front [1]
  float unattenuated;     ///< visible importance without attenuation
  float keptVisible;      ///< visible importance of the kept base extinction, see Kept
  float keptUnattenuated; ///< keptVisible without attenuation
  float opticalDepth;     ///< counted from the entry into the box, see RayInLayer::DepthFromEntry
};

/// A ray in a layer and its samples at both Gauss points.
template <LayerCrossing passage>
struct RayInLayer
{
  Layer layer;
  float length;        ///< world length per unit of depth [length]
  Range<float> column; ///< relative depths between which the ray is inside the box in u [index]
  Range<float> row;    ///< likewise in v
  float extinction[2]; ///< [1/length]
  float importance[2]; ///< [0, 1]
  float kept[2];       ///< kept base extinction, or an alternative extinction [1/length]

  /// Relative depth where the ray enters the box.
  LIMPID_HD LIMPID_INLINE float Entry() const
  {
    return this->row.begin > this->column.begin ? this->row.begin : this->column.begin;
  }

  template <Cut cut>
  LIMPID_HD LIMPID_INLINE HalfLayer<float> Half(int half) const
  {
    return passage == LayerCrossing::Through
      ? this->Whole(half)
      : CutHalf<cut>(this->layer, half, this->length, this->extinction[half],
          this->importance[half], this->column, this->row);
  }

  /// The whole half, even where the ray is outside the box.
  LIMPID_HD LIMPID_INLINE HalfLayer<float> Whole(int half) const
  {
    return WholeHalf<float>(
      this->layer, RangeOfHalf(half), this->length, this->extinction[half], this->importance[half]);
  }

  /// Part of a half in which the ray is inside the box, as a fraction of the layer's thickness.
  LIMPID_HD LIMPID_INLINE float WayInHalf(int half) const
  {
    if (passage == LayerCrossing::Through)
    {
      return 0.5f;
    }
    return ClippedRange(this->layer, RangeOfHalf(half), this->column, this->row).Length();
  }

  /// Whether the ray is inside the box from the front of the layer to its back.
  LIMPID_HD LIMPID_INLINE bool StaysInside() const
  {
    const float back = this->layer.front + this->layer.thickness;
    const float exit = this->column.end < this->row.end ? this->column.end : this->row.end;
    return this->Entry() <= this->layer.front && exit >= back;
  }

  /// Whether the ray is outside the box throughout the layer.
  LIMPID_HD LIMPID_INLINE bool StaysOutside() const
  {
    const float back = this->layer.front + this->layer.thickness;
    const float entry = this->Entry();
    const float exit = this->column.end < this->row.end ? this->column.end : this->row.end;
    return !(entry < exit) || entry >= back || exit <= this->layer.front;
  }

  /// Range inside the box, as fractions of the layer's thickness.
  LIMPID_HD LIMPID_INLINE Range<float> Inside() const
  {
    return ClippedRange(this->layer, { 0.0f, 1.0f }, this->column, this->row);
  }

  /// Optical depth of the layer counted from the entry into the box; not clipped at the exit.
  LIMPID_HD LIMPID_INLINE float DepthFromEntry() const
  {
    return this->template Half<Cut::Entry>(0).LimitedDepth() +
      this->template Half<Cut::Entry>(1).LimitedDepth();
  }

  /// Share of a half's extinction that is kept base extinction [0, 1].
  LIMPID_HD LIMPID_INLINE float KeptShare(int half) const
  {
    return FractionOf(this->kept[half], this->extinction[half]);
  }

  LIMPID_HD LIMPID_INLINE float WholeDepth() const
  {
    return this->Whole(0).LimitedDepth() + this->Whole(1).LimitedDepth();
  }

  /// The effect of the layer on light, from its two halves.
  LIMPID_HD LIMPID_INLINE LayerLight Light() const
  {
    const HalfLayer<float> front = this->template Half<Cut::Both>(0);
    const HalfLayer<float> rear = this->template Half<Cut::Both>(1);
    const float keptFront = this->KeptShare(0);
    const float keptRear = this->KeptShare(1);
    return { front.Passed() * rear.Passed(), front.visible + front.Passed() * rear.visible,
      front.unattenuated + rear.unattenuated,
      front.visible * keptFront + front.Passed() * (rear.visible * keptRear),
      front.unattenuated * keptFront + rear.unattenuated * keptRear, this->DepthFromEntry() };
  }
};

/// Both halves of a layer as seen by one ray.
struct TwoHalves
{
  HalfLayer<float> front;
  HalfLayer<float> rear;

  /// Clipped to the interval inside the box.
  template <LayerCrossing passage>
  LIMPID_HD LIMPID_INLINE static TwoHalves Inside(const RayInLayer<passage>& ray)
  {
    return { ray.template Half<Cut::Both>(0), ray.template Half<Cut::Both>(1) };
  }

  /// Clipped at the exit only, so that they extend in front of the entry.
  template <LayerCrossing passage>
  LIMPID_HD LIMPID_INLINE static TwoHalves ToExit(const RayInLayer<passage>& ray)
  {
    return { ray.template Half<Cut::Exit>(0), ray.template Half<Cut::Exit>(1) };
  }

  /// Counts only the visible importance of kept base extinction.
  template <LayerCrossing passage>
  LIMPID_HD LIMPID_INLINE TwoHalves CountingShares(const RayInLayer<passage>& ray) const
  {
    return { this->front.CountingShare(ray.KeptShare(0)),
      this->rear.CountingShare(ray.KeptShare(1)) };
  }
};

/// Carries visible importance from the back of a half to its front, Eq. (20).
LIMPID_HD LIMPID_INLINE float Carried(const HalfLayer<float>& half, float behind)
{
  return half.visible + half.Passed() * behind;
}

/// Carries visible importance through a layer of two halves.
LIMPID_HD LIMPID_INLINE float Carried(
  const HalfLayer<float>& front, const HalfLayer<float>& rear, float behind)
{
  return Carried(front, Carried(rear, behind));
}

/**
 * Optical depth per unit of depth since a ray's entry into the box. It is as smooth as the
 * extinction, even where the entry has a kink or has not been reached.
 *
 * `distance`: depth minus the depth of the entry [index]; `justBehind`: extinction there times the
 * ray's length per unit of depth; `knownAhead`: whether the (negative) optical depth in front of
 * the entry is known; `limit`: largest optical depth, which keeps cubics from overshooting.
 */
LIMPID_HD LIMPID_INLINE float DepthPerUnit(
  float opticalDepth, float distance, float justBehind, bool knownAhead, float limit)
{
  constexpr float tooClose = 0.01f; // smallest distance from the entry to divide by [index]
  const bool close = distance < tooClose && (!knownAhead || distance > -tooClose);
  const float mean = (opticalDepth < limit ? opticalDepth : limit) / (close ? tooClose : distance);
  return close ? justBehind : mean;
}

/// Returns exp(-depth); 1 if rounding made the depth slightly negative.
LIMPID_HD LIMPID_INLINE float Transmitted(float opticalDepth)
{
  return Attenuate(AtLeast(opticalDepth, 0.0f));
}
}

#endif
