// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How light is scattered, Eqs. (3)-(6), in double precision and straight from the formulas.

#ifndef limpid_testing_Scattering_h
#define limpid_testing_Scattering_h

#include "Rays.h"

#include <algorithm>
#include <cmath>

namespace truth
{
const double pi = 3.14159265358979323846;

/// f_v of Eq. (6) (Henyey and Greenstein, 1941) for the cosine between the ways in and out
/// [1/steradian].
inline double HenyeyGreenstein(double anisotropy, double cosine)
{
  const double square = anisotropy * anisotropy;
  return (1 - square) / (4 * pi * std::pow(1 + square - 2 * anisotropy * cosine, 1.5));
}

/// Factor with which (h.n)^power integrates to 1 over the hemisphere, seen along n [1/steradian].
inline double LobeNormalization(double power)
{
  return (power + 2) * (power + 4) / (8 * pi * (std::pow(2.0, -power / 2) + power));
}

/// Share of the lobe in what a surface scatters.
const double highlightShare = 0.25;

/// f_s of Eq. (6): Lambert's and a normalised lobe of Blinn and Phong [1/steradian]. All unit
/// vectors; `outward` points away from what is dense.
inline double SurfaceScattering(
  double power, const Vector& outward, const Vector& toLight, const Vector& toViewer)
{
  const Vector sum{ { toLight[0] + toViewer[0], toLight[1] + toViewer[1],
    toLight[2] + toViewer[2] } };
  const double length = std::sqrt(Dot(sum, sum));
  const double cosine = length > 0 ? std::max(0.0, Dot(sum, outward) / length) : 0.0;
  const double lobe = cosine > 0 ? LobeNormalization(power) * std::pow(cosine, power) : 0.0;
  return (1 - highlightShare) / pi + highlightShare * lobe;
}

/// Least cosine between the ways to the light and to the viewer at which a surface that faces the
/// viewer has its own colour.
const double leastTowards = 0.5;

/// What takes light on so many cells of its way to a sample is no shadow, up to this optical depth.
const double ownCells = 4;
const double mostOwnDepth = 7;

/// What a surface that faces the viewer reflects, for the cosine between the ways to the light and
/// to the viewer [1/steradian].
inline double ReflectedByFacing(double power, double towards)
{
  const double cosine = std::max(leastTowards, towards);
  const double halfAngle = std::acos(std::min(1.0, cosine)) / 2;
  const double lobe = LobeNormalization(power) * std::pow(std::cos(halfAngle), power);
  return cosine * ((1 - highlightShare) / pi + highlightShare * lobe);
}

/// How the medium is lit; `enabled` off: every sample has its own colour.
struct Illumination
{
  bool enabled = false;
  Source lamp; ///< parallel: the direction of travel
  double intensity = 1;
  double ambient = 0.35;
  double anisotropy = 0.6;
  double surface = 2; ///< k_s where the extinction is steepest
  double specularPower = 20;
  double shadowStrength = 0.7; ///< 0: no shadows
  double cell = 0;             ///< largest spacing of the nodes [length]

  /// Where the light travels at a position, unit length.
  Vector TravelAt(const Vector& position) const
  {
    return Unit(lamp.parallel ? lamp.direction : Minus(position, lamp.position));
  }
};

/// One place in the medium, as the light finds it.
struct Place
{
  Vector position;
  Vector toViewer; ///< unit length
  Vector gradient; ///< of the base extinction, over its largest length
  double arriving; ///< light, see ArrivingLight
};

/// The light that arrives at a place, from its transmittance there and where its last ownCells
/// begin.
inline double ArrivingLight(double transmittance, double before)
{
  return std::max(transmittance, std::min(before, std::exp(mostOwnDepth) * transmittance));
}

/// What of the colour reaches the viewer. `middlePhase`: f_v in the middle of the volume.
inline double Brightness(const Illumination& light, const Place& place, double middlePhase)
{
  const Vector travel = light.TravelAt(place.position);
  const double phase = HenyeyGreenstein(light.anisotropy, Dot(travel, place.toViewer));
  double reflected = 0;
  double surfaceShare = 0; // k_s
  const double steepness = std::sqrt(Dot(place.gradient, place.gradient));
  if (steepness > 0)
  {
    const Vector inward = Unit(place.gradient);
    const Vector outward{ { -inward[0], -inward[1], -inward[2] } };
    const Vector toLight{ { -travel[0], -travel[1], -travel[2] } };
    surfaceShare = light.surface * steepness;
    reflected = surfaceShare * std::max(0.0, Dot(travel, inward)) *
      SurfaceScattering(light.specularPower, outward, toLight, place.toViewer) /
      ReflectedByFacing(light.specularPower, Dot(toLight, place.toViewer));
  }
  const double lit = 1 - light.shadowStrength * (1 - place.arriving);
  const double reaching = lit * (phase / middlePhase + reflected) / (1 + surfaceShare);
  const double tone = 1 - std::pow(1 - std::min(1.0, reaching), 1.5);
  return light.ambient + (1 - light.ambient) * light.intensity * tone;
}
}

#endif
