// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_TraceMissed_h
#define limpid_render_TraceMissed_h

#include "render/MissedImportance.h"
#include "render/RaySamples.h"

namespace limpid
{
/**
 * Accumulates what a ray shows and could show of important structures, from its end to the viewer.
 * It skips what is behind all important matter, and bare bricks: scene.bricks are those of
 * Bricks::BareDistances.
 *
 * `Overlaid`: whether there is scene.overlay. Requires scene.importance.
 */
template <class AnySampler, bool Overlaid>
LIMPID_HD LIMPID_INLINE RayImportance TraceMissed(const RayScene& scene, const Ray& ray)
{
  const Ray back = ray.Reversed();
  const BrickWalk<Ray> important(scene.unimportant, back);
  const BrickWalk<Ray> bare(scene.bricks, back);
  RayImportance gathered;
  RaySamples<AnySampler, Overlaid> samples;
  Ends<AnySampler> importance;
  for (int k = 0; k < back.segments; k = samples.last)
  {
    const bool anyBefore = samples.last == k && !gathered.IsEmpty();
    if (scene.bricks.distance && !(anyBefore && samples.lastFilled))
    {
      k = (gathered.IsEmpty() ? important : bare).SkipEmpty(k);
      if (k >= back.segments)
      {
        return gathered;
      }
    }
    samples.MoveOn(scene, back, k);
    importance.MoveOn(
      AnySampler::InterpolateAll(scene.grid, scene.importance, samples.place.scalars));
    samples.Classify(scene);
    const auto depth = samples.Depth(scene);
    const auto base = samples.BaseDepth(scene);
    const auto both = importance.Sum();
    for (int i = 0; i < AnySampler::count; ++i)
    {
      gathered.AddInFront(0.5f * LaneOf(both, i), LaneOf(base, i), LaneOf(depth, i));
    }
  }
  return gathered;
}
}

#endif
