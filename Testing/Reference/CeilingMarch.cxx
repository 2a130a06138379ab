// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "CeilingMarch.h"

#include "Bundles.h"
#include "CellMarch.h"
#include "Rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace truth
{
namespace
{
/// A cell that a ray crosses, and the fields on the way through it.
struct Crossing
{
  double begin;
  double end;
  Cubic importance;
  Cubic least;
  Cubic most;
};

std::vector<Crossing> CrossingsOf(
  const BoundedVolume& volume, const Ray& ray, const Interval& inside)
{
  const GaussRule unused(1);
  const Volume<float> fields{ volume.lattice, volume.most, volume.importance };
  const March<float> march{ fields, unused, false };
  std::vector<Crossing> crossings;
  ForEachCell(ray, volume.lattice.nodes, inside,
    [&](const std::array<int, 3>& cell, double begin, double end)
    {
      Vector p{};
      Vector d{};
      for (int c = 0; c < 3; ++c)
      {
        p[c] = ray.origin[c] + begin * ray.direction[c] - cell[c];
        d[c] = (end - begin) * ray.direction[c];
      }
      const auto along = [&](const float* field)
      { return march.CornersOf(field, cell).AlongLine(p, d); };
      crossings.push_back(
        { begin, end, along(volume.importance), along(volume.least), along(volume.most) });
      return true;
    });
  return crossings;
}

/// Through one cell, from its back to its front; `behind`: what can be seen behind it, times t^2.
double Through(
  const Crossing& cell, double lengthPerT, bool widening, int fewestSteps, double behind)
{
  constexpr double thickest = 0.1; // optical depth of a step
  const double size = cell.end - cell.begin;
  const double opaque = std::max({ cell.most(0), cell.most(0.5), cell.most(1) });
  const double wanted = std::ceil(opaque * size * lengthPerT / thickest);
  const int steps = std::max(fewestSteps, static_cast<int>(std::min(wanted, 1e5)));
  for (int step = steps; step-- > 0;)
  {
    const double s = (step + 0.5) / steps;
    const double t = cell.begin + s * size;
    const double shown = cell.importance(s) * (widening ? t * t : 1.0);
    const double extinction = shown > behind ? cell.most(s) : cell.least(s);
    behind = shown + (behind - shown) * std::exp(-extinction * lengthPerT * size / steps);
  }
  return behind;
}

double CeilingOfRay(
  const BoundedVolume& volume, const Ray& ray, const Interval& inside, bool widening, int steps)
{
  const double lengthPerT = volume.lattice.LengthOf(ray.direction);
  const std::vector<Crossing> crossings = CrossingsOf(volume, ray, inside);
  double behind = 0;
  for (std::size_t cell = crossings.size(); cell-- > 0;)
  {
    behind = Through(crossings[cell], lengthPerT, widening, steps, behind);
  }
  return behind / lengthPerT;
}
}

double CeilingOf(const BoundedVolume& volume, const Source& source, const Sampling& sampling)
{
  return IntegralOverRays(volume.lattice, source, sampling,
    [&](const Ray& ray, const Interval& inside)
    { return CeilingOfRay(volume, ray, inside, !source.parallel, sampling.samplesPerVoxel); });
}
}
