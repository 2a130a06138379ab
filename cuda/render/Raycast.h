// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_Raycast_h
#define limpid_render_Raycast_h

#include "backend/Extent.h"
#include "render/TraceRay.h"

namespace limpid
{
class HostDevice;

/// The rays of a picture and what they are for.
struct PictureRays
{
  RayMaker maker;
  int columns; ///< pixels
  int rows;
  const float* nearDepth; ///< clip z at which the rays begin; null: -1
  const float* depth;     ///< clip z at which they end; null: 1
  float lightColor[3];
  Rgba* picture; ///< out

  /// Draws a pixel. `trace(ray, received)` adds to a Pixel what a ray meets.
  template <class Optical, class Trace>
  LIMPID_HD LIMPID_INLINE void Draw(int column, int row, const Trace& trace) const
  {
    const Index pixel = Index(row) * this->columns + column;
    Pixel<Optical> received;
    Ray ray;
    const double start = this->nearDepth ? double(this->nearDepth[pixel]) : -1.0;
    const double end = this->depth ? double(this->depth[pixel]) : 1.0;
    if (this->maker.Make(column, row, start, end, ray))
    {
      trace(ray, received);
    }
    this->picture[pixel] = received.Shown(this->lightColor);
  }
};

/// One thread draws one pixel; a warp of 32 threads draws 8 x 4 of them, whose rays read the same
/// cells.
template <bool Lit, bool Overlaid>
struct DrawnPixel
{
  static constexpr int width = 8;
  static constexpr int height = 4;

  RayScene scene;
  PictureRays rays;

  Extent Threads() const
  {
    return { (this->rays.columns + width - 1) / width * (width * height),
      (this->rays.rows + height - 1) / height };
  }

  LIMPID_HD void operator()(int thread, int tileRow) const
  {
    const int column = thread / (width * height) * width + thread % width;
    const int row = tileRow * height + thread % (width * height) / width;
    if (column < this->rays.columns && row < this->rays.rows)
    {
      this->rays.template Draw<FourFloats>(column, row,
        [this](const Ray& ray, Pixel<FourFloats>& pixel)
        { TraceRay<SingleSampler, Lit, Overlaid>(this->scene, ray, pixel); });
    }
  }
};

/// Casts a ray through every pixel of a picture. All addresses are on the device. Does not wait.
template <class AnyDevice>
void CastRays(AnyDevice& device, const RayScene& scene, const PictureRays& rays)
{
  const auto cast = [&](const auto& pixel) { device.ForEach("cast rays", pixel.Threads(), pixel); };
  if (scene.gradient)
  {
    scene.overlay ? cast(DrawnPixel<true, true>{ scene, rays })
                  : cast(DrawnPixel<true, false>{ scene, rays });
  }
  else
  {
    scene.overlay ? cast(DrawnPixel<false, true>{ scene, rays })
                  : cast(DrawnPixel<false, false>{ scene, rays });
  }
}

/// The form for the processor reads and adds up the samples of a ray in blocks, with vector units.
void CastRays(HostDevice& device, const RayScene& scene, const PictureRays& rays);
}

#endif
