// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_methods_WeighedMean_h
#define limpid_methods_WeighedMean_h

#include "math/Exp.h"
#include "math/Macros.h"

namespace limpid
{
/**
 * What a pixel is by Marchesin et al. [MMD10], as [HG24] has it in Section 4.3: the mean colour of
 * the samples on a ray, in no order, each with the weight importance times optical depth, over the
 * background with the transmittance of the base extinction. Where nothing on the ray is important,
 * all samples are equally so, which is what the mean tends to when all importance becomes small.
 *
 * `Optical`: has colours and their arithmetic.
 */
template <class Optical>
struct WeighedMean
{
  /// A sum of importance and optical depth up to this comes of rounding errors: where rays enter
  /// beside something important, it would colour one pixel and not the next.
  static constexpr float least = 1e-9f;

  Optical important = { 0, 0, 0, 0 }; ///< sum of importance, optical depth and colour
  Optical plain = { 0, 0, 0, 0 };     ///< ... of optical depth and colour, until any is important
  float importance = 0;               ///< sum of importance and optical depth
  float depth = 0;                    ///< optical depth

  /// A segment. `light`: share of its colour that it sends to the viewer.
  LIMPID_HD LIMPID_INLINE void Add(
    float importanceHere, float depthHere, float light, const Optical& color)
  {
    const float weight = importanceHere * depthHere;
    this->important = this->important + weight * light * color;
    if (!this->HasImportance())
    {
      this->plain = this->plain + depthHere * light * color;
    }
    this->importance += weight;
    this->depth += depthHere;
  }

  /// A segment that is not important, while something else is: its colour does not count.
  LIMPID_HD LIMPID_INLINE void AddUnseen(float depthHere) { this->depth += depthHere; }

  /// Whether anything important was met; else all samples are equally so.
  LIMPID_HD LIMPID_INLINE bool HasImportance() const { return this->importance > least; }

  LIMPID_HD LIMPID_INLINE float Transmittance() const { return Attenuate(this->depth); }

  /// Light that reaches the viewer.
  LIMPID_HD LIMPID_INLINE Optical Light() const
  {
    const float opacity = 1.0f - this->Transmittance();
    if (this->HasImportance())
    {
      return (opacity / this->importance) * this->important;
    }
    constexpr float tiny = 1e-30f;
    return (this->depth > tiny ? opacity / this->depth : 0.0f) * this->plain;
  }
};

/// The transmittance that all samples of a ray have if they share its opacity equally [0, 1]: mean
/// of exp(-t) for t up to the optical depth of the ray.
LIMPID_HD LIMPID_INLINE float EqualTransmittance(float opticalDepth)
{
  constexpr float small = 1e-3f; // the series is off by its third term, 2e-7 of 1
  return opticalDepth > small ? Stop(opticalDepth) / opticalDepth
                              : 1.0f - opticalDepth * (0.5f - opticalDepth * (1.0f / 6.0f));
}
}

#endif
