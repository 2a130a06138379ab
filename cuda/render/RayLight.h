// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How a sample is lit, the same for all backends.

#ifndef limpid_render_RayLight_h
#define limpid_render_RayLight_h

#include "math/Exp.h"
#include "render/PackedNumbers.h"
#include "render/PhaseFunction.h"
#include "render/Ray.h"

#include <cmath>

namespace limpid
{
/// factor x^power for x in [0, 1].
struct Lobe
{
  float factor = 0;
  float power = 0;

  template <class Number>
  LIMPID_HD LIMPID_INLINE Number At(const Number& x) const
  {
    const Number depth = -this->power * Logarithm(AtLeast(x, 1e-30f));
    return this->factor * Attenuate(AtLeast(depth, 0.0f));
  }
};

/// Least cosine between the ways to the light and to the viewer at which a surface that faces the
/// viewer is fully lit: one that the light meets at a flatter angle is not.
constexpr float leastTowards = 0.5f;

/// The layer in which a surface fades into what is seen of it is to keep its colour: what takes
/// light within so many cells is no shadow, up to this optical depth.
constexpr double ownCells = 4;
constexpr float mostOwnDepth = 4.5f;

/// Share of its colour that a sample sends of direct light, for the light that reaches it and is
/// scattered to the viewer, relative to that on a surface that faces both: 1 there, smoothly less
/// below, and never more, so that no colour is brighter than that of the transfer function.
template <class Number>
LIMPID_HD LIMPID_INLINE Number ToneOf(const Number& light)
{
  const Number lacking = AtLeast(1.0f - light, 0.0f);
  return 1.0f - lacking * SquareRoot(lacking);
}

/// The light and how it is scattered, for all rays of a picture; directions in the world.
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
  float ownLength = 0;  ///< of ownCells [length]
  Lobe lobe;            ///< of Blinn and Phong, normalised [1/steradian]

  /// Eq. (4): the share of its colour that a sample sends to the viewer, of the light that it
  /// scatters there (LightOnRay), of the light's transmittance to it [packedOne], and of the
  /// extinction there [1/length].
  template <class Number>
  LIMPID_HD LIMPID_INLINE Number Sent(
    const Number& scattered, const Number& transmittance, const Number& extinction) const
  {
    const Number own = Attenuate(AtMost(extinction * this->ownLength, mostOwnDepth));
    const Number lit = AtMost(transmittance * (1 / packedOne) / own, 1.0f);
    const Number arriving = 1.0f - this->shadow * (1.0f - lit);
    return this->ambient + this->diffuse * ToneOf(arriving * scattered);
  }
};

/// Throws limpid::Error unless a picture can be lit like this.
void RequireLighting(const Lighting& lighting);

/// The light of a picture. `grid`: of the scalars.
RayLight MakeRayLight(const Lighting& settings, const Grid& grid, const View& view);

/// The light as the samples of one ray meet it.
struct LightOnRay
{
  float entryX; ///< its way to the ray's entry, and what is added from sample to sample [radii]
  float entryY;
  float entryZ;
  float stepX;
  float stepY;
  float stepZ;
  float viewX; ///< to the viewer
  float viewY;
  float viewZ;

  LIMPID_HD LIMPID_INLINE LightOnRay(const RayLight& light, const Ray& ray)
    : entryX(light.isPoint * ray.lightEntry[0] - light.origin[0])
    , entryY(light.isPoint * ray.lightEntry[1] - light.origin[1])
    , entryZ(light.isPoint * ray.lightEntry[2] - light.origin[2])
    , stepX(light.isPoint * ray.lightStep[0])
    , stepY(light.isPoint * ray.lightStep[1])
    , stepZ(light.isPoint * ray.lightStep[2])
    , viewX(ray.toViewer[0])
    , viewY(ray.toViewer[1])
    , viewZ(ray.toViewer[2])
  {
  }

  /// The phase function of Eq. (5): what the sample at `distance` [samples] scatters to the viewer
  /// of light that arrives, 1 on a surface that faces both (Documentation/Method.md, "Light";
  /// deviation D10). Gradient: [packedOne].
  template <class Number>
  LIMPID_HD LIMPID_INLINE Number Scattered(const RayLight& light, const Number& distance,
    const Number& packedX, const Number& packedY, const Number& packedZ) const
  {
    // Direction of travel of the light.
    Number x = this->entryX + distance * this->stepX;
    Number y = this->entryY + distance * this->stepY;
    Number z = this->entryZ + distance * this->stepZ;
    const Number perLength = 1.0f / SquareRoot(x * x + y * y + z * z + 1e-30f);
    x = x * perLength;
    y = y * perLength;
    z = z * perLength;
    const Number cosine = x * this->viewX + y * this->viewY + z * this->viewZ;

    // The gradient's length is k_s, relative to its largest; its direction the normal, which points
    // into the volume, while the halfway vector points out of it.
    const Number gradientX = packedX * (1 / packedOne);
    const Number gradientY = packedY * (1 / packedOne);
    const Number gradientZ = packedZ * (1 / packedOne);
    const Number squared =
      gradientX * gradientX + gradientY * gradientY + gradientZ * gradientZ + 1e-20f;
    const Number facing = x * gradientX + y * gradientY + z * gradientZ; // k_s (w_L . n)
    const Number halfX = x - this->viewX;
    const Number halfY = y - this->viewY;
    const Number halfZ = z - this->viewZ;
    const Number across = halfX * gradientX + halfY * gradientY + halfZ * gradientZ;
    const Number halfSquared = halfX * halfX + halfY * halfY + halfZ * halfZ + 1e-20f;
    const Number halfway = across / SquareRoot(squared * halfSquared);
    const Number lobe = light.lobe.At(AtLeast(halfway, 0.0f));

    // The unit of what a surface reflects: what one does that faces the viewer.
    const Number towards = AtLeast(-cosine, leastTowards);
    const Number lobeOfFacing = light.lobe.At(SquareRoot(0.5f + 0.5f * towards));
    const Number ofFacing = towards * SurfaceScattering(lobeOfFacing);

    const Number scattered = HenyeyGreenstein(light.anisotropy, cosine) * light.phaseUnit;
    const Number reflected =
      light.surface * SurfaceScattering(lobe) * AtLeast(facing, 0.0f) / ofFacing;
    const Number steepness = light.surface * SquareRoot(squared); // k_s, with k_v = 1
    return (scattered + reflected) / (1.0f + steepness);
  }
};
}

#endif
