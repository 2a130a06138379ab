// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_TraceRay_h
#define limpid_render_TraceRay_h

#include "render/RaySamples.h"

namespace limpid
{
/**
 * Adds to a pixel what its ray meets, Eqs. (1) to (6): it skips what is empty, reads the samples of
 * as many segments as AnySampler takes at a time, finds the extinction between them, lights them if
 * there is any, and adds the segments front to back until the pixel is opaque.
 *
 * `Lit`: whether scene.gradient is there; `Overlaid`: whether scene.overlay is.
 */
template <class AnySampler, bool Lit, bool Overlaid>
LIMPID_HD LIMPID_INLINE void TraceRay(
  const RayScene& scene, const Ray& ray, Pixel<typename AnySampler::Optical>& pixel)
{
  constexpr int segments = AnySampler::segments;
  const BrickWalk walk(scene.bricks, ray);
  RaySamples<AnySampler> samples;
  bool read = false; // whether the first sample was, as the last of the segments before
  bool lit = false;  // whether it was lit there
  int nextBrick = 0; // sample from which on another brick is looked up
  for (int k = ray.begin; k < ray.segments && pixel.transmittance > scene.opaqueBelow;
       k += segments)
  {
    if (scene.bricks.distance && k >= nextBrick)
    {
      const int filled = walk.SkipEmpty(k);
      if (filled >= ray.segments)
      {
        return;
      }
      read = read && filled == k;
      k = filled;
      nextBrick = k + BrickDistances::size;
    }
    if (!read)
    {
      samples.template Place<0, 1, Overlaid>(scene, ray, k);
      samples.template Read<0, 1, Overlaid>(scene);
      lit = false;
    }
    samples.template Place<1, segments + 1, Overlaid>(scene, ray, k);
    samples.template Read<1, segments + 1, Overlaid>(scene);
    const bool visible = samples.Classify(scene);
    if (Lit && visible)
    {
      if (!lit)
      {
        samples.template Place<0, 1, Overlaid>(scene, ray, k);
        samples.template Light<0, 1, Overlaid>(scene, ray);
      }
      samples.template Light<1, segments + 1, Overlaid>(scene, ray);
    }
    if (visible)
    {
      samples.template AddTo<Lit>(scene, pixel);
    }
    samples.MoveOn();
    read = true;
    lit = visible;
  }
}
}

#endif
