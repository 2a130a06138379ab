// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What a ray does in a layer that it may enter or leave, the same for all backends.

#ifndef limpid_sweep_RayLayer_h
#define limpid_sweep_RayLayer_h

#include "sweep/HalfLayer.h"

namespace limpid
{
/// Which ends of a ray's stay in the box cut a half off.
enum class Cut
{
  Entry,
  Exit,
  Both
};

/// A half of a layer less what is cut off.
template <Cut cut>
LIMPID_HD LIMPID_INLINE HalfLayer<float> CutHalf(const Layer& layer, int half, float length,
  float extinction, float importance, Range<float> column, Range<float> row)
{
  constexpr float always = 1e30f;
  if (cut == Cut::Entry)
  {
    column.end = row.end = always;
  }
  if (cut == Cut::Exit)
  {
    const float entry = column.begin > row.begin ? column.begin : row.begin;
    const float exit = column.end < row.end ? column.end : row.end;
    row.end = entry < exit ? row.end : -always; // a ray that misses the box meets nothing
    column.begin = row.begin = -always;
  }
  return ClippedHalf<float>(layer, RangeOfHalf(half), length, extinction, importance, column, row);
}

/// Visible importance behind a half, carried from its back to its front, Eqs. (19), (20).
LIMPID_HD LIMPID_INLINE float Carried(const HalfLayer<float>& half, float behind)
{
  return half.visible + half.Passed() * behind;
}

/// The same through a whole layer.
LIMPID_HD LIMPID_INLINE float Carried(
  const HalfLayer<float>& front, const HalfLayer<float>& rear, float behind)
{
  return Carried(front, Carried(rear, behind));
}

LIMPID_HD LIMPID_INLINE float DepthOf(const HalfLayer<float>& front, const HalfLayer<float>& rear)
{
  return front.LimitedDepth() + rear.LimitedDepth();
}

/// Visible importance of a ray from its entry into the box on, which is final as soon as a sweep
/// from the back has come to the layer `layer` of its entry, or to one ahead. `visible`: what it
/// was so far, negative: not there yet; `carried`: that at the front of the layer, less what is cut
/// off.
LIMPID_HD LIMPID_INLINE float FromEntry(
  float visible, float entry, const Layer& layer, float carried)
{
  return visible < 0 && entry >= layer.front ? carried : visible;
}

/**
 * Optical depth per unit of depth since a ray's entry into the box. It is as smooth as the
 * extinction even where the entry has a kink or lies ahead.
 *
 * `distance`: depth less the depth of the entry [index]; `justBehind`: extinction there times the
 * ray's length per unit of depth; `unwound`: whether the optical depth is known, and negative,
 * ahead of the entry; `limit`: to optical depths, lest cubics swing beside them.
 */
LIMPID_HD LIMPID_INLINE float Densified(
  float opticalDepth, float distance, float justBehind, bool unwound, float limit)
{
  constexpr float tooClose = 0.01f; // to the entry, to divide by the distance [index]
  const bool close = distance < tooClose && (!unwound || distance > -tooClose);
  const float mean = (opticalDepth < limit ? opticalDepth : limit) / (close ? tooClose : distance);
  return close ? justBehind : mean;
}

/// Transmittance of an optical depth, Eq. (2): exp(-depth), 1 where rounding leaves traces below 0.
LIMPID_HD LIMPID_INLINE float Transmitted(float opticalDepth)
{
  return Attenuate(opticalDepth > 0.0f ? opticalDepth : 0.0f);
}
}

#endif
