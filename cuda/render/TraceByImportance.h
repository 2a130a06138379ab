// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Rays whose samples count by their importance; scene.importance is there.

#ifndef limpid_render_TraceByImportance_h
#define limpid_render_TraceByImportance_h

#include "methods/RayObject.h"
#include "methods/WeighedMean.h"
#include "render/TraceRay.h"

namespace limpid
{
/// The importance at sample `k` of a ray.
template <class AnySampler>
LIMPID_HD LIMPID_INLINE float ImportanceAt(const RayScene& scene, const Ray& ray, int k)
{
  const float distance = ray.At(k);
  const float position[3] = { ray.entry[0] + distance * ray.step[0],
    ray.entry[1] + distance * ray.step[1], ray.entry[2] + distance * ray.step[2] };
  const CellPlace place(scene.grid, position);
  return AnySampler::Interpolate(scene.grid, scene.importance + place.cell, place.fraction[0],
    place.fraction[1], place.fraction[2]);
}

/**
 * Adds to a pixel what its ray meets from its most important object on (RayObject), Eqs. (1) to
 * (6). Bricks without importance (scene.unimportant) are no objects: there, nothing is read.
 */
template <class AnySampler, bool Lit, bool Overlaid>
LIMPID_HD LIMPID_INLINE void TraceFromObject(
  const RayScene& scene, const Ray& ray, Pixel<typename AnySampler::Optical>& pixel)
{
  const BrickWalk walk(scene.unimportant, ray);
  RayObject object;
  for (int k = 0; k <= ray.segments; ++k)
  {
    if (scene.unimportant.distance && k % BrickDistances::size == 0 && k < ray.segments)
    {
      const int important = walk.SkipEmpty(k);
      if (important >= ray.segments)
      {
        break;
      }
      if (important > k)
      {
        object.Meet(ray.At(important > 0 ? important - 1 : 0), 0);
        k = important;
      }
    }
    object.Meet(ray.At(k), ImportanceAt<AnySampler>(scene, ray, k));
  }
  object.begin > 0.0f ? TraceRay<AnySampler, Lit, Overlaid>(scene, ray.From(object.begin), pixel)
                      : TraceRay<AnySampler, Lit, Overlaid>(scene, ray, pixel);
}

/**
 * Gives a pixel the mean colour of its ray by importance (WeighedMean). Where something important
 * was met, what is not important counts for the opacity alone: it is not lit, and skipped where the
 * pixel is opaque (scene.opaqueBelow).
 */
template <class AnySampler, bool Lit, bool Overlaid>
LIMPID_HD LIMPID_INLINE void TraceMean(
  const RayScene& scene, const Ray& ray, Pixel<typename AnySampler::Optical>& pixel)
{
  constexpr int segments = AnySampler::segments;
  const float lengthUnit = scene.stepLength * scene.majorant;
  const BrickWalk filled(scene.bricks, ray);
  const BrickWalk important(scene.unimportant, ray);
  WeighedMean<typename AnySampler::Optical> mean;
  RaySamples<AnySampler> samples;
  for (int k = 0; k < ray.segments; k += segments)
  {
    const bool opaque = mean.importance > 0.0f && mean.Transmittance() <= scene.opaqueBelow;
    k = scene.bricks.distance ? (opaque ? important : filled).SkipEmpty(k) : k;
    if (k >= ray.segments)
    {
      break;
    }
    samples.template Place<0, segments + 1, Overlaid>(scene, ray, k);
    samples.template Read<0, segments + 1, Overlaid>(scene);
    if (!samples.Classify(scene))
    {
      continue;
    }
    float importance[segments + 1];
    float any = 0;
    AnySampler::template InterpolateAll<0, segments + 1>(scene.grid, scene.importance, samples.cell,
      samples.fraction[0], samples.fraction[1], samples.fraction[2], importance);
    for (int i = 0; i <= segments; ++i)
    {
      any += importance[i];
    }
    const bool lit = Lit && (any > 0.0f || mean.importance == 0.0f);
    if (lit)
    {
      samples.template Light<0, segments + 1, Overlaid>(scene, ray);
    }
    for (int i = 0; i < segments; ++i)
    {
      const float length = samples.distance[i + 1] - samples.distance[i];
      const float received = lit ? 0.5f * (samples.light[i] + samples.light[i + 1]) : 0.0f;
      const float sent = Lit ? received : 1.0f;
      mean.Add(0.5f * (importance[i] + importance[i + 1]),
        samples.extinction[i] * lengthUnit * length, sent, samples.Color(i));
    }
  }
  pixel.light = mean.Light();
  pixel.transmittance = mean.Transmittance();
}

/// Adds to a pixel what its ray meets, in the way of a method.
template <Compositing compositing, class AnySampler, bool Lit, bool Overlaid>
LIMPID_HD LIMPID_INLINE void TraceAs(
  const RayScene& scene, const Ray& ray, Pixel<typename AnySampler::Optical>& pixel)
{
  switch (compositing)
  {
    case Compositing::FrontToBack:
      return TraceRay<AnySampler, Lit, Overlaid>(scene, ray, pixel);
    case Compositing::FromObject:
      return TraceFromObject<AnySampler, Lit, Overlaid>(scene, ray, pixel);
    case Compositing::ImportanceMean:
      return TraceMean<AnySampler, Lit, Overlaid>(scene, ray, pixel);
  }
}
}

#endif
