// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_TraceRay_h
#define limpid_render_TraceRay_h

#include "render/RaySamples.h"

namespace limpid
{
/**
 * Adds to a pixel what its ray meets, Eqs. (1) to (6): it skips what is empty, moves on by as many
 * samples as AnySampler takes at a time, finds the extinction between them, lights them if there is
 * any, and adds the segments front to back until the pixel is opaque.
 *
 * `Lit`: whether scene.gradient is there; `Overlaid`: whether scene.overlay is.
 */
template <class AnySampler, bool Lit, bool Overlaid>
LIMPID_HD LIMPID_INLINE void TraceRay(
  const RayScene& scene, const Ray& ray, Pixel<typename AnySampler::Optical>& pixel)
{
  const BrickWalk<Ray> walk(scene.bricks, ray);
  RaySamples<AnySampler, Overlaid> samples;
  Pixel<typename AnySampler::Optical> received = pixel; // nothing else can change that meanwhile
  // Whether the brick of sample k is known to be filled, or the walk past empty ones to end there.
  bool goOn = ray.skipped;
  for (int k = ray.begin; k < ray.segments && received.transmittance > scene.opaqueBelow;
       k = samples.last, goOn = samples.lastFilled)
  {
    if (scene.bricks.distance && !goOn)
    {
      k = walk.SkipEmpty(k);
      if (k >= ray.segments)
      {
        break;
      }
    }
    samples.MoveOn(scene, ray, k);
    if (samples.Classify(scene))
    {
      if (Lit)
      {
        samples.Light(scene, ray);
      }
      samples.template AddTo<Lit>(scene, received);
    }
  }
  pixel = received;
}
}

#endif
