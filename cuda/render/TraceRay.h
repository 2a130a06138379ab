// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_TraceRay_h
#define limpid_render_TraceRay_h

#include "render/RaySamples.h"

namespace limpid
{
/**
 * Adds a ray to a pixel, Eqs. (1) to (6). It skips empty parts, advances by as many samples as
 * AnySampler processes at a time, computes the extinction between them, lights them if there is
 * any, and adds the segments front to back until the pixel is opaque.
 *
 * `Overlaid`: whether there is scene.overlay.
 */
template <class AnySampler, bool Overlaid>
LIMPID_HD LIMPID_INLINE void TraceRay(const RayScene& scene, const Ray& ray, const RayLook& look,
  Pixel<typename AnySampler::Optical>& pixel)
{
  const BrickWalk<Ray> walk(scene.bricks, ray);
  RaySamples<AnySampler, Overlaid> samples;
  Pixel<typename AnySampler::Optical> received = pixel; // a local copy, which cannot alias anything
  // Whether the brick of sample k is known to be filled, or the walk past empty ones ended there.
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
      if (look.lit)
      {
        samples.Light(scene, ray);
      }
      samples.AddTo(scene, ray, look, received);
    }
  }
  pixel = received;
}
}

#endif
