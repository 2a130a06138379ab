// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The rays of a picture, for all backends.

#ifndef limpid_render_Ray_h
#define limpid_render_Ray_h

#include "math/Number.h"
#include "math/Vec.h"
#include "render/Renderer.h"

#include <cmath>

namespace limpid
{
/// Returns the distance of sample number `sample` of a ray from its entry [samples]. Works for one
/// sample of one ray, one sample each of several rays, or several samples of one ray.
template <class AnyRay, class Number>
LIMPID_HD LIMPID_INLINE Number DistanceOf(const AnyRay& ray, const Number& sample)
{
  return Clamp(Number(sample - ray.shift), 0.0f, ray.length);
}

/// One ray, with samples numbered from its entry into the box.
struct Ray
{
  using Number = float;
  using Integer = std::int32_t;

  float entry[3] = { 0, 0, 0 };      ///< position of the entry [index]
  float step[3] = { 0, 0, 0 };       ///< vector from sample to sample [index]
  float lightEntry[3] = { 0, 0, 0 }; ///< vector from the middle of the box to the entry [radii,
                                     ///< world]
  float lightStep[3] = { 0, 0, 0 };
  float toViewer[3] = { 0, 0, 0 }; ///< unit vector, world
  float length = 0;                ///< distance from entry to exit [samples]
  float shift = 0;                 ///< distance of the first sample before the entry [samples]
  int segments = 0;
  int begin = 0;        ///< sample before which all segments are known to be empty
  bool skipped = false; ///< whether BrickWalk ended at `begin`

  /// Returns the distance of sample `k` from the entry [samples].
  LIMPID_HD LIMPID_INLINE float At(int k) const { return DistanceOf(*this, static_cast<float>(k)); }

  /// Returns the part from a distance [samples] on. Its samples are a subset of those of the whole
  /// ray.
  LIMPID_HD LIMPID_INLINE Ray From(float distance) const
  {
    Ray part = *this;
    for (int axis = 0; axis < 3; ++axis)
    {
      part.entry[axis] = this->entry[axis] + distance * this->step[axis];
      part.lightEntry[axis] = this->lightEntry[axis] + distance * this->lightStep[axis];
    }
    const float before = distance + this->shift;
    part.shift = before - std::floor(before);
    part.length = this->length - distance;
    part.segments = static_cast<int>(std::ceil(part.length + part.shift));
    part.begin = 0;
    part.skipped = false;
    return part;
  }

  /// Returns a ray with these samples in the opposite order. It must not be used for lighting.
  LIMPID_HD LIMPID_INLINE Ray Reversed() const
  {
    Ray back = *this;
    for (int axis = 0; axis < 3; ++axis)
    {
      back.entry[axis] = this->entry[axis] + this->length * this->step[axis];
      back.step[axis] = -this->step[axis];
    }
    const float before = static_cast<float>(this->segments) - this->shift - this->length;
    back.shift = AtLeast(before, 0.0f);
    back.begin = 0;
    back.skipped = false;
    return back;
  }
};

/// Throws limpid::Error if a view does not define rays.
void RequireView(const View& view);

/// Computes the rays of a view through the box of a grid: Eq. (11), for any projection.
class RayMaker
{
public:
  static constexpr int mostPlanes = 16;

  /// `stepLength`: distance of samples [length].
  RayMaker(const Grid& grid, double stepLength, const View& view);

  /// Computes the ray of a pixel from clip z = `start` to `end`. Returns false if it misses the box
  /// as cut by the planes.
  LIMPID_HD bool Make(int column, int row, double start, double end, Ray& ray) const
  {
    if (!(end > start))
    {
      return false;
    }
    const double x = 2 * (column + 0.5) / this->Width - 1;
    const double y = 2 * (row + 0.5) / this->Height - 1;
    const Vec3 from = this->Point(x, y, -1);
    const Vec3 way = this->Point(x, y, end) - from;
    double first = 0;
    double last = 1;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double far = this->LastNode[axis];
      if (way[axis] != 0)
      {
        const double perLength = 1 / way[axis];
        const double one = -from[axis] * perLength;
        const double other = (far - from[axis]) * perLength;
        const double in = other < one ? other : one;
        const double out = one < other ? other : one;
        first = first < in ? in : first;
        last = out < last ? out : last;
      }
      else if (from[axis] < 0 || from[axis] > far)
      {
        return false;
      }
    }
    for (int i = 0; i < this->PlaneCount; ++i)
    {
      const double at = glm::dot(this->Planes[i], glm::dvec4(from, 1.0));
      const double along = glm::dot(Vec3(this->Planes[i]), way);
      if (along != 0)
      {
        const double crossing = -at / along;
        first = along > 0 && first < crossing ? crossing : first;
        last = along < 0 && crossing < last ? crossing : last;
      }
      else if (at < 0)
      {
        return false;
      }
    }
    const double begin = this->ShareAt(x, y, start, from, way);
    const double entry = first < begin ? begin : first;
    if (!(last > entry))
    {
      return false;
    }
    const double step = this->Describe(from, way, entry, last, ray);
    ray.shift = this->Jitter ? Noise(column, row) : 0.0f;
    if (first < begin)
    {
      const double before = (begin - first) / step + double(ray.shift);
      ray.shift = static_cast<float>(before - std::floor(before));
    }
    ray.segments = static_cast<int>(std::ceil(ray.length + ray.shift));
    return ray.segments > 0;
  }

private:
  LIMPID_HD LIMPID_INLINE Vec3 Point(double x, double y, double z) const
  {
    const glm::dvec4 point = this->ClipToIndex * glm::dvec4(x, y, z, 1.0);
    return Vec3(point) * (1 / point.w);
  }

  /// Returns the position of clip z = `start` on a line through (x, y) in clip coordinates, as a
  /// fraction of the line.
  LIMPID_HD LIMPID_INLINE double ShareAt(
    double x, double y, double start, const Vec3& from, const Vec3& way) const
  {
    return start > -1 ? glm::dot(this->Point(x, y, start) - from, way) / glm::dot(way, way) : 0.0;
  }

  /// Describes the part of a line [index] between two fractions of it. Returns the fraction per
  /// step.
  LIMPID_HD LIMPID_INLINE double Describe(
    const Vec3& from, const Vec3& way, double first, double last, Ray& ray) const
  {
    const Vec3 worldWay = this->Direction * (way * this->Spacing);
    const double perWay = 1 / std::sqrt(glm::dot(worldWay, worldWay));
    const double step = this->StepLength * perWay; // as a fraction of the line
    const Vec3 entry = from + first * way;
    const Vec3 world = this->Origin + this->Direction * (entry * this->Spacing);
    const Vec3 lightEntry = (world - this->Centre) * this->PerRadius;
    for (int axis = 0; axis < 3; ++axis)
    {
      ray.entry[axis] = static_cast<float>(entry[axis]);
      ray.step[axis] = static_cast<float>(step * way[axis]);
      ray.lightEntry[axis] = static_cast<float>(lightEntry[axis]);
      ray.lightStep[axis] = static_cast<float>(step * worldWay[axis] * this->PerRadius);
      ray.toViewer[axis] = static_cast<float>(-worldWay[axis] * perWay);
    }
    ray.length = static_cast<float>((last - first) / step);
    return step;
  }

  /// Returns a number in [0, 1) that differs between neighbouring pixels: interleaved gradient
  /// noise [Jim14].
  LIMPID_HD static LIMPID_INLINE float Noise(int column, int row)
  {
    const double inner = 0.06711056 * column + 0.00583715 * row;
    const double outer = 52.9829189 * (inner - std::floor(inner));
    return static_cast<float>(outer - std::floor(outer));
  }

  glm::dmat4 ClipToIndex;
  glm::dvec4 Planes[mostPlanes]; ///< of the view [index]
  int PlaneCount = 0;
  Mat3 Direction;
  Vec3 Spacing;
  Vec3 Origin;
  Vec3 Centre;
  Vec3 LastNode;
  double PerRadius; ///< radius of the box [1/length]
  double StepLength;
  int Width;
  int Height;
  bool Jitter;
};
}

#endif
