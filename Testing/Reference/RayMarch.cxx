// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "RayMarch.h"

#include "Bundles.h"
#include "CellMarch.h"
#include "Rays.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace truth
{
namespace
{
/// A ray to, and the parameter of, a position.
struct Target
{
  Ray ray;
  double t = 1;
  double lengthPerT = 1;
  Interval inside;
};

Target Aim(const Lattice& lattice, const Source& source, const Vector& position)
{
  Target target;
  const Vector index = lattice.Index(position);
  if (source.parallel)
  {
    target.ray.direction = Unit(lattice.IndexDirection(source.direction));
    target.ray.origin = index;
    target.t = 0;
  }
  else
  {
    target.ray.origin = lattice.Index(source.position);
    target.ray.direction = Minus(index, target.ray.origin);
  }
  target.lengthPerT = lattice.LengthOf(target.ray.direction);
  target.inside = Clip(target.ray, lattice.nodes, source.parallel ? -infinity : 0.0);
  return target;
}
}

Vector Lattice::Position(double i, double j, double k) const
{
  const Vector scaled{ { i * spacing[0], j * spacing[1], k * spacing[2] } };
  Vector position = origin;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      position[row] += direction[3 * row + column] * scaled[column];
    }
  }
  return position;
}

Vector Lattice::Index(const Vector& position) const
{
  return IndexDirection(Minus(position, origin));
}

Vector Lattice::IndexDirection(const Vector& world) const
{
  Vector index{ { 0, 0, 0 } };
  for (int column = 0; column < 3; ++column)
  {
    for (int row = 0; row < 3; ++row)
    {
      index[column] += direction[3 * row + column] * world[row];
    }
    index[column] /= spacing[column];
  }
  return index;
}

double Lattice::LengthOf(const Vector& indexDirection) const
{
  const Vector scaled{ { indexDirection[0] * spacing[0], indexDirection[1] * spacing[1],
    indexDirection[2] * spacing[2] } };
  return std::sqrt(Dot(scaled, scaled));
}

template <class Value>
double VisibilityScore(const Volume<Value>& volume, const Source& source, const Sampling& sampling)
{
  const Lattice& lattice = volume.lattice;
  const GaussRule rule(sampling.samplesPerVoxel);
  const March<Value> march{ volume, rule, !source.parallel };

  return IntegralOverRays(lattice, source, sampling,
    [&](const Ray& ray, const Interval& inside)
    {
      Gathered gathered;
      march(ray, inside, lattice.LengthOf(ray.direction), true, gathered);
      return gathered.visible;
    });
}

template <class Value>
double ImportantExtinction(const Volume<Value>& volume)
{
  // In a cell the product is of second degree along each axis: Gauss' rule with two points along
  // each axis is exact.
  const Lattice& lattice = volume.lattice;
  const GaussRule exact(2);
  const March<Value> march{ volume, exact, false };
  double total = 0;
  for (int k = 0; k + 1 < lattice.nodes[2]; ++k)
  {
    double slice = 0;
    for (int j = 0; j + 1 < lattice.nodes[1]; ++j)
    {
      for (int i = 0; i + 1 < lattice.nodes[0]; ++i)
      {
        const Corners extinction = march.CornersOf(volume.Counted(), { { i, j, k } });
        const Corners importance = march.CornersOf(volume.importance, { { i, j, k } });
        if (extinction.Empty() || importance.Empty())
        {
          continue;
        }
        for (int point = 0; point < 4; ++point)
        {
          const Vector p{ { 0, exact.points[point % 2], exact.points[point / 2] } };
          const Cubic mu = extinction.AlongLine(p, { { 1, 0, 0 } });
          const Cubic g = importance.AlongLine(p, { { 1, 0, 0 } });
          for (int m = 0; m < 2; ++m)
          {
            slice += mu(exact.points[m]) * g(exact.points[m]) / 8;
          }
        }
      }
    }
    total += slice;
  }
  return total * lattice.CellVolume();
}

template <class Value>
Shares SharesOf(
  const Volume<Value>& volume, const Value* base, const Source& source, const Sampling& sampling)
{
  const auto count = static_cast<std::size_t>(volume.lattice.Count());
  std::vector<Value> kept(count);
  std::transform(volume.extinction, volume.extinction + count, base, kept.begin(),
    [](Value now, Value before) { return std::min(now, before); });
  Volume<Value> counted = volume;
  counted.counted = base;
  const double important = ImportantExtinction(counted);
  counted.counted = kept.data();
  return { VisibilityScore(counted, source, sampling) / important,
    1 - ImportantExtinction(counted) / important };
}

template <class Value>
double OpticalDepth(const Volume<Value>& volume, const Source& source, const Vector& position)
{
  const GaussRule unused(1);
  Target target = Aim(volume.lattice, source, position);
  target.inside.end = std::min(target.inside.end, target.t);
  Gathered gathered;
  if (!target.inside.Empty())
  {
    March<Value>{ volume, unused, false }(
      target.ray, target.inside, target.lengthPerT, false, gathered);
  }
  return gathered.opticalDepth;
}

template <class Value>
double Transmittance(const Volume<Value>& volume, const Source& source, const Vector& position)
{
  return std::exp(-OpticalDepth(volume, source, position));
}

template <class Value>
double VisibleBehind(
  const Volume<Value>& volume, const Source& source, const Vector& position, Widening widening)
{
  const GaussRule rule(5);
  const Target target = Aim(volume.lattice, source, position);
  Gathered gathered;
  gathered.opticalDepth = OpticalDepth(volume, source, position);
  Interval behind = target.inside;
  behind.begin = std::max(behind.begin, target.t);
  if (!behind.Empty())
  {
    // t is 1 at the position of a point source's target, so t^2 is the ratio of the squares.
    const bool widens = widening == Widening::Counted && !source.parallel;
    March<Value>{ volume, rule, widens }(target.ray, behind, target.lengthPerT, true, gathered);
  }
  return gathered.visible * target.lengthPerT;
}

template double VisibilityScore(const Volume<float>&, const Source&, const Sampling&);
template double VisibilityScore(const Volume<double>&, const Source&, const Sampling&);
template double ImportantExtinction(const Volume<float>&);
template double ImportantExtinction(const Volume<double>&);
template Shares SharesOf(const Volume<float>&, const float*, const Source&, const Sampling&);
template double OpticalDepth(const Volume<float>&, const Source&, const Vector&);
template double OpticalDepth(const Volume<double>&, const Source&, const Vector&);
template double Transmittance(const Volume<float>&, const Source&, const Vector&);
template double Transmittance(const Volume<double>&, const Source&, const Vector&);
template double VisibleBehind(const Volume<float>&, const Source&, const Vector&, Widening);
template double VisibleBehind(const Volume<double>&, const Source&, const Vector&, Widening);
}
