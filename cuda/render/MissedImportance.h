// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What a picture misses of the importance g, the same for all backends.

#ifndef limpid_render_MissedImportance_h
#define limpid_render_MissedImportance_h

#include "math/Exp.h"
#include "render/Segment.h"

namespace limpid
{
/**
 * What a ray shows of what is important, and what it could show, gathered from its end to the
 * viewer, with mu-bar the extinction of the transfer function, mu the one that is shown, and kappa
 * the lesser of both.
 *
 * The missed matter g (mu-bar - kappa T_V) is what was removed, g (mu-bar - kappa), and what is
 * hidden, g kappa (1 - T_V). But an opaque structure hides its own inside and nobody misses that,
 * so of the hidden counts what another extinction from 0 to mu-bar would bring to light in this
 * pixel: along one ray the best one keeps all where g is above what is seen behind, and nothing
 * elsewhere (Documentation/Method.md, section on pictures). Of the removed counts what light passes
 * on its way to the viewer.
 *
 * The paint lies where the missed matter would be seen: over what hides it and is less important,
 * and behind what is important itself and is seen, which the paint would declare missed.
 */
struct RayImportance
{
  float shown = 0;    ///< the integral of g kappa T_V dt [0, 1]
  float possible = 0; ///< the largest that it has with any extinction from 0 to mu-bar [0, 1]
  float removed = 0;  ///< the integral of g (mu-bar - kappa) T_V dt
  float painted = 0;  ///< of possible - shown, what nothing important is seen in front of [0, 1]

  /// Puts a segment in front. `importance`: g [0, 1]; `base` and `depth`: its optical depths with
  /// mu-bar and mu, each constant along it.
  LIMPID_HD LIMPID_INLINE void AddInFront(float importance, float base, float depth)
  {
    const float stopped = Stop(depth);
    const float baseStopped = Stop(base);
    const float passed = 1.0f - stopped;
    const float meanPassed = depth > 0.0f ? stopped / depth : 1.0f; // along the segment
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

  /// Whether there has been nothing important so far; what is not, changes nothing then.
  LIMPID_HD LIMPID_INLINE bool IsEmpty() const
  {
    return this->possible == 0.0f && this->shown == 0.0f && this->removed == 0.0f;
  }

  /// The share of the pixel that misses something [0, 1]: hidden, removed or both.
  LIMPID_HD LIMPID_INLINE float Missed() const
  {
    return 1.0f - (1.0f - this->painted) * Attenuate(this->removed);
  }

private:
  /// The share of the pixel in which something is hidden [0, 1].
  LIMPID_HD LIMPID_INLINE float Hidden() const
  {
    return AtLeast(this->possible - this->shown, 0.0f);
  }

  /// Puts a segment in front of the paint: it covers that, the more the more important it is next
  /// to what could be seen. What it hides itself is painted over it, but for that cover.
  /// `there`: share of its matter that is shown; `hiddenBehind`: what is hidden without it.
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

/// The colour of what is missed, over a pixel.
struct MissedPaint
{
  static constexpr float mostOpacity = 0.7f; ///< what is there stays to be seen

  float color[3]; ///< [0, 1]

  /// Opacity over a pixel: slow at first, so that the noise of an importance paints nothing.
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
