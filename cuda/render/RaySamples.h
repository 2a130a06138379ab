// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_RaySamples_h
#define limpid_render_RaySamples_h

#include "render/RayScene.h"
#include "render/Segment.h"

namespace limpid
{
/**
 * A few consecutive samples of a ray, and the segments between them: what the fields hold there,
 * how it is lit, and what it adds to a pixel. Segment i lies between samples i and i + 1.
 *
 * AnySampler says how many there are and interpolates. What is done to samples from Begin to End -
 * 1 is a loop with constant bounds and without branches, for the sake of vector units.
 */
template <class AnySampler>
struct RaySamples
{
  using Optical = typename AnySampler::Optical;
  static constexpr int segments = AnySampler::segments;
  static constexpr int count = segments + 1;

  float distance[count]; ///< from the entry [samples]
  Index cell[count];     ///< first node of the cell
  float fraction[3][count];
  Index overlayCell[count]; ///< the same in the grid of the overlay
  float overlayFraction[3][count];
  float scalar[count]; ///< table position
  float filled[count]; ///< 1, less beside empty nodes
  float kept[count];   ///< share of the transfer function's extinction [packedOne]
  float added[count];  ///< extinction [packedOne majorants]
  float shadow[count]; ///< transmittance of the light [packedOne]
  float gradient[3][count];
  float light[count];      ///< share of its colour that a sample sends to the viewer
  Optical integral[count]; ///< see OpticalTable::IntegralsAt

  float extinction[segments]; ///< [majorant]
  Optical color[segments];    ///< second to fourth: red, green, blue

  /// The first sample is empty until it is read, and the last one dark until it is lit.
  LIMPID_HD LIMPID_INLINE RaySamples()
  {
    this->distance[0] = this->scalar[0] = this->filled[0] = 0;
    this->kept[0] = this->added[0] = this->shadow[0] = this->light[0] = 0;
    this->integral[0] = Optical{ 0, 0, 0, 0 };
    this->light[segments] = 0;
  }

  /// The last sample becomes the first.
  LIMPID_HD LIMPID_INLINE void MoveOn()
  {
    constexpr int last = segments;
    this->distance[0] = this->distance[last];
    this->scalar[0] = this->scalar[last];
    this->filled[0] = this->filled[last];
    this->kept[0] = this->kept[last];
    this->added[0] = this->added[last];
    this->shadow[0] = this->shadow[last];
    this->light[0] = this->light[last];
    this->integral[0] = this->integral[last];
  }

  /// Places sample i at sample k + i of the ray.
  template <int Begin, int End, bool Overlaid>
  LIMPID_HD LIMPID_INLINE void Place(const RayScene& scene, const Ray& ray, int k)
  {
    const CellGrid grid = scene.grid;
    for (int i = Begin; i < End; ++i)
    {
      this->distance[i] = ray.At(k + i);
      Index first = 0;
      for (int axis = 0; axis < 3; ++axis)
      {
        const float position = ray.entry[axis] + this->distance[i] * ray.step[axis];
        first += grid.stride[axis] * grid.Split(axis, position, this->fraction[axis][i]);
      }
      this->cell[i] = first;
    }
    if (Overlaid)
    {
      const CellGrid overlayGrid = scene.overlayGrid;
      for (int i = Begin; i < End; ++i)
      {
        Index first = 0;
        for (int axis = 0; axis < 3; ++axis)
        {
          const float position = ray.entry[axis] + this->distance[i] * ray.step[axis];
          first += overlayGrid.stride[axis] *
            overlayGrid.Split(
              axis, position * scene.overlayScale[axis], this->overlayFraction[axis][i]);
        }
        this->overlayCell[i] = first;
      }
    }
  }

  /// Reads what decides on the extinction, at samples that were placed.
  template <int Begin, int End, bool Overlaid>
  LIMPID_HD LIMPID_INLINE void Read(const RayScene& scene)
  {
    const OpticalTable<Optical> table = scene.table.template As<Optical>();
    const CellGrid grid = scene.grid;
    for (int i = Begin; i < End; ++i)
    {
      this->scalar[i] = AnySampler::Interpolate(grid, scene.scalars + this->cell[i],
        this->fraction[0][i], this->fraction[1][i], this->fraction[2][i]);
    }
    for (int i = Begin; i < End; ++i)
    {
      this->scalar[i] = table.Position(this->scalar[i]);
      this->filled[i] = 1;
      this->kept[i] = packedOne;
      this->added[i] = 0;
      this->shadow[i] = packedOne;
    }
    table.template IntegralsAt<Begin, End>(this->scalar, this->integral);
    if (scene.filled)
    {
      for (int i = Begin; i < End; ++i)
      {
        this->filled[i] = AnySampler::Interpolate(grid, scene.filled + this->cell[i],
          this->fraction[0][i], this->fraction[1][i], this->fraction[2][i]);
      }
    }
    if (Overlaid)
    {
      const CellGrid overlayGrid = scene.overlayGrid;
      const FourPacked* packed = scene.overlay;
      for (int i = Begin; i < End; ++i)
      {
        const Optical overlay = AnySampler::Interpolate(overlayGrid, packed + this->overlayCell[i],
          this->overlayFraction[0][i], this->overlayFraction[1][i], this->overlayFraction[2][i]);
        this->kept[i] = overlay[0];
        this->added[i] = overlay[1];
        this->shadow[i] = overlay[2];
      }
    }
  }

  /// Extinction and colour of the segments, with the change of the optimisation and without what is
  /// empty. Returns whether there is any extinction.
  LIMPID_HD LIMPID_INLINE bool Classify(const RayScene& scene)
  {
    const OpticalTable<Optical> table = scene.table.template As<Optical>();
    const float addedUnit = scene.addedUnit;
    for (int i = 0; i < segments; ++i)
    {
      this->color[i] =
        table.Mean(this->scalar[i], this->integral[i], this->scalar[i + 1], this->integral[i + 1]);
    }
    float any = 0;
    for (int i = 0; i < segments; ++i)
    {
      const SegmentEnds ends{ this->filled[i] + this->filled[i + 1],
        this->kept[i] + this->kept[i + 1], this->added[i] + this->added[i + 1] };
      const float here = ends.Extinction(this->color[i][0], addedUnit);
      this->extinction[i] = here;
      any += here;
    }
    return any > 0.0f;
  }

  /// Finds the light that the samples send, see LightOnRay.
  template <int Begin, int End>
  LIMPID_HD LIMPID_INLINE void Light(const RayScene& scene, const Ray& ray)
  {
    const CellGrid grid = scene.grid;
    const FourPacked* packed = scene.gradient;
    for (int i = Begin; i < End; ++i)
    {
      const Optical here = AnySampler::Interpolate(grid, packed + this->cell[i],
        this->fraction[0][i], this->fraction[1][i], this->fraction[2][i]);
      this->gradient[0][i] = here[0];
      this->gradient[1][i] = here[1];
      this->gradient[2][i] = here[2];
    }
    const RayLight source = scene.light; // a copy: nothing that is written below can be part of it
    const LightOnRay onRay(source, ray);
    float sent[End];
    for (int i = Begin; i < End; ++i)
    {
      sent[i] = onRay.Sent(source, this->distance[i], this->gradient[0][i], this->gradient[1][i],
        this->gradient[2][i], this->shadow[i]);
    }
    for (int i = Begin; i < End; ++i)
    {
      this->light[i] = sent[i];
    }
  }

  /// Adds the segments to a pixel, front to back.
  template <bool Lit>
  LIMPID_HD LIMPID_INLINE void AddTo(const RayScene& scene, Pixel<Optical>& pixel) const
  {
    float passed[segments];
    float given[segments];
    const float lengthUnit = scene.stepLength * scene.majorant;
    for (int i = 0; i < segments; ++i)
    {
      const float length = this->distance[i + 1] - this->distance[i];
      const float depth = this->extinction[i] * lengthUnit * length;
      const Segment segment = Segment::Of<Lit>(depth, this->light[i], this->light[i + 1]);
      passed[i] = segment.passed;
      given[i] = segment.given;
    }
    for (int i = 0; i < segments; ++i)
    {
      // Segment by segment, so that it does not matter where blocks of segments begin.
      if (pixel.transmittance > scene.opaqueBelow)
      {
        pixel.Add({ passed[i], given[i] }, this->color[i]);
      }
    }
  }
};
}

#endif
