// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The reference for pictures itself against closed forms, so that nothing rests on trust.

#include "PictureMarch.h"
#include "Tolerance.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

using limpid::Roundoff;
using limpid::Tolerance;
using truth::Color;
using truth::Frame;
using truth::Medium;
using truth::PictureMarch;
using truth::Shadow;
using truth::Source;
using truth::Vector;

namespace
{
/// One pixel of a parallel view along z: its ray starts at z = -3 and ends at z = 3.
Frame OneRay(double x, double y)
{
  Frame frame;
  frame.width = frame.height = 1;
  frame.clipToWorld = { { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 3, 0, x, y, 0, 1 } };
  return frame;
}

/// [-1, 1]^3, the scalar a function of the position; colour and extinction are linear in it.
template <class Scalar>
Medium Cube(int nodes, double extinction, const Vector& color, Scalar scalarAt)
{
  Medium medium;
  medium.scalars.lattice.nodes = { { nodes, nodes, nodes } };
  medium.scalars.lattice.origin = { { -1, -1, -1 } };
  const double spacing = 2.0 / (nodes - 1);
  medium.scalars.lattice.spacing = { { spacing, spacing, spacing } };
  truth::ForEachNode(medium.scalars.lattice,
    [&](int i, int j, int k)
    { medium.scalars.values.push_back(scalarAt(medium.scalars.lattice.Position(i, j, k))); });
  medium.extinction = { 0, 1, { 0, extinction } };
  medium.color = { 0, 1, { { { 0, 0, 0 } }, color } };
  return medium;
}

double One(const Vector&)
{
  return 1;
}

double Waves(const Vector& x)
{
  return 0.5 + 0.5 * std::sin(4 * x[0] + 1) * std::cos(3 * x[1] + 5 * x[2]);
}

const Vector white{ { 1, 1, 1 } };
}

TEST(Scattering, HenyeyAndGreensteinScatterAllOfTheLightForwardByTheAnisotropy)
{
  for (const double anisotropy : { -0.9, -0.3, 0.0, 0.6, 0.9 })
  {
    const int steps = 200000;
    double all = 0;
    double forward = 0;
    for (int step = 0; step < steps; ++step)
    {
      const double cosine = -1 + 2 * (step + 0.5) / steps;
      const double ring = 2 * truth::pi * 2 / steps;
      all += ring * truth::HenyeyGreenstein(anisotropy, cosine);
      forward += ring * cosine * truth::HenyeyGreenstein(anisotropy, cosine);
    }

    // Euler and Maclaurin: h^2/24 of the difference of the slopes at the ends, of which the one of
    // cosine times f_v at 1 (or -1) is the steepest: f_v (1 + 3 |a| / (1 - |a|)^2) there.
    const double a = std::abs(anisotropy);
    const double peak = truth::HenyeyGreenstein(a, 1);
    const Tolerance tolerance = Tolerance{ 1.01 * std::pow(2.0 / steps, 2) / 24 * 2 * truth::pi *
        2 * peak * (1 + 3 * a / std::pow(1 - a, 2)),
      "midpoint rule with 200000 steps" } +
      Roundoff<double>(1000, 1);
    EXPECT_WITHIN(all, 1, tolerance);
    EXPECT_WITHIN(forward, anisotropy, tolerance);
  }
}

TEST(Scattering, TheLobeIntegratesToOneSeenAlongTheNormal)
{
  for (const double power : { 0.0, 1.0, 20.0, 400.0 })
  {
    const int steps = 20000;
    double all = 0;
    for (int step = 0; step < steps; ++step)
    {
      const double theta = 0.5 * truth::pi * (step + 0.5) / steps;
      all += 0.5 * truth::pi / steps * 2 * truth::pi * std::sin(theta) * std::cos(theta) *
        truth::LobeNormalization(power) * std::pow(std::cos(theta / 2), power);
    }
    EXPECT_WITHIN(all, 1, (Tolerance{ 1e-5, "midpoint rule with 20000 steps" }));
  }
}

TEST(PictureMarch, FollowsBeersLawInAHomogeneousMedium)
{
  const PictureMarch march(Cube(3, 0.7, { { 1, 0.5, 0.25 } }, One), Shadow::Interpolated, 8);

  const Color color = march.Pixel(OneRay(0.3, -0.2), 0, 0);

  const double alpha = 1 - std::exp(-0.7 * 2);
  EXPECT_WITHIN(color.rgba[3], alpha, Roundoff<double>(100, 1));
  EXPECT_WITHIN(color.rgba[0], alpha, Roundoff<double>(100, 1));
  EXPECT_WITHIN(color.rgba[2], 0.25 * alpha, Roundoff<double>(100, 1));
  EXPECT_WITHIN(color.secondOrder, 0, Roundoff<double>(1e5, 1));
}

TEST(PictureMarch, EndsWhereOpaqueGeometryIs)
{
  const PictureMarch march(Cube(3, 0.7, white, One), Shadow::Interpolated, 8);
  Frame frame = OneRay(0.3, -0.2);
  const float depth = 0.1f; // z = 0.3
  frame.depth = &depth;

  EXPECT_WITHIN(march.Pixel(frame, 0, 0).rgba[3], 1 - std::exp(-0.7 * (1 + 3 * double(depth))),
    Roundoff<double>(100, 1));
}

TEST(PictureMarch, MissesWhatIsBesideTheBox)
{
  const PictureMarch march(Cube(3, 0.7, white, One), Shadow::Interpolated, 8);

  EXPECT_EQ(march.Pixel(OneRay(1.1, 0), 0, 0).rgba[3], 0);
}

TEST(PictureMarch, IntegratesALinearMedium)
{
  // mu = m s and c = s with s = (z + 1) / 2, so tau = m t^2 / 4 and, with u = tau,
  // L = int sqrt(u/m) exp(-u) du = (sqrt(pi)/2 erf(sqrt(m)) - sqrt(m) exp(-m)) / sqrt(m).
  const double m = 1.3;
  const PictureMarch march(Cube(2, m, white, [](const Vector& x) { return 0.5 * (x[2] + 1); }),
    Shadow::Interpolated, 4000);

  const Color color = march.Pixel(OneRay(0.3, -0.2), 0, 0);

  const double root = std::sqrt(m);
  const double radiance =
    (0.5 * std::sqrt(truth::pi) * std::erf(root) - root * std::exp(-m)) / root;
  const Tolerance tolerance{ color.secondOrder * std::pow(2.0 / 4000, 2), "second order" };
  EXPECT_WITHIN(color.rgba[3], 1 - std::exp(-m), tolerance);
  EXPECT_WITHIN(color.rgba[1], radiance, tolerance);
}

TEST(PictureMarch, ShadesAHomogeneousMediumLitFromTheViewer)
{
  const double mu = 0.8;
  Medium medium = Cube(3, mu, white, One);
  medium.light.enabled = true;
  medium.light.ambient = 0.3;
  medium.light.shadowStrength = 1;
  medium.light.intensity = 0.75;
  medium.light.lamp = Source::Parallel({ { 0, 0, 1 } });
  const int steps = 2000;
  const PictureMarch march(medium, Shadow::Marched, steps);

  const Color color = march.Pixel(OneRay(0.3, -0.2), 0, 0);

  // T_L = T_V = exp(-mu t): with the absorbed share a, the integral of 1 - a^1.5 over a.
  const double absorbed = -std::expm1(-2 * mu);
  const double radiance = 0.3 * absorbed + 0.7 * 0.75 * (absorbed - std::pow(absorbed, 2.5) / 2.5);
  EXPECT_WITHIN(color.rgba[0], radiance,
    (Tolerance{ color.secondOrder / std::pow(double(steps), 2), "second order" }));
}

/// Radiance of a thin medium with light that travels in the plane of x and z, over that without.
/// Its extinction grows along z, away from the viewer: n = z, k = 1 in the cube of two nodes.
double RatioOfLitToUnlit(const Vector& travel)
{
  const auto ramp = [](const Vector& x) { return 0.5 * (x[2] + 1); };
  Medium medium = Cube(2, 1, white, ramp);
  const PictureMarch unlit(medium, Shadow::Interpolated, 100);
  medium.light.enabled = true;
  medium.light.ambient = 0.25;
  medium.light.shadowStrength = 0;
  medium.light.surface = 0.8;
  medium.light.specularPower = 10;
  medium.light.lamp = Source::Parallel(travel);
  const PictureMarch lit(medium, Shadow::Interpolated, 100);
  const Frame frame = OneRay(0, 0);
  return lit.Pixel(frame, 0, 0).rgba[0] / unlit.Pixel(frame, 0, 0).rgba[0];
}

TEST(PictureMarch, ReflectsFromAPlaneSurfaceByTheFormula)
{
  const double ratio = RatioOfLitToUnlit({ { 0.96, 0, 0.28 } });

  // The half vector of (-0.96, 0, -0.28) and (0, 0, -1) is at cos(theta/2) = 0.8 to the normal; a
  // surface that faces the viewer is lit from 60 degrees at most.
  const auto scattered = [](double cosineOfHalf)
  {
    const double normalization = 12.0 * 14 / (8 * truth::pi * (std::pow(2.0, -5) + 10));
    return 0.75 / truth::pi + 0.25 * normalization * std::pow(cosineOfHalf, 10);
  };
  const double surface = 0.8 * 0.28 * scattered(0.8) / (0.5 * scattered(std::sqrt(0.75)));
  const double tone = 1 - std::pow(1 - (1 + surface) / (1 + 0.8), 1.5);
  EXPECT_WITHIN(ratio, 0.25 + 0.75 * tone, Roundoff<double>(1000, 2));
}

TEST(PictureMarch, GivesASurfaceThatFacesTheViewerItsOwnColor)
{
  EXPECT_WITHIN(RatioOfLitToUnlit({ { 0.6, 0, 0.8 } }), 1.0, Roundoff<double>(1000, 2));
}

TEST(PictureMarch, ConvergesWithinItsOwnBound)
{
  Medium medium = Cube(9, 6, { { 1, 0.6, 0.3 } }, Waves);
  medium.extinction = { 0, 1, { 0, 0.5, 0.5, 6, 1, 1, 4, 4 } };
  medium.light.enabled = true;
  medium.light.lamp = Source::Point({ { 2, 3, -2 } });
  const PictureMarch fine(medium, Shadow::Interpolated, 256);
  for (const int steps : { 1, 2, 4, 8 })
  {
    const PictureMarch coarse(medium, Shadow::Interpolated, steps);
    const double h = coarse.Unit() / steps;
    for (int pixel = 0; pixel < 20; ++pixel)
    {
      const Frame frame = OneRay(-0.9 + 0.09 * pixel, 0.7 - 0.07 * pixel);

      const Color expected = fine.Pixel(frame, 0, 0);
      const Color color = coarse.Pixel(frame, 0, 0);

      const Tolerance tolerance{ 1.01 * h * h * expected.secondOrder, "bound of second order" };
      for (int channel = 0; channel < 4; ++channel)
      {
        EXPECT_WITHIN(color.rgba[channel], expected.rgba[channel], tolerance);
      }
    }
  }
}

namespace
{
/// A homogeneous cube of extinction 2 whose change is given at its eight corners, z slowest.
Medium ChangedCube(const std::vector<double>& base, const std::vector<double>& changed)
{
  Medium medium = Cube(5, 4, white, [](const Vector&) { return 0.5; });
  medium.base.lattice = medium.scalars.lattice;
  medium.base.lattice.nodes = { { 2, 2, 2 } };
  medium.base.lattice.spacing = { { 2, 2, 2 } };
  medium.changed.lattice = medium.base.lattice;
  medium.base.values = base;
  medium.changed.values = changed;
  return medium;
}
}

TEST(PictureMarch, KeepsTheShareOfTheExtinctionThatIsLeft)
{
  const PictureMarch march(
    ChangedCube(std::vector<double>(8, 1.0), { 1, 1, 1, 1, 0, 0, 0, 0 }), Shadow::Interpolated, 9);

  const Color color = march.Pixel(OneRay(0.2, 0.4), 0, 0);

  // mu = 2 (1 - z) / 2
  EXPECT_WITHIN(march.ExtinctionAt({ { 0.1, 0.2, -0.5 } }), 1.5, Roundoff<double>(20, 2));
  EXPECT_WITHIN(color.rgba[3], 1 - std::exp(-2), Roundoff<double>(100, 1));
}

TEST(PictureMarch, AddsWhatExceedsTheBaseUpToTheMajorant)
{
  const PictureMarch march(
    ChangedCube(std::vector<double>(8, 1.0), { 1, 1, 1, 1, 7, 7, 7, 7 }), Shadow::Interpolated, 9);

  // mu = 2 + 6 (z + 1) / 2, not above 4
  EXPECT_WITHIN(march.ExtinctionAt({ { 0.1, 0.2, -0.5 } }), 3.5, Roundoff<double>(20, 4));
  EXPECT_EQ(march.ExtinctionAt({ { 0.1, 0.2, 0.5 } }), 4);
}

TEST(PictureMarch, KeepsWithoutBaseTheMeanOfTheNeighboursShares)
{
  // The first corner has no base; of its neighbours, one keeps all, one a half, one has no base.
  const PictureMarch march(
    ChangedCube({ 0, 1, 1, 1, 0, 1, 1, 1 }, { 0, 1, 0.5, 1, 0, 1, 1, 1 }), Shadow::Interpolated, 9);

  EXPECT_WITHIN(march.ExtinctionAt({ { -1, -1, -1 } }), 2 * 0.75, Roundoff<double>(20, 2));
}
