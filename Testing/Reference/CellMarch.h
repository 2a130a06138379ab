// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// One ray, cell by cell: both fields are cubic polynomials along it in every cell.

#ifndef limpid_testing_CellMarch_h
#define limpid_testing_CellMarch_h

#include "Rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace truth
{
/// Gauss-Legendre points and weights on [0, 1].
struct GaussRule
{
  std::vector<double> points;
  std::vector<double> weights;

  explicit GaussRule(int count)
    : points(count)
    , weights(count)
  {
    const double pi = std::acos(-1.0);
    for (int m = 0; m < count; ++m)
    {
      double x = std::cos(pi * (m + 0.75) / (count + 0.5));
      double slope = 1;
      for (int newton = 0; newton < 50; ++newton)
      {
        double previous = 1;
        double value = x;
        for (int degree = 2; degree <= count; ++degree)
        {
          const double next = ((2 * degree - 1) * x * value - (degree - 1) * previous) / degree;
          previous = value;
          value = next;
        }
        slope = count * (x * value - previous) / (x * x - 1);
        x -= value / slope;
      }
      points[m] = 0.5 * (1 - x);
      weights[m] = 1 / ((1 - x * x) * slope * slope);
    }
  }
};

/// A polynomial of third degree in s on [0, 1].
struct Cubic
{
  double c0, c1, c2, c3;

  double operator()(double s) const { return c0 + s * (c1 + s * (c2 + s * c3)); }

  /// Integral from 0 to s.
  double Integral(double s) const { return s * (c0 + s * (c1 / 2 + s * (c2 / 3 + s * c3 / 4))); }
};

/// The values of a field at the corners of a cell, x fastest.
struct Corners
{
  double f[8];

  bool Empty() const
  {
    return std::all_of(f, f + 8, [](double value) { return value == 0; });
  }

  /// Along the line from p to p + d in the cell's unit coordinates.
  Cubic AlongLine(const Vector& p, const Vector& d) const
  {
    const double ax = f[1] - f[0];
    const double ay = f[2] - f[0];
    const double az = f[4] - f[0];
    const double axy = f[3] - f[2] - ax;
    const double axz = f[5] - f[4] - ax;
    const double ayz = f[6] - f[4] - ay;
    const double axyz = f[7] - f[6] - f[5] + f[4] - axy;
    const double x = p[0], y = p[1], z = p[2];
    const double dx = d[0], dy = d[1], dz = d[2];
    return { f[0] + ax * x + ay * y + az * z + axy * x * y + axz * x * z + ayz * y * z +
        axyz * x * y * z,
      ax * dx + ay * dy + az * dz + axy * (x * dy + y * dx) + axz * (x * dz + z * dx) +
        ayz * (y * dz + z * dy) + axyz * (dx * y * z + x * dy * z + x * y * dz),
      axy * dx * dy + axz * dx * dz + ayz * dy * dz +
        axyz * (dx * dy * z + dx * y * dz + x * dy * dz),
      axyz * dx * dy * dz };
  }
};

/// Calls visit(cell, begin, end) for every cell on the ray in order, until it returns false.
template <class Visit>
void ForEachCell(
  const Ray& ray, const std::array<int, 3>& nodes, const Interval& interval, Visit visit)
{
  std::array<int, 3> cell{};
  std::array<int, 3> step{};
  Vector next{};
  for (int c = 0; c < 3; ++c)
  {
    const double d = ray.direction[c];
    const double position = ray.origin[c] + interval.begin * d;
    const double lower = d < 0 ? std::ceil(position) - 1 : std::floor(position);
    cell[c] = static_cast<int>(std::min(std::max(lower, 0.0), nodes[c] - 2.0));
    step[c] = d > 0 ? 1 : -1;
    next[c] = d == 0 ? infinity : (cell[c] + (d > 0 ? 1 : 0) - ray.origin[c]) / d;
  }
  double begin = interval.begin;
  while (begin < interval.end)
  {
    const int c = next[0] <= next[1] ? (next[0] <= next[2] ? 0 : 2) : (next[1] <= next[2] ? 1 : 2);
    const double end = std::max(begin, std::min(next[c], interval.end));
    if (end > begin && !visit(cell, begin, end))
    {
      return;
    }
    begin = end;
    cell[c] += step[c];
    if (cell[c] < 0 || cell[c] > nodes[c] - 2)
    {
      return;
    }
    next[c] = (cell[c] + (step[c] > 0 ? 1 : 0) - ray.origin[c]) / ray.direction[c];
  }
}

/// What a ray has gathered so far.
struct Gathered
{
  double opticalDepth = 0;
  double visible = 0; ///< integral of importance x extinction x transmittance x weight
};

/// Nothing that matters in double precision is left of the light.
const double darkness = 100;

/// Integrates along one ray.
template <class Value>
struct March
{
  const Volume<Value>& volume;
  const GaussRule& rule;
  bool widening; ///< weight t^2 in the integral, otherwise 1

  Corners CornersOf(const Value* field, const std::array<int, 3>& cell) const
  {
    const std::int64_t row = volume.lattice.nodes[0];
    const std::int64_t slice = row * volume.lattice.nodes[1];
    const Value* f = field + cell[0] + cell[1] * row + cell[2] * slice;
    return { { double(f[0]), double(f[1]), double(f[row]), double(f[row + 1]), double(f[slice]),
      double(f[slice + 1]), double(f[slice + row]), double(f[slice + row + 1]) } };
  }

  /// One cell, or the part [s0, s1] of it whose optical depth is small enough for Gauss' rule.
  void Piece(const Cubic& extinction, const Cubic& counted, const Cubic& importance, double length,
    double begin, double size, double s0, double s1, double depthAtCell, double& visible) const
  {
    const double depth = depthAtCell + length * extinction.Integral(s0);
    if (depth > darkness)
    {
      return;
    }
    const double thickness = depthAtCell + length * extinction.Integral(s1) - depth;
    if (thickness > 0.5 && s1 - s0 > 1e-12)
    {
      const double middle = 0.5 * (s0 + s1);
      Piece(extinction, counted, importance, length, begin, size, s0, middle, depthAtCell, visible);
      Piece(extinction, counted, importance, length, begin, size, middle, s1, depthAtCell, visible);
      return;
    }
    for (std::size_t m = 0; m < rule.points.size(); ++m)
    {
      const double s = s0 + (s1 - s0) * rule.points[m];
      const double t = begin + size * s;
      const double weight = widening ? t * t : 1.0;
      const double transmittance = std::exp(-(depthAtCell + length * extinction.Integral(s)));
      visible +=
        rule.weights[m] * (s1 - s0) * size * importance(s) * counted(s) * transmittance * weight;
    }
  }

  /// From t = interval.begin on; lengthPerT is the world length of the ray's direction.
  void operator()(const Ray& ray, const Interval& interval, double lengthPerT, bool gather,
    Gathered& gathered) const
  {
    ForEachCell(ray, volume.lattice.nodes, interval,
      [&](const std::array<int, 3>& cell, double begin, double end)
      {
        const Corners mu = CornersOf(volume.extinction, cell);
        if (mu.Empty())
        {
          return true;
        }
        Vector p{};
        Vector d{};
        for (int c = 0; c < 3; ++c)
        {
          p[c] = ray.origin[c] + begin * ray.direction[c] - cell[c];
          d[c] = (end - begin) * ray.direction[c];
        }
        const Cubic extinction = mu.AlongLine(p, d);
        const double length = (end - begin) * lengthPerT;
        if (gather)
        {
          const Corners g = CornersOf(volume.importance, cell);
          if (!g.Empty())
          {
            const Cubic counted =
              volume.counted ? CornersOf(volume.counted, cell).AlongLine(p, d) : extinction;
            Piece(extinction, counted, g.AlongLine(p, d), length, begin, end - begin, 0, 1,
              gathered.opticalDepth, gathered.visible);
          }
        }
        gathered.opticalDepth += length * extinction.Integral(1);
        return !gather || gathered.opticalDepth < darkness;
      });
  }
};
}

#endif
