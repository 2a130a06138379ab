// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Bundles.h"

#include "Rays.h"

#include <algorithm>
#include <cmath>

namespace truth
{
namespace
{
/// Cuts the range of the breaks into stripes of at most 1 / perUnit, and at every break.
///
/// The breaks are where the outline of the box can lie: there the integral along a ray may jump
/// (where a face is seen edge-on), and the midpoint rule is of second order only where it does not.
/// Between two breaks it may bend sharply, so even the narrowest piece gets 16 stripes.
std::vector<Stripe> Stripes(std::vector<double> breaks, double perUnit, int minimum)
{
  std::sort(breaks.begin(), breaks.end());
  perUnit = std::max(perUnit, minimum / (breaks.back() - breaks.front()));
  std::vector<Stripe> stripes;
  for (std::size_t piece = 1; piece < breaks.size(); ++piece)
  {
    const double extent = breaks[piece] - breaks[piece - 1];
    const int count = extent > 0 ? std::max(16, static_cast<int>(std::ceil(extent * perUnit))) : 0;
    for (int n = 0; n < count; ++n)
    {
      stripes.push_back({ breaks[piece - 1] + (n + 0.5) * extent / count, extent / count });
    }
  }
  return stripes;
}

/// The axis of the largest component.
int PrincipalAxis(const Vector& direction)
{
  int most = 0;
  for (int c = 1; c < 3; ++c)
  {
    most = std::abs(direction[c]) > std::abs(direction[most]) ? c : most;
  }
  return most;
}

Bundle ParallelBundle(const Lattice& lattice, const Vector& direction, const Sampling& sampling)
{
  const Vector d = lattice.IndexDirection(direction);
  const int axis = PrincipalAxis(d);
  Bundle bundle{ Along({ { 0, 0, 0 } }, 1 / std::abs(d[axis]), d), (axis + 1) % 3, (axis + 2) % 3,
    {}, {} };
  const double shear = (lattice.nodes[axis] - 1) / bundle.n[axis];
  const auto breaks = [&](int c)
  {
    const double size = lattice.nodes[c] - 1;
    const double shift = -shear * bundle.n[c];
    return std::vector<double>{ 0, size, shift, size + shift };
  };
  bundle.columns = Stripes(breaks(bundle.a), sampling.raysPerVoxel, sampling.minimumRays);
  bundle.rows = Stripes(breaks(bundle.b), sampling.raysPerVoxel, sampling.minimumRays);
  return bundle;
}

/// The rays from the eye with |u| and |v| up to maximumSlope towards one side.
Bundle FrustumBundle(const Lattice& lattice, const Vector& eye, int axis, double side,
  double maximumSlope, const Sampling& sampling)
{
  Bundle bundle{ { { 0, 0, 0 } }, (axis + 1) % 3, (axis + 2) % 3, {}, {} };
  bundle.n[axis] = side;
  const double one = side * (0 - eye[axis]);
  const double other = side * (lattice.nodes[axis] - 1 - eye[axis]);
  const double nearDepth = std::max(0.0, std::min(one, other));
  const double farDepth = std::max(one, other);
  if (farDepth <= 0)
  {
    return bundle;
  }
  const auto breaks = [&](int c)
  {
    std::vector<double> slopes;
    for (double face : { 0 - eye[c], lattice.nodes[c] - 1 - eye[c] })
    {
      for (double depth : { nearDepth, farDepth })
      {
        const double slope = depth > 0 ? face / depth : face > 0 ? infinity : -infinity;
        slopes.push_back(std::min(std::max(slope, -maximumSlope), maximumSlope));
      }
    }
    return slopes;
  };
  const double perUnit = sampling.raysPerVoxel * farDepth;
  bundle.columns = Stripes(breaks(bundle.a), perUnit, sampling.minimumRays);
  bundle.rows = Stripes(breaks(bundle.b), perUnit, sampling.minimumRays);
  return bundle;
}
}

std::vector<Bundle> Bundles(const Lattice& lattice, const Source& source, const Sampling& sampling)
{
  if (source.parallel)
  {
    return { ParallelBundle(lattice, source.direction, sampling) };
  }
  const Vector eye = lattice.Index(source.position);
  Vector centre{};
  for (int c = 0; c < 3; ++c)
  {
    centre[c] = 0.5 * (lattice.nodes[c] - 1) - eye[c];
  }
  const int axis = PrincipalAxis(centre);
  const double nearDepth = std::abs(centre[axis]) - 0.5 * (lattice.nodes[axis] - 1);
  double widest = 0;
  for (int c = 0; c < 3; ++c)
  {
    widest =
      c == axis ? widest : std::max(widest, std::abs(centre[c]) + 0.5 * (lattice.nodes[c] - 1));
  }
  if (widest < 2 * nearDepth)
  {
    return { FrustumBundle(lattice, eye, axis, centre[axis] > 0 ? 1 : -1, 2, sampling) };
  }
  std::vector<Bundle> bundles;
  bundles.reserve(6);
  for (int face = 0; face < 6; ++face)
  {
    bundles.push_back(FrustumBundle(lattice, eye, face / 2, face % 2 ? 1 : -1, 1, sampling));
  }
  return bundles;
}
}
