// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Pictures in 8 bits against the reference in double precision.

#ifndef limpid_testing_PictureErrors_h
#define limpid_testing_PictureErrors_h

#include "RenderScene.h"
#include "Tolerance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace limpid
{
/// Rounding to 8 bits, and float arithmetic along a ray of a few hundred samples.
inline Tolerance EightBits()
{
  return Tolerance{ 0.5 / 255, "rounding to 8 bits" } + Roundoff<float>(300, 1.0);
}

/// What a change of the light that reaches a sample and is scattered to the viewer is multiplied
/// with: direct light, and the largest slope of the tone, 1.5.
inline double DirectLight(const Lighting& lighting)
{
  return lighting.enabled ? 1.5 * (1 - lighting.ambient) * lighting.intensity : 0.0;
}

/// Largest phase function over that in the middle that the scenes of these tests have: a few.
constexpr double mostScattered = 5;

/// What 16-bit gradients cost: a component of the gradient is off by up to half a unit, 1/65534,
/// its length by sqrt(3) times that; k_s (w.n) changes by k_s times as much, k_s in 1 + k_s too,
/// and the lobe N (h.n)^p by N p dn with k dn = that.
inline Tolerance StoredGradient(const Lighting& lighting)
{
  const double power = lighting.specularPower;
  const double lobe = truth::highlightShare * truth::LobeNormalization(power);
  const double component = std::sqrt(3.0) / 65534 * lighting.surface;
  const double scattering = (1 - truth::highlightShare) / truth::pi + lobe * (1 + power);
  const double unit = truth::ReflectedByFacing(power, truth::leastTowards); // the least there is
  return { DirectLight(lighting) * component * (scattering / unit + mostScattered),
    "16-bit gradient" };
}

/// What 16 bits of change and light cost: half a unit of 1/32767 each, of what is kept and what is
/// added in units of the majorant over the whole way through the box, and of the light.
inline Tolerance StoredMedium(const RenderScene& scene)
{
  const double majorant =
    *std::max_element(scene.functions.extinction.begin(), scene.functions.extinction.end());
  const double change =
    scene.extinction.empty() ? 0.0 : 2 * majorant * 2 * scene.grid.Radius() / 65534;
  const double light = scene.lighting.shadowStrength;
  return { change + DirectLight(scene.lighting) * mostScattered * light / 65534,
    "16-bit change and light" };
}

inline double Channel(const Picture& picture, std::size_t pixel, int channel)
{
  return picture.rgba[4 * pixel + std::size_t(channel)] / 255.0;
}

/// What the picture shows of a channel: colours brighter than their alpha are toned down alike.
inline double Shown(const truth::Color& color, int channel)
{
  const std::array<double, 4>& rgba = color.rgba;
  const double brightest = std::max({ rgba[0], rgba[1], rgba[2] });
  const double tone = channel < 3 && brightest > rgba[3] ? rgba[3] / brightest : 1.0;
  return tone * rgba[std::size_t(channel)];
}

/// Whether every channel of every pixel is within the tolerance plus the second-order bound of the
/// pixel, and how close it comes.
struct Comparison
{
  double worst = 0; ///< largest error over what is allowed
  std::string where;
  double meanError = 0;   ///< over pixels and channels, with sign
  double rms = 0;         ///< likewise
  double meanAllowed = 0; ///< mean of what is allowed
};

inline Comparison Compare(const RenderScene& scene, const Picture& picture,
  const std::vector<truth::Color>& truth, const Tolerance& tolerance)
{
  Comparison result;
  const double step = scene.StepLength();
  for (std::size_t pixel = 0; pixel < truth.size(); ++pixel)
  {
    const double allowed = tolerance.value + step * step * truth[pixel].secondOrder;
    result.meanAllowed += allowed / double(truth.size());
    for (int channel = 0; channel < 4; ++channel)
    {
      const double error = Channel(picture, pixel, channel) - Shown(truth[pixel], channel);
      result.meanError += error / (4 * double(truth.size()));
      result.rms += error * error / (4 * double(truth.size()));
      if (!(std::abs(error) / allowed <= result.worst))
      {
        result.worst = std::abs(error) / allowed;
        result.where = "pixel (" + std::to_string(pixel % std::size_t(picture.width)) + ", " +
          std::to_string(pixel / std::size_t(picture.width)) + ") channel " +
          std::to_string(channel) + ": " + std::to_string(Channel(picture, pixel, channel)) +
          " instead of " + std::to_string(Shown(truth[pixel], channel)) + ", allowed " +
          std::to_string(allowed) + " (" + tolerance.reason + ", and sampling of second order)";
      }
    }
  }
  result.rms = std::sqrt(result.rms);
  return result;
}

/// Every pixel within the tolerance plus the second-order bound of its ray.
inline void ExpectPicture(const RenderScene& scene, const Picture& picture,
  const std::vector<truth::Color>& truth, const Tolerance& tolerance)
{
  ASSERT_EQ(picture.rgba.size(), 4 * truth.size());
  const Comparison comparison = Compare(scene, picture, truth, tolerance);
  EXPECT_LE(comparison.worst, 1) << comparison.where;
}
}

#endif
