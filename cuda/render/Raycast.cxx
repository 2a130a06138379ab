// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/Raycast.h"

#include "backend/Backend.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
constexpr int tileWidth = 32;
constexpr int tileHeight = 8;

/// Makes the rays of a view.
class RayMaker
{
public:
  RayMaker(const RayScene& scene, const View& view)
    : Nodes(scene.scalars->grid)
    , Source(view)
    , StepLength(scene.stepLength)
  {
    const Grid& grid = this->Nodes;
    glm::dmat4 worldToIndex(1.0);
    const Mat3 turn = glm::transpose(grid.direction);
    for (int column = 0; column < 3; ++column)
    {
      worldToIndex[column] = glm::dvec4(turn[column] / grid.spacing, 0.0);
    }
    worldToIndex[3] = glm::dvec4(grid.PointToIndex(Vec3(0.0)), 1.0);
    this->ClipToIndex = worldToIndex * view.clipToWorld;
  }

  /// The ray of a pixel; false: it misses the box.
  bool Make(int column, int row, Ray& ray) const
  {
    const double x = 2 * (column + 0.5) / this->Source.width - 1;
    const double y = 2 * (row + 0.5) / this->Source.height - 1;
    const double end = this->Source.depth
      ? this->Source.depth[std::size_t(row) * std::size_t(this->Source.width) + std::size_t(column)]
      : 1.0;
    const Vec3 from = this->Point(x, y, -1);
    const Vec3 way = this->Point(x, y, end) - from;
    double first = 0;
    double last = 1;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double far = this->Nodes.nodes[axis] - 1;
      if (way[axis] != 0)
      {
        const double one = -from[axis] / way[axis];
        const double other = (far - from[axis]) / way[axis];
        first = std::max(first, std::min(one, other));
        last = std::min(last, std::max(one, other));
      }
      else if (from[axis] < 0 || from[axis] > far)
      {
        return false;
      }
    }
    if (!(last > first))
    {
      return false;
    }
    const Vec3 worldWay = this->Nodes.direction * (way * this->Nodes.spacing);
    const double wayLength = glm::length(worldWay);
    const double step = this->StepLength / wayLength; // in units of the way
    const Vec3 entry = from + first * way;
    const double radius = this->Nodes.Radius();
    const Vec3 lightEntry = (this->Nodes.PointToWorld(entry) - this->Nodes.Centre()) / radius;
    for (int axis = 0; axis < 3; ++axis)
    {
      ray.entry[axis] = static_cast<float>(entry[axis]);
      ray.step[axis] = static_cast<float>(step * way[axis]);
      ray.lightEntry[axis] = static_cast<float>(lightEntry[axis]);
      ray.lightStep[axis] = static_cast<float>(step * worldWay[axis] / radius);
      ray.toViewer[axis] = static_cast<float>(-worldWay[axis] / wayLength);
    }
    ray.length = static_cast<float>((last - first) / step);
    ray.shift = this->Source.jitter ? Noise(column, row) : 0.0f;
    ray.segments = static_cast<int>(std::ceil(ray.length + ray.shift));
    return ray.segments > 0;
  }

private:
  Vec3 Point(double x, double y, double z) const
  {
    const glm::dvec4 point = this->ClipToIndex * glm::dvec4(x, y, z, 1.0);
    return Vec3(point) / point.w;
  }

  /// A number in [0, 1) that neighbouring pixels do not share: interleaved gradient noise [Jim14].
  static float Noise(int column, int row)
  {
    const double inner = 0.06711056 * column + 0.00583715 * row;
    const double outer = 52.9829189 * (inner - std::floor(inner));
    return static_cast<float>(outer - std::floor(outer));
  }

  const Grid& Nodes;
  const View& Source;
  double StepLength;
  glm::dmat4 ClipToIndex;
};

LIMPID_INLINE int EmptyAround(const RayScene& scene, const Ray& ray, int k, float* position)
{
  const float distance = ray.At(k);
  int cell[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    position[axis] = ray.entry[axis] + distance * ray.step[axis];
    const int cells = scene.scalars->grid.nodes[axis] - 1;
    const int at = static_cast<int>(position[axis] > 0.0f ? position[axis] : 0.0f);
    cell[axis] = at < cells ? at : cells - 1;
  }
  return scene.bricks->EmptyAround(cell[0], cell[1], cell[2]);
}

/// The first sample from `k` on whose segment is not known to be empty.
LIMPID_INLINE int SkipEmpty(const RayScene& scene, const Ray& ray, int k)
{
  while (k < ray.segments)
  {
    float position[3];
    const int around = EmptyAround(scene, ray, k, position);
    if (around == 0)
    {
      return k;
    }
    // All of the bricks from around - 1 before to around - 1 behind are empty.
    float steps = 3.4e38f;
    for (int axis = 0; axis < 3; ++axis)
    {
      const float pace = ray.step[axis];
      const int brick =
        static_cast<int>(position[axis] > 0.0f ? position[axis] : 0.0f) / Bricks::size;
      const int side = pace > 0.0f ? brick + around : brick - around + 1;
      const float way = float(side * Bricks::size) - position[axis];
      const float reach = way / pace;
      steps = std::abs(pace) > 1e-12f && reach < steps ? reach : steps;
    }
    // The last sample inside is empty as well as its segment, unless the next one is not.
    const int inside = steps < 1e6f ? static_cast<int>(steps) : 1000000;
    k += inside > 0 ? inside : 0;
    if (k + 1 >= ray.segments)
    {
      // The last segment: its far end is at the exit, in this or a neighbouring brick.
      float last[3];
      return k < ray.segments && EmptyAround(scene, ray, k + 1, last) == 0 ? k : ray.segments;
    }
    float next[3];
    if (EmptyAround(scene, ray, k + 1, next) == 0)
    {
      return k;
    }
    ++k;
  }
  return ray.segments;
}

template <bool Lit, bool Medium>
LIMPID_INLINE void Trace(const RayScene& scene, const Ray& ray, Pixel& pixel)
{
  constexpr int segments = RaySamples::segments;
  RaySamples samples;
  int read = -1;    // sample that the first one holds
  bool lit = false; // whether it is lit
  for (int k = 0; k < ray.segments && pixel.transmittance > scene.opaqueBelow; k += segments)
  {
    if (scene.bricks)
    {
      k = SkipEmpty(scene, ray, k);
      if (k >= ray.segments)
      {
        return;
      }
    }
    PlaceSamples<1, segments + 1, Medium>(scene, ray, k, samples);
    ReadSamples<1, segments + 1, Medium>(scene, samples);
    if (read != k)
    {
      PlaceSamples<0, 1, Medium>(scene, ray, k, samples);
      ReadSamples<0, 1, Medium>(scene, samples);
      lit = false;
    }
    const bool visible = ClassifySegments(scene, samples);
    if (Lit && visible)
    {
      if (!lit)
      {
        PlaceSamples<0, 1, Medium>(scene, ray, k, samples);
        ReadGradients<0, 1>(scene, samples);
        LightSamples<0, 1>(scene, ray, samples);
      }
      ReadGradients<1, segments + 1>(scene, samples);
      LightSamples<1, segments + 1>(scene, ray, samples);
    }
    if (visible)
    {
      AddSegments<Lit>(scene, samples, pixel);
    }
    samples.MoveOn();
    read = k + segments;
    lit = visible;
  }
}

using TraceRays = void (*)(const RayScene&, const Ray*, int, Pixel*);

#define LIMPID_TRACE(name, lit, medium)                                                            \
  LIMPID_MULTIVERSION void name(const RayScene& scene, const Ray* rays, int count, Pixel* pixels)  \
  {                                                                                                \
    for (int i = 0; i < count; ++i)                                                                \
    {                                                                                              \
      Trace<lit, medium>(scene, rays[i], pixels[i]);                                               \
    }                                                                                              \
  }
LIMPID_TRACE(TracePlain, false, false)
LIMPID_TRACE(TraceChanged, false, true)
LIMPID_TRACE(TraceLit, true, false)
LIMPID_TRACE(TraceLitChanged, true, true)
#undef LIMPID_TRACE

std::uint8_t ToByte(float value)
{
  return static_cast<std::uint8_t>(std::min(std::max(value, 0.0f), 1.0f) * 255.0f + 0.5f);
}

void Store(const Pixel& pixel, const std::array<float, 3>& lightColor, std::uint8_t* rgba)
{
  const float alpha = 1.0f - pixel.transmittance;
  for (int channel = 0; channel < 3; ++channel)
  {
    rgba[channel] = ToByte(pixel.light[channel + 1] * lightColor[std::size_t(channel)]);
  }
  rgba[3] = ToByte(alpha);
}
}

void Raycast(
  const RayScene& scene, const View& view, const std::array<float, 3>& lightColor, Picture& picture)
{
  const RayMaker maker(scene, view);
  const TraceRays trace = scene.gradient ? (scene.medium ? TraceLitChanged : TraceLit)
                                         : (scene.medium ? TraceChanged : TracePlain);
  const int columns = (view.width + tileWidth - 1) / tileWidth;
  const int rows = (view.height + tileHeight - 1) / tileHeight;
  ParallelFor(Index(columns) * rows,
    [&](Index tile)
    {
      const int left = int(tile % columns) * tileWidth;
      const int bottom = int(tile / columns) * tileHeight;
      Ray rays[tileWidth];
      int at[tileWidth];
      for (int row = bottom; row < std::min(bottom + tileHeight, view.height); ++row)
      {
        int count = 0;
        for (int column = left; column < std::min(left + tileWidth, view.width); ++column)
        {
          if (maker.Make(column, row, rays[count]))
          {
            at[count++] = column;
          }
        }
        Pixel pixels[tileWidth];
        trace(scene, rays, count, pixels);
        for (int i = 0; i < count; ++i)
        {
          Store(pixels[i], lightColor,
            picture.rgba.data() +
              4 * (std::size_t(row) * std::size_t(view.width) + std::size_t(at[i])));
        }
      }
    });
}
}
