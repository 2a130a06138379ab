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

/// The integral of Eq. (1) over a segment with extinction and colour constant and the light linear
/// in optical depth along it.
template <class Number>
struct Segment
{
  Number passed; ///< share of the light from behind
  Number given;  ///< share of its colour that it sends

  /// `depth`: optical depth; front and rear: the light that the samples send, see LightOnRay.
  template <bool Lit>
  LIMPID_HD static LIMPID_INLINE Segment Of(
    const Number& depth, const Number& front, const Number& rear)
  {
    const Number passed = Attenuate(depth);
    const Number absorbed = 1.0f - passed;
    if (!Lit)
    {
      return { passed, absorbed };
    }
    // Weight of the rear end: (1 - exp(-d) (1 + d)) / d, or its series.
    const Number series = depth * (0.5f - depth * (1.0f / 3.0f - depth * 0.125f));
    const Number exact = (absorbed - passed * depth) / (depth + 1e-30f);
    const Number weight = Select(depth > 0.05f, exact, series);
    return { passed, (absorbed - weight) * front + weight * rear };
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

  /// In 8 bits.
  LIMPID_HD LIMPID_INLINE Rgba Shown(const float* lightColor) const
  {
    return { { ToByte(this->light[1] * lightColor[0]), ToByte(this->light[2] * lightColor[1]),
      ToByte(this->light[3] * lightColor[2]), ToByte(1.0f - this->transmittance) } };
  }

private:
  LIMPID_HD static LIMPID_INLINE std::uint8_t ToByte(float value)
  {
    return static_cast<std::uint8_t>(Clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f);
  }
};
}

#endif
