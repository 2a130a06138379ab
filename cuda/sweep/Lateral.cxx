// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/Lateral.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limpid
{
void Lateral::Fit(double nearDepth, double farDepth, double rayDensity, Placement placement)
{
  const double last = this->nodes - 1;
  constexpr double straight = 1e-3; // sideways step all through the box [index]
  if (this->parallel && placement == Placement::ForNodes &&
    std::abs(this->shear) * (farDepth - nearDepth) < straight)
  {
    this->step = 1;
    this->first = -1;
    this->count = this->nodes + 2;
    return;
  }
  double low;
  double high;
  if (this->parallel)
  {
    low = std::min(-this->shear * nearDepth, -this->shear * farDepth);
    high = last + std::max(-this->shear * nearDepth, -this->shear * farDepth);
  }
  else
  {
    // Slopes to the box's faces: extreme at the near or at the far depth.
    const auto slope = [&](double distance, bool lowest)
    {
      const double atFar = distance / farDepth;
      if (nearDepth <= 0)
      {
        const double infinity = std::numeric_limits<double>::infinity();
        const double atNear = distance < 0 ? -infinity : (distance > 0 ? infinity : 0.0);
        return lowest ? std::min(atNear, atFar) : std::max(atNear, atFar);
      }
      const double atNear = distance / nearDepth;
      return lowest ? std::min(atNear, atFar) : std::max(atNear, atFar);
    };
    low = slope(-this->eye, true);
    high = slope(last - this->eye, false);
    low = std::max(low, -1.0);
    high = std::min(high, 1.0);
  }
  if (!(high > low))
  {
    this->count = 0;
    return;
  }
  constexpr double fewest = 16; // even across a single voxel, for the sake of the integrals
  const double scale = this->parallel ? 1.0 : farDepth;
  const double wanted = std::ceil((high - low) * scale * rayDensity - 1e-9);
  const int cells = static_cast<int>(std::min(std::max(wanted, fewest), 1e6));
  this->step = (high - low) / cells;
  this->first = low - 0.5 * this->step;
  this->count = cells + 2;
}

LinearMap Lateral::RayMap(double depth) const
{
  LinearMap map;
  map.index.resize(std::size_t(this->count));
  map.weight.resize(std::size_t(this->count));
  const double last = this->nodes - 1;
  for (int ray = 0; ray < this->count; ++ray)
  {
    const double position = this->Position(this->Coordinate(ray), depth);
    const double inside = std::min(std::max(position, 0.0), last);
    const int node = std::min(static_cast<int>(inside), this->nodes - 2);
    map.index[std::size_t(ray)] = node;
    map.weight[std::size_t(ray)] = static_cast<float>(inside - node);
  }
  return map;
}

std::vector<int> Lateral::RayNodes(double depth) const
{
  std::vector<int> floors(std::size_t(this->count));
  const double last = this->nodes - 1;
  for (int ray = 0; ray < this->count; ++ray)
  {
    const double position = this->Position(this->Coordinate(ray), depth);
    floors[std::size_t(ray)] =
      static_cast<int>(std::floor(std::min(std::max(position, -3.0), last + 3.0)));
  }
  return floors;
}

LinearMap Lateral::VoxelMap(double depth) const
{
  LinearMap map;
  map.index.resize(std::size_t(this->nodes));
  map.weight.resize(std::size_t(this->nodes));
  for (int node = 0; node < this->nodes; ++node)
  {
    const double position = (this->Ray(node, depth) - this->first) / this->step;
    const double inside = std::min(std::max(position, 0.0), double(this->count - 1));
    const int ray = std::max(0, std::min(static_cast<int>(inside), this->count - 2));
    map.index[std::size_t(node)] = ray;
    map.weight[std::size_t(node)] = static_cast<float>(inside - ray);
  }
  return map;
}

Clip Lateral::ClipRay(double coordinate, double base) const
{
  constexpr double never = 1e30;
  const double last = this->nodes - 1;
  const double slope = this->parallel ? this->shear : coordinate;
  const double start = this->parallel ? coordinate : this->eye;
  double low = -never;
  double high = never;
  if (slope != 0)
  {
    const double atZero = (0 - start) / slope;
    const double atLast = (last - start) / slope;
    low = std::min(atZero, atLast) - base;
    high = std::max(atZero, atLast) - base;
  }
  else if (start < 0 || start > last)
  {
    low = never;
    high = -never;
  }
  return { static_cast<float>(std::min(std::max(low, -never), never)),
    static_cast<float>(std::min(std::max(high, -never), never)) };
}

std::vector<float> Lateral::VoxelEntries(double depth, double base) const
{
  std::vector<float> entries(std::size_t(this->nodes));
  for (int node = 0; node < this->nodes; ++node)
  {
    entries[std::size_t(node)] = this->ClipRay(this->Ray(node, depth), base).entry;
  }
  return entries;
}

Interval Lateral::Owned(double depth, bool closed) const
{
  if (this->parallel)
  {
    return { 0, this->nodes };
  }
  const auto owns = [&](int node)
  {
    const double distance = std::abs(node - this->eye);
    return closed ? distance <= depth : distance < depth;
  };
  const double last = this->nodes - 1;
  int begin = static_cast<int>(std::min(std::max(this->eye - depth - 1, 0.0), last + 1));
  int end = static_cast<int>(std::min(std::max(this->eye + depth + 2, 0.0), last + 1));
  while (begin < end && !owns(begin))
  {
    ++begin;
  }
  while (end > begin && !owns(end - 1))
  {
    --end;
  }
  return { begin, end };
}
}
