// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Rays, and where they are inside the box of the nodes.

#ifndef limpid_testing_Rays_h
#define limpid_testing_Rays_h

#include "RayMarch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace truth
{
const double infinity = std::numeric_limits<double>::infinity();

inline double Dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vector Minus(const Vector& a, const Vector& b)
{
  return { { a[0] - b[0], a[1] - b[1], a[2] - b[2] } };
}

/// point + factor * direction
inline Vector Along(const Vector& point, double factor, const Vector& direction)
{
  return { { point[0] + factor * direction[0], point[1] + factor * direction[1],
    point[2] + factor * direction[2] } };
}

inline Vector Unit(const Vector& a)
{
  const double length = std::sqrt(Dot(a, a));
  return { { a[0] / length, a[1] / length, a[2] / length } };
}

/// x = origin + t direction, in index space.
struct Ray
{
  Vector origin;
  Vector direction;
};

struct Interval
{
  double begin = 0;
  double end = -1;
  bool Empty() const { return !(begin < end); }
};

/// Where a ray is inside the box of the nodes, not before t = first.
inline Interval Clip(const Ray& ray, const std::array<int, 3>& nodes, double first)
{
  Interval inside{ first, infinity };
  for (int c = 0; c < 3; ++c)
  {
    const double last = nodes[c] - 1;
    if (ray.direction[c] == 0)
    {
      if (ray.origin[c] < 0 || ray.origin[c] > last)
      {
        return {};
      }
      continue;
    }
    const double one = (0 - ray.origin[c]) / ray.direction[c];
    const double other = (last - ray.origin[c]) / ray.direction[c];
    inside.begin = std::max(inside.begin, std::min(one, other));
    inside.end = std::min(inside.end, std::max(one, other));
  }
  return inside;
}
}

#endif
