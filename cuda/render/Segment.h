// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The effect of a ray segment between two samples on a pixel, for all backends.

#ifndef limpid_render_Segment_h
#define limpid_render_Segment_h

#include "math/Exp.h"
#include "render/RayLight.h"

namespace limpid
{
/// Quantities that determine the extinction of a segment, summed over its two samples.
template <class Number>
struct SegmentEnds
{
  Number filled; ///< each 1; less beside empty nodes
  Number kept;   ///< share of the transfer function's extinction [packedOne]
  Number added;  ///< [packedOne of addedUnit]

  /// Returns the extinction [majorant], including changes by the optimisation and empty nodes.
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

/// The integral of Eq. (1) over a segment whose extinction and colour are constant, and whose
/// lighting is linear in the optical depth.
template <class Number>
struct Segment
{
  Number depth;    ///< optical depth
  Number passed;   ///< share of the light from behind that passes
  Number absorbed; ///< 1 - passed

  LIMPID_HD LIMPID_INLINE explicit Segment(const Number& opticalDepth)
    : depth(opticalDepth)
    , passed(Attenuate(opticalDepth))
    , absorbed(1.0f - this->passed)
  {
  }

  /// Returns the mean of a linear quantity along the segment as seen by the viewer: its value at
  /// the mean visible depth. If little is absorbed, that is the midpoint.
  LIMPID_HD LIMPID_INLINE Number Mean(const Number& front, const Number& rear) const
  {
    return front + this->WeightOfRear() * (rear - front);
  }

private:
  /// Returns 1 / d - exp(-d) / (1 - exp(-d)), or its series.
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

/// The light that a pixel has received so far.
template <class Optical>
struct Pixel
{
  Optical light = { 0, 0, 0, 0 }; ///< second to fourth: red, green, blue
  float transmittance = 1;

  /// Returns the pixel in 8 bits. If the brightest channel would exceed the range over what is
  /// behind the pixel, all channels are scaled down equally, so that the hue is kept.
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
