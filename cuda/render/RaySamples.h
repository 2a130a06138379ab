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
  float scalar[count];     ///< table position
  float filled[count];     ///< 1, less beside empty nodes
  float kept[count];       ///< share of the transfer function's extinction [packedOne]
  float added[count];      ///< extinction [packedOne majorants]
  float shadow[count];     ///< transmittance of the light [packedOne]
  float light[count];      ///< share of its colour that a sample sends to the viewer
  Optical value[count];    ///< of the transfer functions
  Optical integral[count]; ///< see OpticalTable

  float classified[segments]; ///< the transfer function's extinction [majorant]
  float extinction[segments]; ///< [majorant]
  float ofValues[segments];   ///< see SegmentMean
  float ofIntegrals[segments];

  /// The first sample is empty until it is read, and the last one dark until it is lit.
  LIMPID_HD LIMPID_INLINE RaySamples()
  {
    this->distance[0] = this->scalar[0] = this->filled[0] = 0;
    this->kept[0] = this->added[0] = this->shadow[0] = this->light[0] = 0;
    this->value[0] = this->integral[0] = Optical{ 0, 0, 0, 0 };
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
    this->value[0] = this->value[last];
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
      int at[3];
      for (int axis = 0; axis < 3; ++axis)
      {
        const float position = ray.entry[axis] + this->distance[i] * ray.step[axis];
        at[axis] = grid.Split(axis, position, this->fraction[axis][i]);
      }
      this->cell[i] = grid.First(at[0], at[1], at[2]);
    }
    if (Overlaid)
    {
      const CellGrid overlayGrid = scene.overlayGrid;
      for (int i = Begin; i < End; ++i)
      {
        int at[3];
        for (int axis = 0; axis < 3; ++axis)
        {
          const float position = ray.entry[axis] + this->distance[i] * ray.step[axis];
          at[axis] = overlayGrid.Split(
            axis, position * scene.overlayScale[axis], this->overlayFraction[axis][i]);
        }
        this->overlayCell[i] = overlayGrid.First(at[0], at[1], at[2]);
      }
    }
  }

  /// Reads what decides on the extinction, at samples that were placed.
  template <int Begin, int End, bool Overlaid>
  LIMPID_HD LIMPID_INLINE void Read(const RayScene& scene)
  {
    const OpticalTable<Optical> table = scene.table.template As<Optical>();
    const CellGrid grid = scene.grid;
    AnySampler::template InterpolateAll<Begin, End>(grid, scene.scalars, this->cell,
      this->fraction[0], this->fraction[1], this->fraction[2], this->scalar);
    for (int i = Begin; i < End; ++i)
    {
      this->scalar[i] = table.Position(this->scalar[i]);
      this->filled[i] = 1;
      this->kept[i] = packedOne;
      this->added[i] = 0;
      this->shadow[i] = packedOne;
    }
    table.template Read<Begin, End>(this->scalar, this->value, this->integral);
    if (scene.filled)
    {
      AnySampler::template InterpolateAll<Begin, End>(grid, scene.filled, this->cell,
        this->fraction[0], this->fraction[1], this->fraction[2], this->filled);
    }
    if (Overlaid)
    {
      Optical overlay[End];
      AnySampler::template InterpolateAll<Begin, End>(scene.overlayGrid, scene.overlay,
        this->overlayCell, this->overlayFraction[0], this->overlayFraction[1],
        this->overlayFraction[2], overlay);
      for (int i = Begin; i < End; ++i)
      {
        this->kept[i] = overlay[i][0];
        this->added[i] = overlay[i][1];
        this->shadow[i] = overlay[i][2];
      }
    }
  }

  /// Extinction and colour of the segments, with the change of the optimisation and without what is
  /// empty. Returns whether there is any extinction.
  LIMPID_HD LIMPID_INLINE bool Classify(const RayScene& scene)
  {
    float ends[count];
    float integrals[count];
    for (int i = 0; i < count; ++i)
    {
      ends[i] = this->value[i][0];
      integrals[i] = this->integral[i][0];
    }
    for (int i = 0; i < segments; ++i)
    {
      const SegmentMean mean(this->scalar[i + 1] - this->scalar[i], integrals[i + 1] - integrals[i],
        ends[i] + ends[i + 1]);
      this->classified[i] = mean.extinction;
      this->ofValues[i] = mean.ofValues;
      this->ofIntegrals[i] = mean.ofIntegrals;
    }
    const float addedUnit = scene.addedUnit;
    int any = 0;
    for (int i = 0; i < segments; ++i)
    {
      const SegmentEnds both{ this->filled[i] + this->filled[i + 1],
        this->kept[i] + this->kept[i + 1], this->added[i] + this->added[i + 1] };
      const float here = both.Extinction(this->classified[i], addedUnit);
      this->extinction[i] = here;
      any |= static_cast<int>(here > 0.0f);
    }
    return any != 0;
  }

  /// Finds the light that the samples send, see LightOnRay.
  template <int Begin, int End, bool Overlaid>
  LIMPID_HD LIMPID_INLINE void Light(const RayScene& scene, const Ray& ray)
  {
    Optical gradient[End];
    AnySampler::template InterpolateAll<Begin, End>(scene.grid, scene.gradient, this->cell,
      this->fraction[0], this->fraction[1], this->fraction[2], gradient);
    const RayLight source = scene.light; // a copy: nothing that is written below can be part of it
    const LightOnRay onRay(source, ray);
    float sent[End];
    for (int i = Begin; i < End; ++i)
    {
      sent[i] = onRay.Sent(source, this->distance[i], gradient[i][0], gradient[i][1],
        gradient[i][2], Overlaid ? this->shadow[i] : gradient[i][3]);
    }
    for (int i = Begin; i < End; ++i)
    {
      this->light[i] = sent[i];
    }
  }

  /// Adds the segments to a pixel, front to back: the sum of Eq. (6). What a segment scatters is
  /// extinction times colour, Eq. (3).
  template <bool Lit>
  LIMPID_HD LIMPID_INLINE void AddTo(const RayScene& scene, Pixel<Optical>& pixel) const
  {
    float passed[segments];
    float given[segments];
    const float lengthUnit = scene.stepLength * scene.majorant;
    const float opaqueBelow = scene.opaqueBelow;
    for (int i = 0; i < segments; ++i)
    {
      const float length = this->distance[i + 1] - this->distance[i];
      const float depth = this->extinction[i] * lengthUnit * length;
      const Segment segment = Segment::Of<Lit>(depth, this->light[i], this->light[i + 1]);
      passed[i] = segment.passed;
      given[i] = segment.given;
    }
    float transmittance[segments + 1];
    transmittance[0] = pixel.transmittance;
    LIMPID_UNROLL(4)
    for (int i = 0; i < segments; ++i)
    {
      transmittance[i + 1] = transmittance[i] * passed[i];
    }
    // Segment by segment, so that it does not matter where blocks of segments begin.
    int seen = 0;
    LIMPID_UNROLL(1)
    for (int i = 0; i < segments; ++i)
    {
      given[i] *= transmittance[i] > opaqueBelow ? transmittance[i] : 0.0f;
      seen += static_cast<int>(transmittance[i] > opaqueBelow);
    }
    pixel.transmittance = transmittance[seen];
    float ofValuesGiven[segments];
    float ofIntegralsGiven[segments];
    LIMPID_UNROLL(1)
    for (int i = 0; i < segments; ++i)
    {
      ofValuesGiven[i] = given[i] * this->ofValues[i];
      ofIntegralsGiven[i] = given[i] * this->ofIntegrals[i];
    }
    for (int i = 0; i < segments; ++i)
    {
      pixel.light = pixel.light + this->ColorOf(i, ofValuesGiven[i], ofIntegralsGiven[i]);
    }
  }

  /// The colour of a segment; its extinction is no part of it.
  LIMPID_HD LIMPID_INLINE Optical Color(int i) const
  {
    return this->ColorOf(i, this->ofValues[i], this->ofIntegrals[i]);
  }

private:
  LIMPID_HD LIMPID_INLINE Optical ColorOf(int i, float ofValuesThere, float ofIntegralsThere) const
  {
    return ofValuesThere * (this->value[i] + this->value[i + 1]) +
      ofIntegralsThere * (this->integral[i + 1] - this->integral[i]);
  }
};
}

#endif
