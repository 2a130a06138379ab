// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Eqs. (12) and (13): the perspective map of the paper's own scheme.

#include "Tolerance.h"

#include "PaperScheme/PerspectiveMap.h"
#include "math/Require.h"
#include "scene/Grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace
{
using namespace limpid;
using namespace limpid::reference;

/// Anisotropic, rotated, far from the origin.
Grid AwkwardGrid()
{
  Grid grid;
  grid.nodes = { 20, 11, 7 };
  grid.origin = { 100, -40, 7 };
  grid.spacing = { 0.5, 1.0, 2.5 };
  grid.direction = Mat3(0.8, 0.6, 0, -0.6, 0.8, 0, 0, 0, 1);
  return grid;
}

Vec3 EyeFrom(const Grid& grid, const Vec3& direction)
{
  return grid.Centre() + 3.0 * grid.Radius() * glm::normalize(direction);
}

// Positions are sums of the eye's and the ray's coordinates. Their rounding, seen from the eye, is
// what a view coordinate can be off by: divided by the depth and by the extent of the picture.
template <class Real>
Tolerance RoundingInView(const PerspectiveMap<Real>& map)
{
  const double reach = glm::length(map.origin) +
    map.farDepth * (glm::length(map.u) + glm::length(map.v)) + map.farDepth * glm::length(map.w);
  const double steepest = std::max(
    { glm::length(map.inverse[0]) / map.nearDepth, glm::length(map.inverse[1]) / map.nearDepth,
      2 * map.farDepth / map.nearDepth * glm::length(map.inverse[2]) /
        (map.farDepth - map.nearDepth) });
  return Roundoff<Real>(20, reach * steepest);
}

template <class Real>
void ExpectRoundTrip(const Vec3& direction)
{
  const Grid grid = AwkwardGrid();
  const PerspectiveMap<Real> map = LookAtBox<Real>(grid, EyeFrom(grid, direction), 1);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(0, 1);

  for (int sample = 0; sample < 200; ++sample)
  {
    const Vec3Of<Real> view(
      Real(2 * anywhere(random) - 1), Real(2 * anywhere(random) - 1), Real(anywhere(random)));
    const Vec3Of<Real> back = map.ToView(map.ToWorld(view));
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_WITHIN(back[axis], view[axis], RoundingInView(map));
    }
  }
}
}

TEST(PaperSchemeMap, ReturnsFromTheWorldToTheView)
{
  for (const Vec3& direction : { Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0.3, -2, 0.7) })
  {
    ExpectRoundTrip<double>(direction);
    ExpectRoundTrip<float>(direction);
  }
}

TEST(PaperSchemeMap, CoversTheWholeBoxAndNoMore)
{
  const Grid grid = AwkwardGrid();
  const auto map = LookAtBox<double>(grid, EyeFrom(grid, { 0.3, -2, 0.7 }), 1);
  Vec3 lowest(2);
  Vec3 highest(-2);

  for (int corner = 0; corner < 8; ++corner)
  {
    const Vec3 index((corner & 1) ? grid.nodes.x - 1 : 0, (corner & 2) ? grid.nodes.y - 1 : 0,
      (corner & 4) ? grid.nodes.z - 1 : 0);
    lowest = glm::min(lowest, map.ToView(index));
    highest = glm::max(highest, map.ToView(index));
  }

  const Tolerance rounding = RoundingInView(map);
  EXPECT_WITHIN(std::max(-lowest.x, highest.x), 1, rounding);
  EXPECT_WITHIN(std::max(-lowest.y, highest.y), 1, rounding);
  EXPECT_WITHIN(lowest.z, 0, rounding);
  EXPECT_WITHIN(highest.z, 1, rounding);
}

TEST(PaperSchemeMap, MeasuresCellsAlongTheirRays)
{
  const Grid grid = AwkwardGrid();
  const auto map = LookAtBox<double>(grid, EyeFrom(grid, { 0.3, -2, 0.7 }), 1);

  for (const int i : { 0, map.cells.x / 2, map.cells.x - 1 })
  {
    const Vec3 first = grid.PointToWorld(map.SampleInWorld(i, 1, 2));
    const Vec3 second = grid.PointToWorld(map.SampleInWorld(i, 1, 3));
    const double apart = glm::length(second - first) / grid.Radius();
    const double reach = glm::length(first) / grid.Radius();
    EXPECT_WITHIN(map.CellLength(i, 1), apart, Roundoff<double>(40, reach));
  }
}

TEST(PaperSchemeMap, FindsEverySampleAtItsOwnCell)
{
  const Grid grid = AwkwardGrid();
  const auto map = LookAtBox<double>(grid, EyeFrom(grid, { 1, 1, 1 }), 1);
  const Int3 cell = map.cells / 3;

  const Vec3 found = map.ToCells(map.ToView(map.SampleInWorld(cell.x, cell.y, cell.z)));

  for (int axis = 0; axis < 3; ++axis)
  {
    Tolerance rounding = RoundingInView(map);
    rounding.value *= map.cells[axis];
    EXPECT_WITHIN(found[axis], cell[axis], rounding);
  }
}

TEST(PaperSchemeMap, RefusesAnEyeThatHasDataBehindIt)
{
  const Grid grid = AwkwardGrid();

  EXPECT_THROW(LookAtBox<float>(grid, grid.Centre(), 2), Error);
  EXPECT_THROW(LookAtBox<float>(grid, grid.PointToWorld({ 3, 4, 5 }), 2), Error);
}

TEST(PaperSchemeMap, RefusesLessThanAnySample)
{
  const Grid grid = AwkwardGrid();

  EXPECT_THROW(LookAtBox<float>(grid, EyeFrom(grid, { 1, 0, 0 }), 0), Error);
}
