// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A few consecutive samples of one ray: what the fields hold there, how they
// are lit, and what the segments between them add to a pixel.

#ifndef limpid_render_RaySamples_h
#define limpid_render_RaySamples_h

#include "math/Exp.h"
#include "render/Bricks.h"
#include "render/Fields.h"
#include "render/PhaseFunction.h"

#include <cstring>

namespace limpid
{
/// factor x^power for x in [0, 1].
struct Lobe
{
  float factor = 0;
  float power = 0;

  LIMPID_INLINE float At(float x) const
  {
    const float base = x > 1e-30f ? x : 1e-30f;
    const float depth = -this->power * Logarithm(base);
    return this->factor * Attenuate(depth > 0.0f ? depth : 0.0f);
  }
};

/// The light and how it is scattered, for all rays of a picture; directions in
/// the world.
struct RayLight
{
  float origin[3] = { 0, 0, 0 }; ///< point light: its place [radii]; else against its way
  float isPoint = 0;             ///< 1 or 0
  float ambient = 1;
  float diffuse = 0;    ///< share of direct light, times its intensity
  float anisotropy = 0; ///< a of Henyey and Greenstein
  float phaseUnit = 0;  ///< 1 / f_v in the middle of the volume [steradian]
  float surface = 0;    ///< k_s
  float shadow = 0;     ///< shadow strength
  Lobe lobe;            ///< of Blinn and Phong, normalised [1/steradian]
};

/// What all rays of a picture share.
struct RayScene
{
  const ScalarField* scalars = nullptr;
  const Classification* classification = nullptr;
  const GradientField* gradient = nullptr; ///< null: not lit
  const MediumField* medium = nullptr;     ///< null: neither changed nor shadowed
  const Bricks* bricks = nullptr;          ///< null: nothing is skipped
  float mediumScale[3] = { 1, 1, 1 };      ///< nodes of the medium per node of the scalars
  float opaqueBelow = 0;
  float stepLength = 1; ///< between samples [length]
  float majorant = 0;   ///< of the transfer function [1/length]
  float addedUnit = 1;  ///< of what the medium adds [majorant]
  RayLight light;
};

/// One ray, by the number of the sample from its entry into the box on.
struct Ray
{
  float entry[3] = { 0, 0, 0 };      ///< where it enters [index]
  float step[3] = { 0, 0, 0 };       ///< from sample to sample [index]
  float lightEntry[3] = { 0, 0, 0 }; ///< the same from the middle of the box [radii, world]
  float lightStep[3] = { 0, 0, 0 };
  float toViewer[3] = { 0, 0, 0 }; ///< unit vector, world
  float length = 0;                ///< samples from entry to exit
  float shift = 0;                 ///< the first sample is that far before the entry [samples]
  int segments = 0;

  /// Distance of sample `k` from the entry [samples].
  LIMPID_INLINE float At(int k) const
  {
    const float distance = static_cast<float>(k) - this->shift;
    const float behindEntry = distance > 0.0f ? distance : 0.0f;
    return behindEntry < this->length ? behindEntry : this->length;
  }
};

/// What a pixel has received so far.
struct Pixel
{
  Optical light = { 0, 0, 0, 0 }; ///< second to fourth: red, green, blue
  float transmittance = 1;
};

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
  Index mediumCell[count]; ///< the same in the grid of the medium
  float mediumFraction[3][count];
  float scalar[count]; ///< table position
  float filled[count]; ///< 1, less beside empty nodes
  float kept[count];   ///< share of the transfer function's extinction [packedOne]
  float added[count];  ///< extinction [packedOne majorants]
  float shadow[count]; ///< transmittance of the light [packedOne]
  float gradient[3][count];
  float light[count];      ///< share of its colour that a sample sends to the viewer
  Optical integral[count]; ///< see Classification::IntegralsAt

  float extinction[segments]; ///< [majorant]
  Optical color[segments];    ///< second to fourth: red, green, blue

  /// The first sample is empty until it is read.
  LIMPID_INLINE RaySamples()
  {
    this->distance[0] = this->scalar[0] = this->filled[0] = 0;
    this->kept[0] = this->added[0] = this->shadow[0] = this->light[0] = 0;
    this->integral[0] = Optical{ 0, 0, 0, 0 };
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

/// A grid's nodes as trilinear interpolation reads them.
struct CellGrid
{
  float lastNode[3];
  float lastCell[3];
  Index stride[3];

  LIMPID_INLINE explicit CellGrid(const Int3& nodes)
    : lastNode{ float(nodes.x - 1), float(nodes.y - 1), float(nodes.z - 1) }
    , lastCell{ float(nodes.x - 2), float(nodes.y - 2), float(nodes.z - 2) }
    , stride{ 1, nodes.x, Index(nodes.x) * nodes.y }
  {
  }

  /// Splits a coordinate into the node before and the fraction of a cell.
  LIMPID_INLINE Index Split(int axis, float position, float& fraction) const
  {
    float inside = position > 0.0f ? position : 0.0f;
    inside = inside < this->lastNode[axis] ? inside : this->lastNode[axis];
    const float limit = inside < this->lastCell[axis] ? inside : this->lastCell[axis];
    const int before = static_cast<int>(limit);
    fraction = inside - static_cast<float>(before);
    return before;
  }
};

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

/// The four numbers of a medium at a position [node], in units of packedOne.
LIMPID_INLINE Float4 InterpolateMedium(const MediumField& medium, const float* position)
{
  const CellGrid grid(medium.nodes);
  float fraction[3];
  Index cell = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    cell += grid.stride[axis] * grid.Split(axis, position[axis], fraction[axis]);
  }
  return TrilinearFour(
    grid, medium.packed.data() + 4 * cell, fraction[0], fraction[1], fraction[2]);
}

/// Places sample i at sample k + i of the ray.
template <int Begin, int End, bool Medium>
LIMPID_INLINE void PlaceSamples(const RayScene& scene, const Ray& ray, int k, RaySamples& samples)
{
  const CellGrid grid(scene.scalars->grid.nodes);
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
  if (Medium)
  {
    const CellGrid mediumGrid(scene.medium->nodes);
    for (int i = Begin; i < End; ++i)
    {
      Index cell = 0;
      for (int axis = 0; axis < 3; ++axis)
      {
        const float position = ray.entry[axis] + samples.distance[i] * ray.step[axis];
        cell += mediumGrid.stride[axis] *
          mediumGrid.Split(
            axis, position * scene.mediumScale[axis], samples.mediumFraction[axis][i]);
      }
      samples.mediumCell[i] = cell;
    }
  }
}

/// Reads what decides on the extinction.
template <int Begin, int End, bool Medium>
LIMPID_INLINE void ReadSamples(const RayScene& scene, RaySamples& samples)
{
  const ScalarField& scalars = *scene.scalars;
  const CellGrid grid(scalars.grid.nodes);
  for (int i = Begin; i < End; ++i)
  {
    const float x = samples.fraction[0][i];
    const float y = samples.fraction[1][i];
    const float z = samples.fraction[2][i];
    samples.scalar[i] = Trilinear(grid, scalars.values + samples.cell[i], x, y, z);
  }
  for (int i = Begin; i < End; ++i)
  {
    samples.scalar[i] = scene.classification->Position(samples.scalar[i]);
    samples.filled[i] = 1;
    samples.kept[i] = packedOne;
    samples.added[i] = 0;
    samples.shadow[i] = packedOne;
  }
  scene.classification->IntegralsAt<Begin, End>(samples.scalar, samples.integral);
  if (!scalars.filled.empty())
  {
    for (int i = Begin; i < End; ++i)
    {
      samples.filled[i] = Trilinear(grid, scalars.filled.data() + samples.cell[i],
        samples.fraction[0][i], samples.fraction[1][i], samples.fraction[2][i]);
    }
  }
  if (Medium)
  {
    const CellGrid mediumGrid(scene.medium->nodes);
    const std::int16_t* packed = scene.medium->packed.data();
    for (int i = Begin; i < End; ++i)
    {
      const Float4 medium = TrilinearFour(mediumGrid, packed + 4 * samples.mediumCell[i],
        samples.mediumFraction[0][i], samples.mediumFraction[1][i], samples.mediumFraction[2][i]);
      samples.kept[i] = medium[0];
      samples.added[i] = medium[1];
      samples.shadow[i] = medium[2];
    }
  }
}

/// Extinction and colour of the segments, with the change of the optimisation
/// and without what is empty. Returns whether there is any extinction.
LIMPID_INLINE bool ClassifySegments(const RayScene& scene, RaySamples& samples)
{
  for (int i = 0; i < RaySamples::segments; ++i)
  {
    samples.color[i] = scene.classification->Mean(
      samples.scalar[i], samples.integral[i], samples.scalar[i + 1], samples.integral[i + 1]);
  }
  const float most = scene.addedUnit > 1.0f ? scene.addedUnit : 1.0f;
  float any = 0;
  for (int i = 0; i < RaySamples::segments; ++i)
  {
    const float filled = 0.5f * (samples.filled[i] + samples.filled[i + 1]);
    const float kept = (0.5f / packedOne) * (samples.kept[i] + samples.kept[i + 1]);
    const float added =
      (0.5f / packedOne) * scene.addedUnit * (samples.added[i] + samples.added[i + 1]);
    float extinction = samples.color[i][0] * filled * kept + added;
    extinction = extinction < most ? extinction : most;
    samples.extinction[i] = extinction;
    any += extinction;
  }
  return any > 0.0f;
}

template <int Begin, int End>
LIMPID_INLINE void ReadGradients(const RayScene& scene, RaySamples& samples)
{
  const CellGrid grid(scene.scalars->grid.nodes);
  const std::int16_t* packed = scene.gradient->packed.data();
  for (int i = Begin; i < End; ++i)
  {
    const Float4 gradient = TrilinearFour(grid, packed + 4 * samples.cell[i],
      samples.fraction[0][i], samples.fraction[1][i], samples.fraction[2][i]);
    samples.gradient[0][i] = gradient[0];
    samples.gradient[1][i] = gradient[1];
    samples.gradient[2][i] = gradient[2];
  }
}

/// Eq. 6 and the light of Eq. 4: the share of its colour that a sample sends to
/// the viewer. Documentation/Method.md, "Light".
template <int Begin, int End>
LIMPID_INLINE void LightSamples(const RayScene& source, const Ray& ray, RaySamples& samples)
{
  const RayLight scene = source.light; // a copy: nothing that is written below can be part of it
  const float viewX = ray.toViewer[0];
  const float viewY = ray.toViewer[1];
  const float viewZ = ray.toViewer[2];
  const float entryX = scene.isPoint * ray.lightEntry[0] - scene.origin[0];
  const float entryY = scene.isPoint * ray.lightEntry[1] - scene.origin[1];
  const float entryZ = scene.isPoint * ray.lightEntry[2] - scene.origin[2];
  const float stepX = scene.isPoint * ray.lightStep[0];
  const float stepY = scene.isPoint * ray.lightStep[1];
  const float stepZ = scene.isPoint * ray.lightStep[2];
  float lit[End];
  for (int i = Begin; i < End; ++i)
  {
    // Direction of travel of the light.
    float x = entryX + samples.distance[i] * stepX;
    float y = entryY + samples.distance[i] * stepY;
    float z = entryZ + samples.distance[i] * stepZ;
    const float perLength = 1.0f / std::sqrt(x * x + y * y + z * z + 1e-30f);
    x *= perLength;
    y *= perLength;
    z *= perLength;
    const float cosine = x * viewX + y * viewY + z * viewZ;

    // The gradient's length is k_s, relative to its largest; its direction the
    // normal, which points into the medium, while the halfway vector points out
    // of it.
    const float gradientX = samples.gradient[0][i] * (1 / packedOne);
    const float gradientY = samples.gradient[1][i] * (1 / packedOne);
    const float gradientZ = samples.gradient[2][i] * (1 / packedOne);
    const float squared =
      gradientX * gradientX + gradientY * gradientY + gradientZ * gradientZ + 1e-20f;
    const float facing = x * gradientX + y * gradientY + z * gradientZ; // k_s (w_L . n)
    const float halfX = x - viewX;
    const float halfY = y - viewY;
    const float halfZ = z - viewZ;
    const float across = halfX * gradientX + halfY * gradientY + halfZ * gradientZ;
    const float halfSquared = halfX * halfX + halfY * halfY + halfZ * halfZ + 1e-20f;
    const float halfway = across / std::sqrt(squared * halfSquared);
    const float lobe = scene.lobe.At(halfway > 0.0f ? halfway : 0.0f);

    const float scattered = HenyeyGreenstein(scene.anisotropy, cosine) * scene.phaseUnit;
    const float reflected =
      scene.surface * float(pi) * SurfaceScattering(lobe) * (facing > 0.0f ? facing : 0.0f);
    const float steepness = scene.surface * std::sqrt(squared); // k_s, with k_v = 1
    const float sent = (scattered + reflected) / (1.0f + steepness);
    const float arriving = 1.0f - scene.shadow * (1.0f - samples.shadow[i] * (1 / packedOne));
    lit[i] = scene.ambient + scene.diffuse * arriving * sent;
  }
  for (int i = Begin; i < End; ++i)
  {
    samples.light[i] = lit[i];
  }
}

/// Adds the segments to a pixel, front to back: the integral of Eq. 1 with the
/// extinction and the colour of a segment constant and the light linear in
/// optical depth along it.
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
    passed[i] = Attenuate(depth);
    const float absorbed = 1.0f - passed[i];
    if (Lit)
    {
      // Weight of the rear end: (1 - exp(-d) (1 + d)) / d, or its series.
      const float series = depth * (0.5f - depth * (1.0f / 3.0f - depth * 0.125f));
      const float exact = (absorbed - passed[i] * depth) / (depth + 1e-30f);
      const float rear = depth > 0.05f ? exact : series;
      given[i] = (absorbed - rear) * samples.light[i] + rear * samples.light[i + 1];
    }
    else
    {
      given[i] = absorbed;
    }
  }
  for (int i = 0; i < RaySamples::segments; ++i)
  {
    // Segment by segment, so that it does not matter where blocks of segments begin.
    if (pixel.transmittance > scene.opaqueBelow)
    {
      pixel.light += pixel.transmittance * given[i] * samples.color[i];
      pixel.transmittance *= passed[i];
    }
  }
}
} // namespace limpid

#endif
