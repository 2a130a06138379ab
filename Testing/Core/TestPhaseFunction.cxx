// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Phase functions scatter all of the light and no more.

#include "Scattering.h"
#include "Tolerance.h"

#include "render/PhaseFunction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace limpid;

namespace
{
const double anisotropies[] = { -0.9, -0.6, -0.3, 0.0, 0.3, 0.6, 0.9 };
const double powers[] = { 0, 0.5, 1, 5, 20, 100, 1000 };

/// Integral of a function of the cosine over the sphere, midpoint rule.
template <class Function>
double OverTheSphere(int rings, Function function)
{
  double sum = 0;
  for (int ring = 0; ring < rings; ++ring)
  {
    sum += function(-1 + 2 * (ring + 0.5) / rings);
  }
  return sum * 4 * truth::pi / rings;
}

/// Integral over the hemisphere of lights of a surface's scattering times the cosine of the light,
/// for a viewer `angle` from the normal. `scatter(h.n)`.
template <class Function>
double OverTheLights(double angle, int rings, Function scatter)
{
  const Vec3 viewer(std::sin(angle), 0, std::cos(angle));
  double sum = 0;
  for (int ring = 0; ring < rings; ++ring)
  {
    const double theta = 0.5 * truth::pi * (ring + 0.5) / rings;
    const int sectors = 2 * rings;
    for (int sector = 0; sector < sectors; ++sector)
    {
      const double phi = truth::pi * (sector + 0.5) / sectors; // the other half is its mirror image
      const Vec3 light(
        std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
      sum += std::sin(theta) * light.z * scatter(glm::normalize(light + viewer).z);
    }
  }
  return sum * 0.5 * truth::pi / rings * 2 * truth::pi / (2 * rings);
}

/// Euler and Maclaurin: h^2/24 of the difference of the slopes at both ends, seen along the normal
/// sin(2 theta) N cos^p(theta/2) with pi N = 1 for p = 0 and (p + 4) / 8 for large p.
Tolerance MidpointRule(int rings, double power)
{
  const double step = 0.5 * truth::pi / rings;
  return { 1.01 * step * step / 24 * (power + 4), "midpoint rule of the integral" };
}
}

TEST(PhaseFunction, OfHenyeyAndGreensteinIntegratesToOneOverTheSphere)
{
  for (const double a : anisotropies)
  {
    const int rings = 20000;
    // Euler and Maclaurin: h^2/24 of the slope at the end where the function is steepest.
    const double peak = truth::HenyeyGreenstein(std::abs(a), 1);
    const double slope = 3 * std::abs(a) / std::pow(1 - std::abs(a), 2) * peak;
    const Tolerance quadrature{ 1.01 * 2 * truth::pi * std::pow(2.0 / rings, 2) / 24 * slope,
      "midpoint rule with 20000 rings" };

    const double exact =
      OverTheSphere(rings, [&](double cosine) { return HenyeyGreenstein(a, cosine); });
    const double single = OverTheSphere(
      rings, [&](double cosine) { return double(HenyeyGreenstein(float(a), float(cosine))); });

    EXPECT_WITHIN(exact, 1, quadrature + Roundoff<double>(rings, 1)) << a;
    // 1 - 2 a cos + a^2 is not below (1 - |a|)^2, and rounded to a unit of 2 + 2 |a|.
    const Tolerance cancellation = Roundoff<float>(1.5 * 4 / std::pow(1 - std::abs(a), 2) + 8, 1.0);
    EXPECT_WITHIN(single, 1, quadrature + cancellation) << a;
    EXPECT_WITHIN(single, 1, (Tolerance{ 1e-4, "the bar" })) << a;
  }
}

TEST(PhaseFunction, OfHenyeyAndGreensteinIsTheFormulaEverywhere)
{
  for (const double a : anisotropies)
  {
    for (int step = 0; step <= 100; ++step)
    {
      const double cosine = -1 + 0.02 * step;
      const double expected = truth::HenyeyGreenstein(a, cosine);

      EXPECT_WITHIN(HenyeyGreenstein(a, cosine), expected,
        Roundoff<double>(20 / std::pow(1 - std::abs(a), 2), expected));
      const float single = HenyeyGreenstein(float(a), float(cosine));
      EXPECT_WITHIN(single, expected, Roundoff<float>(20 / std::pow(1 - std::abs(a), 2), expected));
      EXPECT_GT(single, 0);
    }
  }
}

TEST(PhaseFunction, WithoutAnisotropyScattersTheSameInAllDirections)
{
  for (const double cosine : { -1.0, -0.3, 0.0, 0.8, 1.0 })
  {
    EXPECT_WITHIN(HenyeyGreenstein(0.0, cosine), 1 / (4 * truth::pi),
      Roundoff<double>(10, 1 / (4 * truth::pi)));
  }
}

TEST(PhaseFunction, OfBlinnAndPhongIntegratesToOneSeenAlongTheNormal)
{
  for (const double power : powers)
  {
    const double unit = BlinnPhongNormalization(power);

    const double all =
      OverTheLights(0, 400, [&](double cosine) { return unit * std::pow(cosine, power); });

    EXPECT_WITHIN(all, 1, MidpointRule(400, power)) << power;
    EXPECT_WITHIN(unit, truth::LobeNormalization(power), Roundoff<double>(50, unit));
  }
}

TEST(PhaseFunction, OfBlinnAndPhongScattersNoMoreThanThereIsAtAnyAngle)
{
  for (const double power : powers)
  {
    const double unit = BlinnPhongNormalization(power);
    for (int degrees = 0; degrees < 90; degrees += 5)
    {
      const double all = OverTheLights(degrees * truth::pi / 180, 200,
        [&](double cosine) { return unit * std::pow(std::max(0.0, cosine), power); });

      EXPECT_LE(all, 1 + MidpointRule(200, power).value)
        << power << " at " << degrees << " degrees";
      EXPECT_GT(all, 0);
    }
  }
}

TEST(PhaseFunction, OfASurfaceIsLambertAndBlinnPhongAndKeepsTheEnergy)
{
  for (const double power : powers)
  {
    const double unit = BlinnPhongNormalization(power);
    const double all = OverTheLights(
      0, 400, [&](double cosine) { return SurfaceScattering(unit * std::pow(cosine, power)); });

    EXPECT_WITHIN(all, 1, MidpointRule(400, power));
  }
  EXPECT_WITHIN(
    SurfaceScattering(0.0), (1 - truth::highlightShare) / truth::pi, Roundoff<double>(4, 1));
  EXPECT_EQ(highlightShare, truth::highlightShare);
}
