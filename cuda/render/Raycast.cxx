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

template <bool Lit, bool ExtinctionOverlay>
LIMPID_INLINE void Trace(const RayScene& scene, const Ray& ray, Pixel& pixel)
{
  constexpr int segments = RaySamples::segments;
  const BrickDistances bricks = scene.bricks;
  RaySamples samples;
  int read = -1;    // sample that the first one holds
  bool lit = false; // whether it is lit
  for (int k = 0; k < ray.segments && pixel.transmittance > scene.opaqueBelow; k += segments)
  {
    if (bricks.distance)
    {
      k = bricks.SkipEmpty(ray, k);
      if (k >= ray.segments)
      {
        return;
      }
    }
    PlaceSamples<1, segments + 1, ExtinctionOverlay>(scene, ray, k, samples);
    ReadSamples<1, segments + 1, ExtinctionOverlay>(scene, samples);
    if (read != k)
    {
      PlaceSamples<0, 1, ExtinctionOverlay>(scene, ray, k, samples);
      ReadSamples<0, 1, ExtinctionOverlay>(scene, samples);
      lit = false;
    }
    const bool visible = ClassifySegments(scene, samples);
    if (Lit && visible)
    {
      if (!lit)
      {
        PlaceSamples<0, 1, ExtinctionOverlay>(scene, ray, k, samples);
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

#define LIMPID_TRACE(name, lit, overlay)                                                           \
  LIMPID_MULTIVERSION void name(const RayScene& scene, const Ray* rays, int count, Pixel* pixels)  \
  {                                                                                                \
    for (int i = 0; i < count; ++i)                                                                \
    {                                                                                              \
      Trace<lit, overlay>(scene, rays[i], pixels[i]);                                              \
    }                                                                                              \
  }
LIMPID_TRACE(TracePlain, false, false)
LIMPID_TRACE(TraceChanged, false, true)
LIMPID_TRACE(TraceLit, true, false)
LIMPID_TRACE(TraceLitChanged, true, true)
#undef LIMPID_TRACE
}

void Raycast(const RayScene& scene, const RayMaker& maker, const View& view,
  const std::array<float, 3>& lightColor, Picture& picture)
{
  const TraceRays trace = scene.gradient ? (scene.overlay ? TraceLitChanged : TraceLit)
                                         : (scene.overlay ? TraceChanged : TracePlain);
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
          const std::size_t pixel =
            std::size_t(row) * std::size_t(view.width) + std::size_t(column);
          if (maker.Make(column, row, view.depth ? view.depth[pixel] : 1.0, rays[count]))
          {
            at[count++] = column;
          }
        }
        Pixel pixels[tileWidth];
        trace(scene, rays, count, pixels);
        for (int i = 0; i < count; ++i)
        {
          pixels[i].Store(lightColor.data(),
            picture.rgba.data() +
              4 * (std::size_t(row) * std::size_t(view.width) + std::size_t(at[i])));
        }
      }
    });
}
}
