// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// For the processor alone.

#ifndef limpid_render_RayLanes_h
#define limpid_render_RayLanes_h

#include "math/FloatLanes.h"
#include "render/Ray.h"

namespace limpid
{
/// Sixteen rays side by side, with the members that determine their course; see Ray.
struct RayLanes
{
  using Number = FloatLanes;
  using Integer = IntLanes;
  static constexpr int count = FloatLanes::count;

  FloatLanes entry[3];
  FloatLanes step[3];
  FloatLanes length;
  FloatLanes shift;
  IntLanes segments;
  IntLanes begin;

  LIMPID_INLINE explicit RayLanes(const Ray* rays)
    : length(Of<float>(rays, [](const Ray& ray) { return ray.length; }))
    , shift(Of<float>(rays, [](const Ray& ray) { return ray.shift; }))
    , segments(Of<std::int32_t>(rays, [](const Ray& ray) { return ray.segments; }))
    , begin(Of<std::int32_t>(rays, [](const Ray& ray) { return ray.begin; }))
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->entry[axis] = Of<float>(rays, [axis](const Ray& ray) { return ray.entry[axis]; });
      this->step[axis] = Of<float>(rays, [axis](const Ray& ray) { return ray.step[axis]; });
    }
  }

private:
  template <class Any, class Get>
  static LIMPID_INLINE LanesOf<Any> Of(const Ray* rays, const Get& get)
  {
    alignas(32) Any numbers[count];
    for (int i = 0; i < count; ++i)
    {
      numbers[i] = get(rays[i]);
    }
    return LanesOf<Any>::Load(numbers);
  }
};
}

#endif
