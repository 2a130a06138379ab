// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_TraceMissed_h
#define limpid_render_TraceMissed_h

#include "render/MissedImportance.h"
#include "render/RaySamples.h"

namespace limpid
{
/// RaySamples of a ray that runs to the viewer, and how important they are.
template <class AnySampler, bool Overlaid>
struct ImportanceSamples
{
  static constexpr int segments = AnySampler::segments;

  RaySamples<AnySampler> samples;
  float importance[segments + 1];

  LIMPID_HD LIMPID_INLINE ImportanceSamples() { this->importance[0] = 0; }

  LIMPID_HD LIMPID_INLINE void MoveOn()
  {
    this->samples.MoveOn();
    this->importance[0] = this->importance[segments];
  }

  template <int Begin, int End>
  LIMPID_HD LIMPID_INLINE void Read(const RayScene& scene, const Ray& ray, int k)
  {
    this->samples.template Place<Begin, End, Overlaid>(scene, ray, k);
    this->samples.template Read<Begin, End, Overlaid>(scene);
    AnySampler::template InterpolateAll<Begin, End>(scene.grid, scene.importance,
      this->samples.cell, this->samples.fraction[0], this->samples.fraction[1],
      this->samples.fraction[2], this->importance);
  }

  LIMPID_HD LIMPID_INLINE void AddTo(const RayScene& scene, RayImportance& pixel)
  {
    this->samples.Classify(scene);
    const float lengthUnit = scene.stepLength * scene.majorant;
    for (int i = 0; i < segments; ++i)
    {
      const float length = this->samples.distance[i + 1] - this->samples.distance[i];
      const float filled = 0.5f * (this->samples.filled[i] + this->samples.filled[i + 1]);
      const float base = this->samples.classified[i] * filled;
      pixel.AddInFront(0.5f * (this->importance[i] + this->importance[i + 1]),
        base * lengthUnit * length, this->samples.extinction[i] * lengthUnit * length);
    }
  }
};

/**
 * Gathers what a ray shows and could show of what is important, from its end to the viewer. It
 * skips what lies behind everything important, and what is bare: scene.bricks are those of
 * Bricks::BareDistances.
 *
 * `Overlaid`: whether scene.overlay is there. scene.importance is.
 */
template <class AnySampler, bool Overlaid>
LIMPID_HD LIMPID_INLINE RayImportance TraceMissed(const RayScene& scene, const Ray& ray)
{
  constexpr int segments = AnySampler::segments;
  const Ray back = ray.Reversed();
  const BrickWalk important(scene.unimportant, back);
  const BrickWalk bare(scene.bricks, back);
  RayImportance gathered;
  ImportanceSamples<AnySampler, Overlaid> samples;
  bool read = false; // whether the first sample was, as the last of the segments before
  int nextBrick = 0; // sample from which on another brick is looked up
  for (int k = 0; k < back.segments; k += segments)
  {
    if (scene.bricks.distance && k >= nextBrick)
    {
      const int filled = (gathered.IsEmpty() ? important : bare).SkipEmpty(k);
      if (filled >= back.segments)
      {
        return gathered;
      }
      read = read && filled == k;
      k = filled;
      nextBrick = k + BrickDistances::size;
    }
    if (!read)
    {
      samples.template Read<0, 1>(scene, back, k);
    }
    samples.template Read<1, segments + 1>(scene, back, k);
    samples.AddTo(scene, gathered);
    samples.MoveOn();
    read = true;
  }
  return gathered;
}
}

#endif
