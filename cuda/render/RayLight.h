// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The lighting of a sample, for all backends.

#ifndef limpid_render_RayLight_h
#define limpid_render_RayLight_h

#include "math/Exp.h"
#include "render/PackedNumbers.h"
#include "render/PhaseFunction.h"
#include "render/Ray.h"

#include <cmath>

namespace limpid
{
/// Computes factor x^power for x in [0, 1].
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

/// The least cosine between the directions to the light and to the viewer at which a surface that
/// faces the viewer is fully lit. Light at a flatter angle lights it less.
constexpr float leastTowards = 0.5f;

/// Returns the share of its colour that a sample sends as direct light. The argument is the light
/// that reaches the sample and is scattered to the viewer, relative to a surface that faces both.
/// The result is 1 there, decreases smoothly below, and never exceeds 1, so that no colour is
/// brighter than that of the transfer function.
template <class Number>
LIMPID_HD LIMPID_INLINE Number ToneOf(const Number& light)
{
  const Number lacking = AtLeast(1.0f - light, 0.0f);
  return 1.0f - lacking * SquareRoot(lacking);
}

/// The light of a picture and its scattering, common to all rays; directions in the world.
struct RayLight
{
  float origin[3] = { 0, 0, 0 }; ///< point light: its position [radii]; else the direction towards
                                 ///< it
  float isPoint = 0;             ///< 1 or 0
  float ambient = 1;
  float diffuse = 0;    ///< share of direct light, times intensity
  float anisotropy = 0; ///< a of the Henyey-Greenstein function
  float phaseUnit = 0;  ///< 1 / f_v at the centre of the volume [steradian]
  float surface = 0;    ///< k_s
  float shadow = 0;     ///< shadow strength
  Lobe lobe;            ///< normalised Blinn-Phong lobe [1/steradian]

  /// Returns the share of its colour that a sample sends to the viewer, Eq. (4), from the scattered
  /// share of light (LightOnRay) and the light that arrives (ArrivingNode) [packedOne].
  template <class Number>
  LIMPID_HD LIMPID_INLINE Number Sent(const Number& scattered, const Number& arriving) const
  {
    const Number lit = 1.0f - this->shadow * (1.0f - arriving * (1 / packedOne));
    return this->ambient + this->diffuse * ToneOf(lit * scattered);
  }
};

/// Throws limpid::Error if the lighting is invalid.
void RequireLighting(const Lighting& lighting);

/// Returns the light of a picture. `grid`: of the scalars.
RayLight MakeRayLight(const Lighting& settings, const Grid& grid, const View& view);

/// What the direction of the light determines at a sample.
template <class Number>
struct LightDirection
{
  Number x; ///< direction of travel of the light, a unit vector
  Number y;
  Number z;
  Number halfX; ///< halfway vector, not normalised, and its squared length
  Number halfY;
  Number halfZ;
  Number halfSquared;
  Number ofFacing;  ///< unit of what a surface reflects: that of a surface that faces the viewer
  Number scattered; ///< by matter without a surface
};

/// The light at the samples of one ray.
struct LightOnRay
{
  float entryX; ///< vector from the light to the ray's entry, and its change per sample [radii]
  float entryY;
  float entryZ;
  float stepX;
  float stepY;
  float stepZ;
  float viewX; ///< direction to the viewer
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

  /// Returns what the light's direction determines at the samples at `distance` [samples]. It is
  /// the same at all samples of a ray unless the light has a position.
  template <class Number>
  LIMPID_HD LIMPID_INLINE LightDirection<Number> DirectionAt(
    const RayLight& light, const Number& distance) const
  {
    LightDirection<Number> of;
    of.x = this->entryX + distance * this->stepX;
    of.y = this->entryY + distance * this->stepY;
    of.z = this->entryZ + distance * this->stepZ;
    const Number perLength = 1.0f / SquareRoot(of.x * of.x + of.y * of.y + of.z * of.z + 1e-30f);
    of.x = of.x * perLength;
    of.y = of.y * perLength;
    of.z = of.z * perLength;
    const Number cosine = of.x * this->viewX + of.y * this->viewY + of.z * this->viewZ;

    // The halfway vector points out of the volume.
    of.halfX = of.x - this->viewX;
    of.halfY = of.y - this->viewY;
    of.halfZ = of.z - this->viewZ;
    of.halfSquared = of.halfX * of.halfX + of.halfY * of.halfY + of.halfZ * of.halfZ + 1e-20f;

    const Number towards = AtLeast(-cosine, leastTowards);
    const Number lobeOfFacing = light.lobe.At(SquareRoot(0.5f + 0.5f * towards));
    of.ofFacing = towards * SurfaceScattering(lobeOfFacing);
    of.scattered = HenyeyGreenstein(light.anisotropy, cosine) * light.phaseUnit;
    return of;
  }
};

/// The phase function of Eq. (5): returns the share of arriving light that samples scatter to the
/// viewer, 1 on a surface that faces both (Documentation/Method.md, "Light"; deviation D10).
/// Gradient: [packedOne].
template <class Number>
LIMPID_HD LIMPID_INLINE Number Scattered(const RayLight& light, const LightDirection<Number>& of,
  const Number& packedX, const Number& packedY, const Number& packedZ)
{
  // The gradient has length k_s, relative to the largest gradient. Its direction is the normal
  // pointing into the volume.
  const Number gradientX = packedX * (1 / packedOne);
  const Number gradientY = packedY * (1 / packedOne);
  const Number gradientZ = packedZ * (1 / packedOne);
  const Number squared =
    gradientX * gradientX + gradientY * gradientY + gradientZ * gradientZ + 1e-20f;
  // k_s (w_L . n)
  const Number facing = of.x * gradientX + of.y * gradientY + of.z * gradientZ;
  const Number across = of.halfX * gradientX + of.halfY * gradientY + of.halfZ * gradientZ;
  const Number halfway = across / SquareRoot(squared * of.halfSquared);
  const Number lobe = light.lobe.At(AtLeast(halfway, 0.0f));

  const Number reflected =
    light.surface * SurfaceScattering(lobe) * AtLeast(facing, 0.0f) / of.ofFacing;
  const Number steepness = light.surface * SquareRoot(squared); // k_s, with k_v = 1
  return (of.scattered + reflected) / (1.0f + steepness);
}
}

#endif
