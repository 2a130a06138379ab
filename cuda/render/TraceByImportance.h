// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Rays that weight samples by importance. Requires scene.importance.

#ifndef limpid_render_TraceByImportance_h
#define limpid_render_TraceByImportance_h

#include "methods/RayObject.h"
#include "methods/WeighedMean.h"
#include "render/TraceRay.h"

namespace limpid
{
/**
 * Returns the part of a ray from its most important object on (RayObject). Bricks without
 * importance (scene.unimportant) contain no objects and are not read.
 */
template <class AnySampler>
LIMPID_HD LIMPID_INLINE Ray PartFromObject(const RayScene& scene, const Ray& ray)
{
  const BrickWalk<Ray> walk(scene.unimportant, ray);
  RayObject object;
  RayPlaces<AnySampler> place;
  int nextBrick = 0; // first sample of the next brick
  for (int k = 0; k <= ray.segments; k += AnySampler::count)
  {
    if (scene.unimportant.distance && k >= nextBrick && k < ray.segments)
    {
      const int important = walk.SkipEmpty(k);
      if (important >= ray.segments)
      {
        break;
      }
      if (important > k)
      {
        object.Meet(ray.At(important - 1), 0);
        k = important;
      }
      nextBrick = k + BrickDistances::size;
    }
    place.Set(scene, ray, k);
    const auto importance = AnySampler::InterpolateAll(scene.grid, scene.importance, place.scalars);
    for (int i = 0; i < AnySampler::count; ++i)
    {
      object.Meet(LaneOf(place.distance, i), LaneOf(importance, i));
    }
  }
  return object.begin > 0.0f ? ray.From(object.begin) : ray;
}

/**
 * Sets a pixel to the mean colour of its ray weighted by importance (WeighedMean). If the ray meets
 * important structures, unimportant matter only contributes to the opacity: it is not lit, and
 * skipped if the pixel is opaque (scene.opaqueBelow).
 */
template <class AnySampler, bool Overlaid>
LIMPID_HD LIMPID_INLINE void TraceMean(const RayScene& scene, const Ray& ray, const RayLook& look,
  Pixel<typename AnySampler::Optical>& pixel)
{
  const BrickWalk<Ray> filled(scene.bricks, ray);
  const BrickWalk<Ray> important(scene.unimportant, ray);
  WeighedMean<typename AnySampler::Optical> mean;
  RaySamples<AnySampler, Overlaid> samples;
  Ends<AnySampler> importance;
  // Whether the brick of sample k is known to be filled, or the walk past empty ones ended there.
  bool goOn = ray.skipped;
  for (int k = ray.begin; k < ray.segments; k = samples.last, goOn = samples.lastFilled)
  {
    const bool opaque = mean.HasImportance() && mean.Transmittance() <= scene.opaqueBelow;
    if (scene.bricks.distance && (opaque || !goOn))
    {
      k = (opaque ? important : filled).SkipEmpty(k);
      if (k >= ray.segments)
      {
        break;
      }
    }
    samples.MoveOn(scene, ray, k);
    importance.MoveOn(
      AnySampler::InterpolateAll(scene.grid, scene.importance, samples.place.scalars));
    if (!samples.Classify(scene))
    {
      continue;
    }
    const auto both = importance.Sum();
    const auto depth = samples.Depth(scene);
    if (mean.HasImportance() && !AnyOf(both > 0.0f))
    {
      for (int i = 0; i < AnySampler::count; ++i)
      {
        mean.AddUnseen(LaneOf(depth, i));
      }
      continue;
    }
    if (look.lit)
    {
      samples.Light(scene, ray);
    }
    const auto sent = look.lit ? samples.SentOnAverage(scene) : typename AnySampler::Lanes(1.0f);
    samples.ForColors(
      scene, ray, look.tinted, [&](int i) LIMPID_INLINE_LAMBDA { return samples.Color(i); },
      [](int) LIMPID_INLINE_LAMBDA { return 1.0f; },
      [&](int i, const auto& color) LIMPID_INLINE_LAMBDA
      { mean.Add(0.5f * LaneOf(both, i), LaneOf(depth, i), LaneOf(sent, i), color); });
  }
  pixel.light = mean.Light();
  pixel.transmittance = mean.Transmittance();
}
}

#endif
