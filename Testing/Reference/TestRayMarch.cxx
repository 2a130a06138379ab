// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The reference itself against closed forms, so that nothing rests on trust.

#include "RayMarch.h"
#include "Tolerance.h"

#include <array>
#include <cmath>
#include <vector>

using limpid::Relative;
using limpid::Roundoff;
using truth::Sampling;
using truth::Source;
using truth::Vector;
using truth::Volume;
using truth::Widening;

namespace
{
/// A lattice with two fields, given as functions of the position.
struct Box
{
  truth::Lattice lattice;
  std::vector<double> extinction;
  std::vector<double> importance;

  template <class Extinction, class Importance>
  Box(const std::array<int, 3>& nodes, const Vector& origin, const Vector& spacing,
    Extinction extinctionAt, Importance importanceAt)
  {
    lattice.nodes = nodes;
    lattice.origin = origin;
    lattice.spacing = spacing;
    for (int k = 0; k < nodes[2]; ++k)
    {
      for (int j = 0; j < nodes[1]; ++j)
      {
        for (int i = 0; i < nodes[0]; ++i)
        {
          const Vector x = lattice.Position(i, j, k);
          extinction.push_back(extinctionAt(x));
          importance.push_back(importanceAt(x));
        }
      }
    }
  }

  Volume<double> Fields() const { return { lattice, extinction.data(), importance.data() }; }
};

auto Constant(double value)
{
  return [value](const Vector&) { return value; };
}

double Distance(const Vector& a, const Vector& b)
{
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// A soft ball round a centre.
auto Ball(const Vector& centre, double radius, double height)
{
  return [=](const Vector& x)
  { return height * std::exp(-std::pow(Distance(x, centre) / radius, 2)); };
}

/// Anisotropic, off the origin: 4 x 3 x 2 with its corner in (1, 2, 3).
Box HomogeneousBox(double extinction, double importance)
{
  return Box({ { 9, 13, 5 } }, { { 1, 2, 3 } }, { { 0.5, 0.25, 0.5 } }, Constant(extinction),
    Constant(importance));
}

Sampling Fine(double raysPerVoxel)
{
  Sampling sampling;
  sampling.raysPerVoxel = raysPerVoxel;
  return sampling;
}
}

TEST(RayMarch, FollowsBeersLawFromOutsideAndInside)
{
  const double extinction = 0.8;
  const Box box = HomogeneousBox(extinction, 1);
  const Vector target = box.lattice.Position(7, 11, 3);

  const double outside =
    truth::Transmittance(box.Fields(), Source::Point({ { 3, 3, -7 } }), target);
  const double inside = truth::Transmittance(box.Fields(), Source::Point({ { 2, 3, 4 } }), target);

  // The ray from outside enters through the front, z = 3.
  const double share = (target[2] - 3) / (target[2] + 7);
  const double path = share * Distance({ { 3, 3, -7 } }, target);
  EXPECT_WITHIN(outside, std::exp(-extinction * path), Roundoff<double>(200, 1.0));
  EXPECT_WITHIN(
    inside, std::exp(-extinction * Distance({ { 2, 3, 4 } }, target)), Roundoff<double>(200, 1.0));
}

TEST(RayMarch, IntegratesALinearExtinctionExactly)
{
  const Box box(
    { { 4, 5, 6 } }, { { 0, 0, 0 } }, { { 1, 1, 1 } },
    [](const Vector& x) { return 0.1 + 0.2 * x[0] + 0.3 * x[1] + 0.1 * x[2]; }, Constant(1));
  const Vector eye{ { 0.3, 0.2, 0.1 } };
  const Vector target{ { 2.7, 3.6, 4.9 } };

  const double depth = truth::OpticalDepth(box.Fields(), Source::Point(eye), target);

  // A linear function's mean is its value in the middle.
  const double mean = 0.1 + 0.2 * 1.5 + 0.3 * 1.9 + 0.1 * 2.5;
  EXPECT_WITHIN(depth, mean * Distance(eye, target), Roundoff<double>(200, 5.0));
}

TEST(RayMarch, ScoresAHomogeneousBoxUnderParallelRays)
{
  const double extinction = 0.9;
  const double importance = 0.7;
  const Box box = HomogeneousBox(extinction, importance);

  const double straight =
    truth::VisibilityScore(box.Fields(), Source::Parallel({ { 0, 0, -3 } }), Fine(1));
  const double oblique =
    truth::VisibilityScore(box.Fields(), Source::Parallel({ { 0.6, 0, 0.8 } }), Fine(64));

  const double straightTruth = importance * 4 * 3 * (1 - std::exp(-extinction * 2));
  EXPECT_WITHIN(straight, straightTruth, Roundoff<double>(1e4, straightTruth));
  // Across: a plateau of equally long paths between two linear ramps.
  const double longest = 2 / 0.8;
  const double plateau = 4 * 0.8 - 2 * 0.6;
  const double ramp = 2 * 0.6;
  const double opaque = 1 - std::exp(-extinction * longest);
  const double obliqueTruth =
    importance * 3 * (plateau * opaque + 2 * ramp * (1 - opaque / (extinction * longest)));
  EXPECT_WITHIN(oblique, obliqueTruth,
    Relative(1e-5, obliqueTruth, "midpoint rule over ramps of 64 x 3 stripes: h^2 / 24 of f''"));
}

TEST(RayMarch, CountsTheWholeVolumeOfAThinMediumFromAnywhere)
{
  const double extinction = 1e-9;
  const Box box = HomogeneousBox(extinction, 1);
  const double truth = extinction * 4 * 3 * 2;

  EXPECT_WITHIN(truth::ImportantExtinction(box.Fields()), truth, Roundoff<double>(1e3, truth));
  const std::vector<Vector> eyes{ { { 3, 3.5, -9 } }, { { 1.2, 2.2, 3.1 } }, { { 3, 3.5, 4 } },
    { { 1, 3, 4 } }, { { -1, -2, -3 } }, { { 5.5, 3, 3.01 } }, { { 1e6, 2e6, -3e6 } } };
  for (const Vector& eye : eyes)
  {
    SCOPED_TRACE(::testing::PrintToString(eye));
    const double score = truth::VisibilityScore(box.Fields(), Source::Point(eye), Fine(32));
    EXPECT_WITHIN(score, truth,
      Relative(1.0 / (4 * 16 * 16), truth,
        "a kink costs a quarter of a stripe's change, and no piece has less than 16 stripes"));
  }
}

TEST(RayMarch, SeesADenseMediumFromInsideAsDeepAsItsMeanFreePath)
{
  const double extinction = 60; // the nearest face is 60 mean free paths away
  const Box box({ { 9, 9, 9 } }, { { -1, -1, -1 } }, { { 0.25, 0.25, 0.25 } }, Constant(extinction),
    Constant(1));

  const double score =
    truth::VisibilityScore(box.Fields(), Source::Point({ { 0, 0, 0 } }), Fine(16));

  // Integral of mu exp(-mu t) t^2 over all directions.
  const double truth = 8 * std::acos(-1.0) / (extinction * extinction);
  EXPECT_WITHIN(score, truth,
    Relative(1e-3, truth, "midpoint rule on cube faces of 128 x 128 rays: h^2 / 24 of f''"));
}

TEST(RayMarch, ConvergesWithTheSquareOfTheRaySpacing)
{
  const Box box({ { 17, 17, 17 } }, { { -1, -1, -1 } }, { { 0.125, 0.125, 0.125 } },
    Ball({ { 0, 0, 0 } }, 0.5, 2.0), Ball({ { 0.2, 0.1, 0.3 } }, 0.3, 1.0));
  const Source eye = Source::Point({ { 0.4, 0.7, -4 } });

  const double coarse = truth::VisibilityScore(box.Fields(), eye, Fine(4));
  const double middle = truth::VisibilityScore(box.Fields(), eye, Fine(8));
  const double fine = truth::VisibilityScore(box.Fields(), eye, Fine(16));

  EXPECT_LT(std::abs(fine - middle), std::abs(middle - coarse) / 2);
  EXPECT_WITHIN(middle, fine, Relative(1e-5, fine, "eight rays per voxel, second order"));
}

TEST(RayMarch, NeedsFewPointsAlongARay)
{
  const Box box({ { 9, 9, 9 } }, { { -1, -1, -1 } }, { { 0.25, 0.25, 0.25 } },
    Ball({ { 0, 0, 0 } }, 0.5, 8.0), Ball({ { 0.2, 0.1, 0.3 } }, 0.3, 1.0));
  const Source eye = Source::Point({ { 0.4, 0.7, -4 } });
  Sampling fewer;
  Sampling more;
  more.samplesPerVoxel = 8;

  const double few = truth::VisibilityScore(box.Fields(), eye, fewer);
  const double many = truth::VisibilityScore(box.Fields(), eye, more);

  EXPECT_WITHIN(few, many,
    Relative(1e-8, many, "four points of Gauss' rule over at most half an optical depth"));
}

// With mu + e d, dS/de = integral of d (g T - G), G with the widening of the rays.
TEST(RayMarch, IsConsistentInScoreTransmittanceAndVisibleImportance)
{
  const Vector origin{ { -1, -1, -1 } };
  const Vector spacing{ { 0.0625, 0.0625, 0.0625 } };
  const auto extinctionAt = Ball({ { 0, 0, -0.2 } }, 0.45, 3.0);
  const auto importanceAt = Ball({ { 0.1, 0.1, 0.3 } }, 0.3, 1.0);
  const auto directionAt = Ball({ { 0.2, 0.2, -0.5 } }, 0.35, 1.0);
  const Source eye = Source::Point({ { 0.3, 0.5, -2.5 } });
  const double step = 1e-3;
  const auto score = [&](double e)
  {
    const Box moved(
      { { 33, 33, 33 } }, origin, spacing,
      [&](const Vector& x) { return extinctionAt(x) + e * directionAt(x); }, importanceAt);
    return truth::VisibilityScore(moved.Fields(), eye, Fine(2));
  };
  const Box box({ { 33, 33, 33 } }, origin, spacing, extinctionAt, importanceAt);

  const double difference = (score(step) - score(-step)) / (2 * step);
  double sum = 0;
  for (int k = 0; k < 33; ++k)
  {
    for (int j = 0; j < 33; ++j)
    {
      for (int i = 0; i < 33; ++i)
      {
        const Vector x = box.lattice.Position(i, j, k);
        const double transmittance = truth::Transmittance(box.Fields(), eye, x);
        const double behind = truth::VisibleBehind(box.Fields(), eye, x, Widening::Counted);
        const double importance = box.importance[(k * 33 + j) * 33 + i];
        sum += directionAt(x) * (importance * transmittance - behind);
      }
    }
  }
  sum *= box.lattice.CellVolume();

  // The march interpolates the direction between nodes, that is, it averages g T - G over hat
  // functions, which adds h^2 / 12 of its Laplacian: at most 6 / w^2 in a ball of width w.
  const double share = spacing[0] * spacing[0] / 12 * 6 / (0.3 * 0.3);
  EXPECT_WITHIN(sum, difference, Relative(share, difference, "sum over nodes, h^2 / 12"));
}

TEST(RayMarch, SeesTheSameInOtherUnitsAndRotated)
{
  const auto extinctionAt = Ball({ { 0, 0, -0.2 } }, 0.45, 3.0);
  const auto importanceAt = Ball({ { 0.1, 0.1, 0.3 } }, 0.3, 1.0);
  const Box box(
    { { 17, 13, 11 } }, { { -1, -1, -1 } }, { { 0.125, 0.16, 0.2 } }, extinctionAt, importanceAt);
  Box moved = box;
  const double unit = 1000;
  moved.lattice.direction = { { 0, -1, 0, 0.6, 0, -0.8, 0.8, 0, 0.6 } };
  moved.lattice.origin = { { 5, 6, 7 } };
  for (std::size_t node = 0; node < moved.extinction.size(); ++node)
  {
    moved.extinction[node] /= unit;
  }
  for (double& spacing : moved.lattice.spacing)
  {
    spacing *= unit;
  }
  const Vector eye{ { 0.3, 0.5, -2.5 } };
  const Vector index = box.lattice.Index(eye);

  const double score = truth::VisibilityScore(box.Fields(), Source::Point(eye), Fine(1));
  const double other = truth::VisibilityScore(
    moved.Fields(), Source::Point(moved.lattice.Position(index[0], index[1], index[2])), Fine(1));

  EXPECT_WITHIN(other, score * unit * unit, Roundoff<double>(1e6, score * unit * unit));
}

TEST(RayMarch, DoesNotDependOnTheNumberOfThreads)
{
  const Box box({ { 9, 9, 9 } }, { { -1, -1, -1 } }, { { 0.25, 0.25, 0.25 } },
    Ball({ { 0, 0, 0 } }, 0.5, 8.0), Ball({ { 0.2, 0.1, 0.3 } }, 0.3, 1.0));
  Sampling one;
  one.threads = 1;
  Sampling three;
  three.threads = 3;

  const Source eye = Source::Point({ { 0.4, 0.7, -4 } });

  EXPECT_EQ(truth::VisibilityScore(box.Fields(), eye, one),
    truth::VisibilityScore(box.Fields(), eye, three));
}
