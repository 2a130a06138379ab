// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_methods_WeighedMean_h
#define limpid_methods_WeighedMean_h

#include "math/Exp.h"
#include "math/Macros.h"

namespace limpid
{
/**
 * The colour of a pixel according to Marchesin et al. [MMD10], as in Section 4.3 of [HG24]. It is
 * the mean colour of the samples on a ray, independent of their order and weighted by importance
 * times optical depth. It covers the background with the opacity of the base extinction. If
 * nothing on the ray is important, all samples have the same importance, which is the limit when
 * all importance tends to 0.
 *
 * `Optical`: a colour with arithmetic.
 */
template <class Optical>
struct WeighedMean
{
  /// Sums of importance and optical depth up to this value are rounding errors. Where rays enter
  /// next to important structures, they would colour single pixels.
  static constexpr float least = 1e-9f;

  Optical important = { 0, 0, 0, 0 }; ///< sum of importance times optical depth times colour
  Optical plain = { 0, 0, 0, 0 };     ///< sum of depth times colour, until any is important
  float importance = 0;               ///< sum of importance times optical depth
  float depth = 0;                    ///< sum of optical depth

  /// Adds a segment. `light`: fraction of its colour that it sends to the viewer.
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

  /// Adds an unimportant segment after an important one; its colour does not count.
  LIMPID_HD LIMPID_INLINE void AddUnseen(float depthHere) { this->depth += depthHere; }

  /// Whether anything important was met; if not, all samples count as equally important.
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

/// Returns the transmittance of samples that share the opacity of a ray equally [0, 1]: the mean
/// of exp(-t) for t up to the optical depth of the ray.
LIMPID_HD LIMPID_INLINE float EqualTransmittance(float opticalDepth)
{
  constexpr float small = 1e-3f; // the series has an error of its third term, 2e-7 relative to 1
  return opticalDepth > small ? Stop(opticalDepth) / opticalDepth
                              : 1.0f - opticalDepth * (0.5f - opticalDepth * (1.0f / 6.0f));
}
}

#endif
