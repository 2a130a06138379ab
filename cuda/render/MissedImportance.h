// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Computes what a picture misses of the importance g, for all backends.

#ifndef limpid_render_MissedImportance_h
#define limpid_render_MissedImportance_h

#include "math/Exp.h"
#include "render/Segment.h"

namespace limpid
{
/**
 * What a ray shows of important structures and what it could show, accumulated from its end to the
 * viewer. mu-bar is the extinction of the transfer function, mu the one that is shown, and kappa
 * the smaller of both.
 *
 * The missed matter g (mu-bar - kappa T_V) is the sum of what was removed, g (mu-bar - kappa), and
 * what is hidden, g kappa (1 - T_V). But an opaque structure hides its own inside, which nobody
 * misses. So hidden matter counts only if another extinction between 0 and mu-bar would show it in
 * this pixel. Along one ray, the best such extinction keeps everything where g exceeds what is seen
 * behind, and nothing elsewhere (Documentation/Method.md, section on pictures). Removed matter
 * counts by the light that passes from it to the viewer.
 *
 * The paint is placed where the missed matter would be seen. It covers less important matter that
 * hides it, and is behind visible important matter, which it must not mark as missed.
 */
struct RayImportance
{
  float shown = 0;    ///< the integral of g kappa T_V dt [0, 1]
  float possible = 0; ///< the largest value of this integral for any extinction from 0 to mu-bar
                      ///< [0, 1]
  float removed = 0;  ///< the integral of g (mu-bar - kappa) T_V dt
  float painted = 0;  ///< part of possible - shown that no important visible matter is in front of
                      ///< [0, 1]

  /// Adds a segment in front. `importance`: g [0, 1]; `base` and `depth`: its optical depths with
  /// mu-bar and mu, each constant along the segment.
  LIMPID_HD LIMPID_INLINE void AddInFront(float importance, float base, float depth)
  {
    const float stopped = Stop(depth);
    const float baseStopped = Stop(base);
    const float passed = 1.0f - stopped;
    const float meanPassed = depth > 0.0f ? stopped / depth : 1.0f; // mean along the segment
    const float keptShare = base < depth ? base / depth : 1.0f;
    const float lost = depth < base ? base - depth : 0.0f;
    const float withIt = baseStopped * importance + (1.0f - baseStopped) * this->possible;
    const float hiddenBehind = this->Hidden();
    this->shown = keptShare * stopped * importance + passed * this->shown;
    this->possible = withIt > this->possible ? withIt : this->possible;
    this->removed = importance * lost * meanPassed + passed * this->removed;
    const float thicker = AtLeast(base, depth);
    const float there = thicker > 0.0f ? AtMost(base, depth) / thicker : 0.0f;
    this->CoverPaint(importance, there, stopped, hiddenBehind);
  }

  /// Returns whether there was nothing important so far; in this case, unimportant matter changes
  /// nothing.
  LIMPID_HD LIMPID_INLINE bool IsEmpty() const
  {
    return this->possible == 0.0f && this->shown == 0.0f && this->removed == 0.0f;
  }

  /// Returns the share of the pixel that misses something hidden or removed [0, 1].
  LIMPID_HD LIMPID_INLINE float Missed() const
  {
    return 1.0f - (1.0f - this->painted) * Attenuate(this->removed);
  }

private:
  /// Returns the share of the pixel in which something is hidden [0, 1].
  LIMPID_HD LIMPID_INLINE float Hidden() const
  {
    return AtLeast(this->possible - this->shown, 0.0f);
  }

  /// Puts a segment in front of the paint. It covers the paint according to its importance relative
  /// to what could be seen. What the segment itself hides is painted over it, except for that
  /// cover. `there`: share of its matter that is shown; `hiddenBehind`: what is hidden without it.
  LIMPID_HD LIMPID_INLINE void CoverPaint(
    float importance, float there, float stopped, float hiddenBehind)
  {
    const float lacking = this->possible > 0.0f ? 1.0f - importance / this->possible : 1.0f;
    const float less = AtLeast(lacking, 0.0f);
    const float covering = there * (1.0f - less * less);
    const float hidden = this->Hidden();
    const float grown = AtLeast(hidden - hiddenBehind, 0.0f);
    const float left = (1.0f - covering * stopped) * this->painted;
    this->painted = AtMost(left + (1.0f - covering) * grown, hidden);
  }
};

/// Blends the colour of missed structures over a pixel.
struct MissedPaint
{
  static constexpr float mostOpacity = 0.7f; ///< keeps the pixel's own content visible

  float color[3]; ///< [0, 1]

  /// Returns the opacity over a pixel. It rises slowly at first, so that noise in the importance is
  /// not painted.
  LIMPID_HD static LIMPID_INLINE float Opacity(float missed)
  {
    return mostOpacity * missed * missed * (3.0f - 2.0f * missed);
  }

  LIMPID_HD LIMPID_INLINE Rgba Over(const Rgba& pixel, float missed) const
  {
    const float opacity = Opacity(missed);
    const auto over = [opacity](std::uint8_t value, float paint)
    { return static_cast<std::uint8_t>(Blend(float(value), 255.0f * paint, opacity) + 0.5f); };
    return { { over(pixel.values[0], this->color[0]), over(pixel.values[1], this->color[1]),
      over(pixel.values[2], this->color[2]), over(pixel.values[3], 1.0f) } };
  }
};
}

#endif
