// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The part of a ray in the owned nodes, for all backends.

#ifndef limpid_render_RayPart_h
#define limpid_render_RayPart_h

#include "render/DrawnPart.h"
#include "render/Ray.h"

#include <limits>

namespace limpid
{
/**
 * Cuts rays through a whole grid to the segments whose midpoints are in a box of nodes, half-open
 * along each axis. Boxes that partition the grid get each segment once, with the samples of the
 * whole ray. Positions then count from the node where the arrays begin.
 */
struct RayPart
{
  float low[3];
  float high[3];
  float first[3];

  /// Cuts to the owned nodes, which are unbounded at the faces of the whole.
  explicit RayPart(const DrawnPart& drawn)
  {
    const NodeBox& box = drawn.Owned();
    const Int3& whole = drawn.Whole().nodes;
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis)
    {
      const Range<int>& along = box.along[std::size_t(axis)];
      this->low[axis] = along.begin > 0 ? float(along.begin) : -infinity;
      this->high[axis] = along.end < whole[axis] ? float(along.end) : infinity;
      this->first[axis] = float(drawn.Box().along[std::size_t(axis)].begin);
      if (box.Empty())
      {
        this->low[axis] = infinity;
      }
    }
  }

  LIMPID_HD LIMPID_INLINE void Cut(Ray& ray) const
  {
    int begin = 0;
    int end = ray.segments;
    for (int axis = 0; axis < 3; ++axis)
    {
      const bool rises = ray.step[axis] >= 0;
      const int in = this->FirstBeyond(ray, axis, rises ? this->low[axis] : this->high[axis]);
      const int out = this->FirstBeyond(ray, axis, rises ? this->high[axis] : this->low[axis]);
      begin = begin < in ? in : begin;
      end = out < end ? out : end;
      ray.entry[axis] -= this->first[axis];
    }
    ray.length = ray.At(end);
    ray.segments = begin < end ? end : 0;
    ray.begin = begin < end ? begin : 0;
  }

private:
  /// Returns the number of the first segment of a ray whose midpoint is at or above a bound if the
  /// ray ascends along that axis, or below it if it descends.
  LIMPID_HD static LIMPID_INLINE int FirstBeyond(const Ray& ray, int axis, float bound)
  {
    const bool rises = ray.step[axis] >= 0;
    int before = -1;
    int beyond = ray.segments;
    while (beyond - before > 1)
    {
      const int segment = (before + beyond) / 2;
      const float middle = 0.5f * (ray.At(segment) + ray.At(segment + 1));
      const float position = ray.entry[axis] + middle * ray.step[axis];
      const bool isBeyond = rises ? position >= bound : position < bound;
      (isBeyond ? beyond : before) = segment;
    }
    return beyond;
  }
};
}

#endif
