// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The ray of one pixel on a device: Raycast.cxx, sample by sample.

#ifndef limpid_render_PixelRay_h
#define limpid_render_PixelRay_h

#include "backend/Extent.h"
#include "render/RayScene.h"
#include "render/Segment.h"
#include "render/Trilinear.h"

#include <cstring>

namespace limpid
{
/// One thread per pixel; a warp of 32 threads draws 8 x 4 of them, whose rays read the same cells.
struct PixelTiles
{
  static constexpr int width = 8;
  static constexpr int height = 4;

  int columns; ///< pixels
  int rows;

  Extent Threads() const
  {
    return { (this->columns + width - 1) / width * (width * height),
      (this->rows + height - 1) / height };
  }

  LIMPID_HD LIMPID_INLINE int ColumnOf(int thread) const
  {
    return thread / (width * height) * width + thread % width;
  }

  LIMPID_HD LIMPID_INLINE int RowOf(int thread, int tileRow) const
  {
    return tileRow * height + thread % (width * height) / width;
  }
};

/// `ExtinctionOverlay`: whether there is one, see RayScene.
template <bool Lit, bool ExtinctionOverlay>
struct PixelRay
{
  using Scene = RaySceneOf<FourFloats>;

  Scene scene;
  RayMaker maker;
  PixelTiles tiles;
  const float* depth; ///< clip z at which the rays end; null: 1
  float lightColor[3];
  std::uint32_t* picture; ///< out, four bytes per pixel

  LIMPID_HD void operator()(int thread, int tileRow) const
  {
    const int column = this->tiles.ColumnOf(thread);
    const int row = this->tiles.RowOf(thread, tileRow);
    if (column >= this->tiles.columns || row >= this->tiles.rows)
    {
      return;
    }
    const Index pixel = Index(row) * this->tiles.columns + column;
    PixelOf<FourFloats> received;
    Ray ray;
    if (this->maker.Make(column, row, this->depth ? double(this->depth[pixel]) : 1.0, ray))
    {
      this->Trace(ray, received);
    }
    std::uint8_t rgba[4];
    received.Store(this->lightColor, rgba);
    std::uint32_t bytes;
    std::memcpy(&bytes, rgba, sizeof(bytes));
    this->picture[pixel] = bytes;
  }

private:
  /// What RaySamples holds of a sample.
  struct Sample
  {
    float distance; ///< from the entry [samples]
    float scalar;   ///< table position
    float filled;
    float kept;
    float added;
    float shadow;
    float light; ///< if it is lit
    FourFloats integral;
  };

  LIMPID_HD LIMPID_INLINE void Trace(const Ray& ray, PixelOf<FourFloats>& pixel) const
  {
    const LightOnRay light(this->scene.light, ray);
    Sample front{};
    bool read = false; // whether `front` is sample k
    bool lit = false;
    int nextLook = 0;
    for (int k = 0; k < ray.segments && pixel.transmittance > this->scene.opaqueBelow; ++k)
    {
      if (this->scene.bricks.distance && k >= nextLook)
      {
        const int filled = this->scene.bricks.SkipEmpty(ray, k);
        if (filled >= ray.segments)
        {
          return;
        }
        read = read && filled == k;
        k = filled;
        nextLook = k + BrickDistances::size;
      }
      if (!read)
      {
        front = this->Read(ray, k);
        lit = false;
      }
      Sample back = this->Read(ray, k + 1);
      const FourFloats color =
        this->scene.table.Mean(front.scalar, front.integral, back.scalar, back.integral);
      const SegmentEnds ends{ front.filled + back.filled, front.kept + back.kept,
        front.added + back.added };
      const float extinction = ends.Extinction(color[0], this->scene.addedUnit);
      const bool visible = extinction > 0.0f;
      if (visible)
      {
        if (Lit)
        {
          front.light = lit ? front.light : this->LightOf(ray, light, front);
          back.light = this->LightOf(ray, light, back);
        }
        const float opticalDepth = extinction * (this->scene.stepLength * this->scene.majorant) *
          (back.distance - front.distance);
        pixel.Add(Segment::Of<Lit>(opticalDepth, front.light, back.light), color);
      }
      front = back;
      read = true;
      lit = visible;
    }
  }

  LIMPID_HD LIMPID_INLINE CellPlace PlaceOf(const Ray& ray, float distance) const
  {
    return { this->scene.grid, ray.entry[0] + distance * ray.step[0],
      ray.entry[1] + distance * ray.step[1], ray.entry[2] + distance * ray.step[2] };
  }

  LIMPID_HD LIMPID_INLINE CellPlace OverlayPlaceOf(const Ray& ray, float distance) const
  {
    const float* scale = this->scene.overlayScale;
    return { this->scene.overlayGrid, (ray.entry[0] + distance * ray.step[0]) * scale[0],
      (ray.entry[1] + distance * ray.step[1]) * scale[1],
      (ray.entry[2] + distance * ray.step[2]) * scale[2] };
  }

  LIMPID_HD LIMPID_INLINE Sample Read(const Ray& ray, int k) const
  {
    Sample sample{};
    sample.distance = ray.At(k);
    const CellPlace place = this->PlaceOf(ray, sample.distance);
    sample.scalar = this->scene.table.Position(place.Sample(this->scene.grid, this->scene.scalars));
    sample.integral = this->scene.table.IntegralAt(sample.scalar);
    sample.filled = this->scene.filled ? place.Sample(this->scene.grid, this->scene.filled) : 1.0f;
    sample.kept = sample.shadow = packedOne;
    if (ExtinctionOverlay)
    {
      const CellPlace inOverlay = this->OverlayPlaceOf(ray, sample.distance);
      const FourFloats overlay = inOverlay.Sample(
        this->scene.overlayGrid, reinterpret_cast<const FourPacked*>(this->scene.overlay));
      sample.kept = overlay[0];
      sample.added = overlay[1];
      sample.shadow = overlay[2];
    }
    return sample;
  }

  LIMPID_HD LIMPID_INLINE float LightOf(
    const Ray& ray, const LightOnRay& light, const Sample& sample) const
  {
    const FourFloats gradient =
      this->PlaceOf(ray, sample.distance)
        .Sample(this->scene.grid, reinterpret_cast<const FourPacked*>(this->scene.gradient));
    return light.Sent(
      this->scene.light, sample.distance, gradient[0], gradient[1], gradient[2], sample.shadow);
  }
};
}

#endif
