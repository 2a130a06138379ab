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
struct SegmentEnds
{
  float filled; ///< each 1, less beside empty nodes
  float kept;   ///< share of the transfer function's extinction [packedOne]
  float added;  ///< [packedOne of addedUnit]

  /// Extinction with the change of the optimisation and without what is empty [majorant].
  /// `classified`: the transfer function's; `addedUnit`: [majorant].
  LIMPID_HD LIMPID_INLINE float Extinction(float classified, float addedUnit) const
  {
    const float most = addedUnit > 1.0f ? addedUnit : 1.0f;
    const float filledShare = 0.5f * this->filled;
    const float keptShare = (0.5f / packedOne) * this->kept;
    const float addedShare = (0.5f / packedOne) * addedUnit * this->added;
    const float extinction = classified * filledShare * keptShare + addedShare;
    return extinction < most ? extinction : most;
  }
};

/// The integral of Eq. (1) over a segment with extinction and colour constant and the light linear
/// in optical depth along it.
struct Segment
{
  float passed; ///< share of the light from behind
  float given;  ///< share of its colour that it sends

  /// `depth`: optical depth; front and rear: the light that the samples send, see LightOnRay.
  template <bool Lit>
  LIMPID_HD static LIMPID_INLINE Segment Of(float depth, float front, float rear)
  {
    const float passed = Attenuate(depth);
    const float absorbed = 1.0f - passed;
    if (!Lit)
    {
      return { passed, absorbed };
    }
    // Weight of the rear end: (1 - exp(-d) (1 + d)) / d, or its series.
    const float series = depth * (0.5f - depth * (1.0f / 3.0f - depth * 0.125f));
    const float exact = (absorbed - passed * depth) / (depth + 1e-30f);
    const float weight = depth > 0.05f ? exact : series;
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
    const float atLeast = value > 0.0f ? value : 0.0f;
    const float inside = atLeast < 1.0f ? atLeast : 1.0f;
    return static_cast<std::uint8_t>(inside * 255.0f + 0.5f);
  }
};
}

#endif
