// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "TurnedMarch.h"

#include "CellMarch.h"
#include "Parallel.h"
#include "Rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace truth
{
namespace
{
constexpr int eyeCount = 5; // where the viewer is, and before and behind along either way
using Scores = std::array<double, eyeCount>;

/// The directions from the centre to all eyes.
std::array<Vector, eyeCount> EyesOf(const Viewer& viewer, double angle)
{
  std::array<Vector, eyeCount> eyes{};
  eyes[0] = viewer.direction;
  for (int eye = 1; eye < eyeCount; ++eye)
  {
    const double by = eye % 2 ? angle : -angle;
    const Vector zero{ { 0, 0, 0 } };
    eyes[eye] =
      Along(Along(zero, std::cos(by), viewer.direction), std::sin(by), viewer.ways[(eye - 1) / 2]);
  }
  return eyes;
}

/// The way of a ray of an eye through a point.
Vector WayThrough(const Viewer& viewer, const Vector& eye, const Vector& point)
{
  return viewer.parallel ? Along({ { 0, 0, 0 } }, -1, eye)
                         : Minus(point, Along(viewer.centre, viewer.distance, eye));
}

/// Equal squares on the plane through the centre that faces the viewer, under all rays of all eyes.
struct Squares
{
  double first[2] = { infinity, infinity };
  double last[2] = { -infinity, -infinity };
  int count[2] = { 0, 0 };
  double size[2] = { 0, 0 };

  Squares(const Lattice& lattice, const Viewer& viewer, const std::array<Vector, eyeCount>& eyes,
    const Sampling& sampling)
  {
    for (int corner = 0; corner < 8; ++corner)
    {
      const Vector x = lattice.Position(corner & 1 ? lattice.nodes[0] - 1 : 0,
        corner & 2 ? lattice.nodes[1] - 1 : 0, corner & 4 ? lattice.nodes[2] - 1 : 0);
      for (const Vector& eye : eyes)
      {
        const Vector way = WayThrough(viewer, eye, x);
        const Vector fromCentre = Minus(x, viewer.centre);
        const double t = -Dot(fromCentre, viewer.direction) / Dot(way, viewer.direction);
        for (int axis = 0; axis < 2; ++axis)
        {
          const double where = Dot(Along(fromCentre, t, way), viewer.ways[axis]);
          first[axis] = std::min(first[axis], where);
          last[axis] = std::max(last[axis], where);
        }
      }
    }
    const double spacing = *std::min_element(lattice.spacing.begin(), lattice.spacing.end());
    for (int axis = 0; axis < 2; ++axis)
    {
      const double extent = last[axis] - first[axis];
      const double needed = std::ceil(extent / spacing * sampling.raysPerVoxel);
      count[axis] = std::max(static_cast<int>(needed), sampling.minimumRays);
      size[axis] = extent / count[axis];
    }
  }

  double Middle(int axis, int square) const { return first[axis] + (square + 0.5) * size[axis]; }
};
}

template <class Value>
TurnedScore ScoreTurned(
  const Volume<Value>& volume, const Viewer& viewer, double angle, const Sampling& sampling)
{
  const Lattice& lattice = volume.lattice;
  const GaussRule rule(sampling.samplesPerVoxel);
  const March<Value> march{ volume, rule, !viewer.parallel };
  const std::array<Vector, eyeCount> eyes = EyesOf(viewer, angle);
  const Squares squares(lattice, viewer, eyes, sampling);

  const auto scoreOf = [&](const Vector& eye, const Vector& point)
  {
    const Vector way = WayThrough(viewer, eye, point);
    const Vector from = viewer.parallel ? point : Minus(point, way);
    const Ray ray{ lattice.Index(from), lattice.IndexDirection(way) };
    const Interval inside = Clip(ray, lattice.nodes, viewer.parallel ? -infinity : 0.0);
    Gathered gathered;
    if (!inside.Empty())
    {
      march(ray, inside, lattice.LengthOf(ray.direction), true, gathered);
    }
    // t is 1 in the plane: what is gathered is per area of the plane and per t.
    return gathered.visible * std::abs(Dot(way, viewer.direction));
  };

  std::vector<Scores> rows(squares.count[1], Scores{});
  ForEachRow(rows.size(), sampling.threads,
    [&](std::size_t row)
    {
      const double middle = squares.Middle(1, static_cast<int>(row));
      const Vector line = Along(viewer.centre, middle, viewer.ways[1]);
      for (int column = 0; column < squares.count[0]; ++column)
      {
        const Vector point = Along(line, squares.Middle(0, column), viewer.ways[0]);
        for (int eye = 0; eye < eyeCount; ++eye)
        {
          rows[row][eye] += scoreOf(eyes[eye], point);
        }
      }
    });

  Scores total{};
  for (const Scores& row : rows)
  {
    for (int eye = 0; eye < eyeCount; ++eye)
    {
      total[eye] += row[eye] * squares.size[0] * squares.size[1];
    }
  }
  TurnedScore result;
  result.score = total[0];
  for (int way = 0; way < 2; ++way)
  {
    const double ahead = total[1 + 2 * way];
    const double behind = total[2 + 2 * way];
    result.slope[way] = (ahead - behind) / (2 * angle);
    result.bend[way] = (ahead - 2 * total[0] + behind) / angle;
  }
  return result;
}

template TurnedScore ScoreTurned(const Volume<float>&, const Viewer&, double, const Sampling&);
template TurnedScore ScoreTurned(const Volume<double>&, const Viewer&, double, const Sampling&);
}
