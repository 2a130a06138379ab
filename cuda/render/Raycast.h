// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_Raycast_h
#define limpid_render_Raycast_h

#include "backend/Extent.h"
#include "render/PartialPicture.h"
#include "render/RayPart.h"
#include "render/TraceByImportance.h"
#include "render/TraceMissed.h"

#include <type_traits>

namespace limpid
{
class HostDevice;

/// The rays of a picture and its output.
struct PictureRays
{
  RayMaker maker;
  int columns; ///< pixels
  int rows;
  const float* nearDepth;        ///< clip z at which the rays begin; null: -1
  const float* depth;            ///< clip z at which they end; null: 1
  Rgba* picture;                 ///< out
  Range<int> drawn;              ///< rows with rays
  const RayPart* part = nullptr; ///< the part that is drawn here, on the host; null: the whole rays
  PartialPixel* parts = nullptr; ///< out, instead of the picture, if only a part is drawn here

  /// Draws a pixel. `trace(ray, received)`: accumulates a ray in a Pixel.
  template <class Optical, class Trace>
  LIMPID_HD LIMPID_INLINE void Draw(int column, int row, const Trace& trace) const
  {
    Pixel<Optical> received;
    Ray ray;
    if (this->Make(column, row, ray))
    {
      trace(ray, received);
    }
    this->Show(column, row, ray, received);
  }

  template <class Optical>
  LIMPID_HD LIMPID_INLINE void Show(
    int column, int row, const Ray& ray, const Pixel<Optical>& received) const
  {
    const Index pixel = this->At(column, row);
    if (this->parts)
    {
      this->parts[pixel] = { { received.light[1], received.light[2], received.light[3] },
        received.transmittance, ray.begin };
      return;
    }
    this->picture[pixel] = received.Shown();
  }

  /// Paints missed structures over a finished pixel. `trace(ray)`: returns a RayImportance.
  template <class Trace>
  LIMPID_HD LIMPID_INLINE void Paint(
    int column, int row, const MissedPaint& paint, const Trace& trace) const
  {
    Ray ray;
    if (this->Make(column, row, ray))
    {
      Rgba& pixel = this->picture[this->At(column, row)];
      pixel = paint.Over(pixel, trace(ray).Missed());
    }
  }

  /// Computes the ray of a pixel; false: it meets nothing.
  LIMPID_HD LIMPID_INLINE bool Make(int column, int row, Ray& ray) const
  {
    if (!this->drawn.Contains(row))
    {
      return false;
    }
    const Index pixel = this->At(column, row);
    const double start = this->nearDepth ? double(this->nearDepth[pixel]) : -1.0;
    const double end = this->depth ? double(this->depth[pixel]) : 1.0;
    if (!this->maker.Make(column, row, start, end, ray))
    {
      return false;
    }
    if (this->part)
    {
      this->part->Cut(ray);
    }
    return ray.segments > 0;
  }

private:
  LIMPID_HD LIMPID_INLINE Index At(int column, int row) const
  {
    return Index(row) * this->columns + column;
  }
};

/// Each thread processes a pixel. A warp of 32 threads processes 8 x 4 pixels, whose rays read the
/// same cells. `AnyPixel`: has the rays and the operation on a pixel.
template <class AnyPixel>
struct PixelOfTile
{
  static constexpr int width = 8;
  static constexpr int height = 4;

  AnyPixel pixel;

  Extent Threads() const
  {
    return { (this->pixel.rays.columns + width - 1) / width * (width * height),
      (this->pixel.rays.rows + height - 1) / height };
  }

  LIMPID_HD void operator()(int thread, int tileRow) const
  {
    const int column = thread / (width * height) * width + thread % width;
    const int row = tileRow * height + thread % (width * height) / width;
    if (column < this->pixel.rays.columns && row < this->pixel.rays.rows)
    {
      this->pixel(column, row);
    }
  }
};

template <Compositing compositing, bool Lit, bool Overlaid, bool Tinted>
struct DrawnPixel
{
  RayScene scene;
  PictureRays rays;

  LIMPID_HD LIMPID_INLINE void operator()(int column, int row) const
  {
    this->rays.template Draw<FourFloats>(
      column, row, [this](const Ray& ray, Pixel<FourFloats>& pixel) { this->Trace(ray, pixel); });
  }

private:
  LIMPID_HD LIMPID_INLINE void Trace(const Ray& ray, Pixel<FourFloats>& pixel) const
  {
    constexpr RayLook look{ Lit, Tinted };
    switch (compositing)
    {
      case Compositing::FrontToBack:
        return TraceRay<SingleSampler, Overlaid>(this->scene, ray, look, pixel);
      case Compositing::FromObject:
        return TraceRay<SingleSampler, Overlaid>(
          this->scene, PartFromObject<SingleSampler>(this->scene, ray), look, pixel);
      case Compositing::ImportanceMean:
        return TraceMean<SingleSampler, Overlaid>(this->scene, ray, look, pixel);
    }
  }
};

template <bool Overlaid>
struct PaintedPixel
{
  RayScene scene;
  PictureRays rays;
  MissedPaint paint;

  LIMPID_HD LIMPID_INLINE void operator()(int column, int row) const
  {
    this->rays.Paint(column, row, this->paint,
      [this](const Ray& ray) { return TraceMissed<SingleSampler, Overlaid>(this->scene, ray); });
  }
};

template <Compositing compositing, bool Tinted, class AnyDevice>
void CastRaysBy(AnyDevice& device, const RayScene& scene, const PictureRays& rays)
{
  const auto cast = [&](const auto& pixel)
  {
    const PixelOfTile<std::decay_t<decltype(pixel)>> body{ pixel };
    device.ForEach("cast rays", body.Threads(), body);
  };
  if (scene.gradient)
  {
    scene.overlay ? cast(DrawnPixel<compositing, true, true, Tinted>{ scene, rays })
                  : cast(DrawnPixel<compositing, true, false, Tinted>{ scene, rays });
  }
  else
  {
    scene.overlay ? cast(DrawnPixel<compositing, false, true, Tinted>{ scene, rays })
                  : cast(DrawnPixel<compositing, false, false, Tinted>{ scene, rays });
  }
}

template <Compositing compositing, class AnyDevice>
void CastRaysAs(AnyDevice& device, const RayScene& scene, const PictureRays& rays)
{
  scene.structures ? CastRaysBy<compositing, true>(device, scene, rays)
                   : CastRaysBy<compositing, false>(device, scene, rays);
}

/// Casts a ray through every pixel of a picture. All addresses are on the device. Does not wait.
template <class AnyDevice>
void CastRays(
  AnyDevice& device, const RayScene& scene, const PictureRays& rays, Compositing compositing)
{
  switch (compositing)
  {
    case Compositing::FrontToBack:
      return CastRaysAs<Compositing::FrontToBack>(device, scene, rays);
    case Compositing::FromObject:
      return CastRaysAs<Compositing::FromObject>(device, scene, rays);
    case Compositing::ImportanceMean:
      return CastRaysAs<Compositing::ImportanceMean>(device, scene, rays);
  }
}

/// Paints over a picture what its rays miss of scene.importance. All addresses are on the device.
/// Does not wait.
template <class AnyDevice>
void PaintMissed(
  AnyDevice& device, const RayScene& scene, const PictureRays& rays, const MissedPaint& paint)
{
  const auto cast = [&](const auto& pixel)
  {
    const PixelOfTile<std::decay_t<decltype(pixel)>> body{ pixel };
    device.ForEach("paint what is missed", body.Threads(), body);
  };
  scene.overlay ? cast(PaintedPixel<true>{ scene, rays, paint })
                : cast(PaintedPixel<false>{ scene, rays, paint });
}

/// The processor's versions read and accumulate the samples of a ray in blocks, with vector units.
void CastRays(
  HostDevice& device, const RayScene& scene, const PictureRays& rays, Compositing compositing);
void PaintMissed(
  HostDevice& device, const RayScene& scene, const PictureRays& rays, const MissedPaint& paint);
}

#endif
