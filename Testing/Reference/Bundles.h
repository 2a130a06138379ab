// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Which rays to march for an integral over the whole box.

#ifndef limpid_testing_Bundles_h
#define limpid_testing_Bundles_h

#include "Parallel.h"
#include "RayMarch.h"
#include "Rays.h"

#include <vector>

namespace truth
{
/// The middle of an interval of u or v, and its width.
struct Stripe
{
  double middle;
  double width;
};

/// Rays through a grid of (u, v), in index space. From a point source they start in one point with
/// directions n + u a + v b, parallel ones start in u a + v b and run along n. The axes a and b of
/// the grid and the n-th component of n, 1 or -1, make the determinant of the parametrisation 1.
struct Bundle
{
  Vector n;
  int a, b;
  std::vector<Stripe> columns, rows;
};

/// One bundle where it sees the whole box under moderate angles, otherwise six frusta.
std::vector<Bundle> Bundles(const Lattice& lattice, const Source& source, const Sampling& sampling);

/// The integral of ofRay(ray, inside) over all rays that meet the box, in world units; `inside` is
/// the interval of the ray's parameter in the box.
template <class OfRay>
double IntegralOverRays(
  const Lattice& lattice, const Source& source, const Sampling& sampling, const OfRay& ofRay)
{
  const Vector eye = source.parallel ? Vector{ { 0, 0, 0 } } : lattice.Index(source.position);
  double sum = 0;
  for (const Bundle& bundle : Bundles(lattice, source, sampling))
  {
    std::vector<double> rowSums(bundle.rows.size(), 0.0);
    ForEachRow(bundle.rows.size(), sampling.threads,
      [&](std::size_t row)
      {
        for (const Stripe& column : bundle.columns)
        {
          Ray ray{ eye, bundle.n };
          Vector& moved = source.parallel ? ray.origin : ray.direction;
          moved[bundle.a] += column.middle;
          moved[bundle.b] += bundle.rows[row].middle;
          const Interval inside = Clip(ray, lattice.nodes, source.parallel ? -infinity : 0.0);
          if (!inside.Empty())
          {
            rowSums[row] += ofRay(ray, inside) * column.width * bundle.rows[row].width;
          }
        }
      });
    for (const double rowSum : rowSums)
    {
      sum += rowSum;
    }
  }
  return sum * lattice.CellVolume();
}
}

#endif
