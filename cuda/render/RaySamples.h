// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A few consecutive samples of one ray: what the fields hold there, how they
// are lit, and what the segments between them add to a pixel.

#ifndef limpid_render_RaySamples_h
#define limpid_render_RaySamples_h

#include "render/Classification.h"
#include "render/Fields.h"
#include "render/RayScene.h"
#include "render/Segment.h"

#include <cstring>

namespace limpid
{
/// Extinction and colour, in one register: extinction, red, green, blue.
using Optical = float __attribute__((vector_size(16)));

using RayScene = RaySceneOf<Optical>;
using Pixel = PixelOf<Optical>;

/// A few consecutive samples of a ray, each from Begin to End - 1, and the
/// segments between them: segment i lies between samples i and i + 1. Loops
/// over samples have constant bounds and no branches, for the sake of vector
/// units.
struct RaySamples
{
  static constexpr int segments = 16;
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
  LIMPID_INLINE RaySamples()
  {
    this->distance[0] = this->scalar[0] = this->filled[0] = 0;
    this->kept[0] = this->added[0] = this->shadow[0] = this->light[0] = 0;
    this->integral[0] = Optical{ 0, 0, 0, 0 };
    this->light[segments] = 0;
  }

  /// The last sample becomes the first.
  LIMPID_INLINE void MoveOn()
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
};

using Packed8 = std::int16_t __attribute__((vector_size(16)));
using Packed4 = std::int16_t __attribute__((vector_size(8)));
using Float8 = float __attribute__((vector_size(32)));
using Float4 = float __attribute__((vector_size(16)));

/// Two rows of two nodes that follow each other along y, eight bytes each, in
/// one register.
template <class Register, class Number>
LIMPID_INLINE Register LoadRows(const Number* first, Index stride)
{
  using Halves = std::int64_t __attribute__((vector_size(16)));
  static_assert(sizeof(Register) == sizeof(Halves), "a row of two nodes is half a register");
  std::int64_t near;
  std::int64_t far;
  std::memcpy(&near, first, sizeof(near));
  std::memcpy(&far, first + stride, sizeof(far));
  return reinterpret_cast<Register>(Halves{ near, far });
}

LIMPID_INLINE float Trilinear(const CellGrid& grid, const float* first, float x, float y, float z)
{
  const Float4 front = LoadRows<Float4>(first, grid.stride[1]);
  const Float4 back = LoadRows<Float4>(first + grid.stride[2], grid.stride[1]);
  const Float4 between = front + z * (back - front);
  const float near = between[0] + y * (between[2] - between[0]);
  const float far = between[1] + y * (between[3] - between[1]);
  return near + x * (far - near);
}

/// Trilinear interpolation of four packed numbers per node, in units of
/// packedOne.
LIMPID_INLINE Float4 TrilinearFour(
  const CellGrid& grid, const std::int16_t* first, float x, float y, float z)
{
  Float8 rows[4];
  for (int row = 0; row < 4; ++row)
  {
    Packed8 pair;
    std::memcpy(
      &pair, first + 4 * ((row & 1) * grid.stride[1] + (row >> 1) * grid.stride[2]), sizeof(pair));
    rows[row] = __builtin_convertvector(pair, Float8);
  }
  const Float8 low = rows[0] + z * (rows[2] - rows[0]);
  const Float8 high = rows[1] + z * (rows[3] - rows[1]);
  const Float8 between = low + y * (high - low);
  const Float4 near = { between[0], between[1], between[2], between[3] };
  const Float4 far = { between[4], between[5], between[6], between[7] };
  return near + x * (far - near);
}

/// The four numbers of a overlay at a position [node], in units of packedOne.
LIMPID_INLINE Float4 InterpolateOverlay(const OverlayField& overlay, const float* position)
{
  const CellGrid grid(overlay.nodes);
  float fraction[3];
  Index cell = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    cell += grid.stride[axis] * grid.Split(axis, position[axis], fraction[axis]);
  }
  return TrilinearFour(
    grid, overlay.packed.data() + 4 * cell, fraction[0], fraction[1], fraction[2]);
}

/// Places sample i at sample k + i of the ray.
template <int Begin, int End, bool ExtinctionOverlay>
LIMPID_INLINE void PlaceSamples(const RayScene& scene, const Ray& ray, int k, RaySamples& samples)
{
  const CellGrid grid = scene.grid;
  for (int i = Begin; i < End; ++i)
  {
    samples.distance[i] = ray.At(k + i);
    Index cell = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const float position = ray.entry[axis] + samples.distance[i] * ray.step[axis];
      cell += grid.stride[axis] * grid.Split(axis, position, samples.fraction[axis][i]);
    }
    samples.cell[i] = cell;
  }
  if (ExtinctionOverlay)
  {
    const CellGrid overlayGrid = scene.overlayGrid;
    for (int i = Begin; i < End; ++i)
    {
      Index cell = 0;
      for (int axis = 0; axis < 3; ++axis)
      {
        const float position = ray.entry[axis] + samples.distance[i] * ray.step[axis];
        cell += overlayGrid.stride[axis] *
          overlayGrid.Split(
            axis, position * scene.overlayScale[axis], samples.overlayFraction[axis][i]);
      }
      samples.overlayCell[i] = cell;
    }
  }
}

/// Reads what decides on the extinction.
template <int Begin, int End, bool ExtinctionOverlay>
LIMPID_INLINE void ReadSamples(const RayScene& scene, RaySamples& samples)
{
  const OpticalTable<Optical> table = scene.table;
  const CellGrid grid = scene.grid;
  for (int i = Begin; i < End; ++i)
  {
    const float x = samples.fraction[0][i];
    const float y = samples.fraction[1][i];
    const float z = samples.fraction[2][i];
    samples.scalar[i] = Trilinear(grid, scene.scalars + samples.cell[i], x, y, z);
  }
  for (int i = Begin; i < End; ++i)
  {
    samples.scalar[i] = table.Position(samples.scalar[i]);
    samples.filled[i] = 1;
    samples.kept[i] = packedOne;
    samples.added[i] = 0;
    samples.shadow[i] = packedOne;
  }
  table.IntegralsAt<Begin, End>(samples.scalar, samples.integral);
  if (scene.filled)
  {
    for (int i = Begin; i < End; ++i)
    {
      samples.filled[i] = Trilinear(grid, scene.filled + samples.cell[i], samples.fraction[0][i],
        samples.fraction[1][i], samples.fraction[2][i]);
    }
  }
  if (ExtinctionOverlay)
  {
    const CellGrid overlayGrid = scene.overlayGrid;
    const std::int16_t* packed = scene.overlay;
    for (int i = Begin; i < End; ++i)
    {
      const Float4 overlay = TrilinearFour(overlayGrid, packed + 4 * samples.overlayCell[i],
        samples.overlayFraction[0][i], samples.overlayFraction[1][i],
        samples.overlayFraction[2][i]);
      samples.kept[i] = overlay[0];
      samples.added[i] = overlay[1];
      samples.shadow[i] = overlay[2];
    }
  }
}

/// Extinction and colour of the segments, with the change of the optimisation
/// and without what is empty. Returns whether there is any extinction.
LIMPID_INLINE bool ClassifySegments(const RayScene& scene, RaySamples& samples)
{
  const OpticalTable<Optical> table = scene.table;
  const float addedUnit = scene.addedUnit;
  for (int i = 0; i < RaySamples::segments; ++i)
  {
    samples.color[i] = table.Mean(
      samples.scalar[i], samples.integral[i], samples.scalar[i + 1], samples.integral[i + 1]);
  }
  float any = 0;
  for (int i = 0; i < RaySamples::segments; ++i)
  {
    const SegmentEnds ends{ samples.filled[i] + samples.filled[i + 1],
      samples.kept[i] + samples.kept[i + 1], samples.added[i] + samples.added[i + 1] };
    const float extinction = ends.Extinction(samples.color[i][0], addedUnit);
    samples.extinction[i] = extinction;
    any += extinction;
  }
  return any > 0.0f;
}

template <int Begin, int End>
LIMPID_INLINE void ReadGradients(const RayScene& scene, RaySamples& samples)
{
  const CellGrid grid = scene.grid;
  const std::int16_t* packed = scene.gradient;
  for (int i = Begin; i < End; ++i)
  {
    const Float4 gradient = TrilinearFour(grid, packed + 4 * samples.cell[i],
      samples.fraction[0][i], samples.fraction[1][i], samples.fraction[2][i]);
    samples.gradient[0][i] = gradient[0];
    samples.gradient[1][i] = gradient[1];
    samples.gradient[2][i] = gradient[2];
  }
}

/// The light that the samples send, see LightOnRay.
template <int Begin, int End>
LIMPID_INLINE void LightSamples(const RayScene& scene, const Ray& ray, RaySamples& samples)
{
  const RayLight light = scene.light; // a copy: nothing that is written below can be part of it
  const LightOnRay onRay(light, ray);
  float lit[End];
  for (int i = Begin; i < End; ++i)
  {
    lit[i] = onRay.Sent(light, samples.distance[i], samples.gradient[0][i], samples.gradient[1][i],
      samples.gradient[2][i], samples.shadow[i]);
  }
  for (int i = Begin; i < End; ++i)
  {
    samples.light[i] = lit[i];
  }
}

/// Adds the segments to a pixel, front to back.
template <bool Lit>
LIMPID_INLINE void AddSegments(const RayScene& scene, const RaySamples& samples, Pixel& pixel)
{
  float passed[RaySamples::segments];
  float given[RaySamples::segments];
  const float lengthUnit = scene.stepLength * scene.majorant;
  for (int i = 0; i < RaySamples::segments; ++i)
  {
    const float length = samples.distance[i + 1] - samples.distance[i];
    const float depth = samples.extinction[i] * lengthUnit * length;
    const Segment segment = Segment::Of<Lit>(depth, samples.light[i], samples.light[i + 1]);
    passed[i] = segment.passed;
    given[i] = segment.given;
  }
  for (int i = 0; i < RaySamples::segments; ++i)
  {
    // Segment by segment, so that it does not matter where blocks of segments begin.
    if (pixel.transmittance > scene.opaqueBelow)
    {
      pixel.Add({ passed[i], given[i] }, samples.color[i]);
    }
  }
}
} // namespace limpid

#endif
