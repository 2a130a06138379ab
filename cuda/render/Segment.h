// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What a segment of a ray between two samples does to a pixel, the same for all backends.

#ifndef limpid_render_Segment_h
#define limpid_render_Segment_h

#include "math/Exp.h"
#include "render/RayLight.h"

namespace limpid
{
/// What decides on the extinction of a segment, summed over its two samples.
template <class Number>
struct SegmentEnds
{
  Number filled; ///< each 1, less beside empty nodes
  Number kept;   ///< share of the transfer function's extinction [packedOne]
  Number added;  ///< [packedOne of addedUnit]

  /// Extinction with the change of the optimisation and without what is empty [majorant].
  /// `classified`: the transfer function's; `addedUnit`: [majorant].
  LIMPID_HD LIMPID_INLINE Number Extinction(const Number& classified, float addedUnit) const
  {
    const float most = AtLeast(addedUnit, 1.0f);
    const Number filledShare = 0.5f * this->filled;
    const Number keptShare = (0.5f / packedOne) * this->kept;
    const Number addedShare = (0.5f / packedOne) * addedUnit * this->added;
    const Number extinction = classified * filledShare * keptShare + addedShare;
    return AtMost(extinction, most);
  }
};

/// The integral of Eq. (1) over a segment with extinction and colour constant and what lights it
/// linear in optical depth along it.
template <class Number>
struct Segment
{
  Number depth;    ///< optical
  Number passed;   ///< share of the light from behind
  Number absorbed; ///< 1 less that

  LIMPID_HD LIMPID_INLINE explicit Segment(const Number& opticalDepth)
    : depth(opticalDepth)
    , passed(Attenuate(opticalDepth))
    , absorbed(1.0f - this->passed)
  {
  }

  /// The mean along it, as it is seen, of what is linear: its value where the viewer sees the
  /// segment on average. Where little is absorbed, that is the middle.
  LIMPID_HD LIMPID_INLINE Number Mean(const Number& front, const Number& rear) const
  {
    return front + this->WeightOfRear() * (rear - front);
  }

private:
  /// 1 / d - exp(-d) / (1 - exp(-d)), or its series.
  LIMPID_HD LIMPID_INLINE Number WeightOfRear() const
  {
    const Number series = 0.5f - this->depth * (1.0f / 12.0f);
    const Number exact = 1.0f / (this->depth + 1e-30f) - this->passed / (this->absorbed + 1e-30f);
    return Select(this->depth > 0.05f, exact, series);
  }
};

/// A pixel of a picture, see Picture.
struct alignas(4) Rgba
{
  std::uint8_t values[4];
};

/// What a pixel has received so far.
template <class Optical>
struct Pixel
{
  Optical light = { 0, 0, 0, 0 }; ///< second to fourth: red, green, blue
  float transmittance = 1;

  /// In 8 bits. Strong light is toned down where its brightest channel would not fit over what is
  /// behind the pixel, all channels alike, so that the hue stays.
  LIMPID_HD LIMPID_INLINE Rgba Shown() const
  {
    const float alpha = 1.0f - this->transmittance;
    const float ofTwo = AtLeast(this->light[1], this->light[2]);
    const float brightest = AtLeast(this->light[3], ofTwo);
    const float tone = brightest > alpha ? alpha / brightest : 1.0f;
    return { { ToByte(this->light[1] * tone), ToByte(this->light[2] * tone),
      ToByte(this->light[3] * tone), ToByte(alpha) } };
  }

private:
  LIMPID_HD static LIMPID_INLINE std::uint8_t ToByte(float value)
  {
    return static_cast<std::uint8_t>(Clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f);
  }
};
}

#endif
