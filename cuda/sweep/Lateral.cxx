// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/Lateral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace limpid
{
namespace
{
/// Rays across a side per voxel of its depth, at least.
constexpr double facePart = 0.25;

/// Parts between two coordinates: as many as `perUnit` says, and `fewest` at least.
void AddParts(double begin, double end, double perUnit, double fewest, std::vector<double>& edges)
{
  constexpr double most = 1e6;
  const double wanted = std::max(std::ceil((end - begin) * perUnit - 1e-9), fewest);
  const int parts = static_cast<int>(std::min(std::max(wanted, 1.0), most));
  for (int part = 1; part < parts; ++part)
  {
    edges.push_back(begin + (end - begin) * part / parts);
  }
  edges.push_back(end);
}
}

double Lateral::Edge(int ray) const
{
  const std::size_t last = this->Edges.size() - 1;
  if (ray < 1)
  {
    return this->Edges[0] + (ray - 1) * (this->Edges[1] - this->Edges[0]);
  }
  const auto index = std::size_t(ray - 1);
  return index <= last
    ? this->Edges[index]
    : this->Edges[last] + double(index - last) * (this->Edges[last] - this->Edges[last - 1]);
}

void Lateral::PutBetween(std::vector<double> edges)
{
  this->Edges = std::move(edges);
  this->count = static_cast<int>(this->Edges.size()) + 1;
  this->Middles.clear();
  for (int ray = 0; ray < this->count; ++ray)
  {
    this->Middles.push_back(0.5 * (this->Edge(ray) + this->Edge(ray + 1)));
  }
}

void Lateral::Fit(double nearDepth, double farDepth, double rayDensity, Placement placement)
{
  const double last = this->nodes - 1;
  constexpr double straight = 1e-3; // sideways step all through the box [index]
  if (this->parallel && placement == Placement::ForNodes &&
    std::abs(this->shear) * (farDepth - nearDepth) < straight)
  {
    std::vector<double> edges;
    for (int node = 0; node <= this->nodes; ++node)
    {
      edges.push_back(node - 0.5);
    }
    this->PutBetween(std::move(edges));
    return;
  }
  // The outlines of the faces: where rays run through the sides at the near and the far depth.
  std::array<double, 4> outlines{};
  for (int i = 0; i < 4; ++i)
  {
    const double depth = i % 2 ? farDepth : nearDepth;
    const double side = i < 2 ? 0 : last;
    const double distance = side - this->eye;
    const double sign = distance > 0 ? 1.0 : (distance < 0 ? -1.0 : 0.0);
    const double slope = depth > 0 ? distance / depth : sign;
    outlines[std::size_t(i)] =
      this->parallel ? side - this->shear * depth : std::min(std::max(slope, -1.0), 1.0);
  }
  std::sort(outlines.begin(), outlines.end());
  const double size = outlines.back() - outlines.front();
  if (!(size > 0))
  {
    this->count = 0;
    return;
  }
  constexpr double fewest = 16; // even across a single voxel, for the sake of the integrals
  const double perUnit =
    std::max(rayDensity * (this->parallel ? 1.0 : farDepth), (fewest - 1e-6) / size);
  std::vector<double> edges{ outlines.front() };
  if (placement == Placement::ForNodes)
  {
    AddParts(outlines.front(), outlines.back(), perUnit, 1, edges);
  }
  else
  {
    // A side that is seen at a grazing angle is a thin strip: rays enough for all its depth.
    const double alongSide = facePart * rayDensity * (farDepth - nearDepth);
    for (std::size_t i = 0; i + 1 < outlines.size(); ++i)
    {
      if (outlines[i + 1] - outlines[i] > 1e-9 * size)
      {
        AddParts(outlines[i], outlines[i + 1], perUnit, alongSide, edges);
      }
    }
    edges.back() = outlines.back();
  }
  this->PutBetween(std::move(edges));
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
  int ray = 0;
  for (int node = 0; node < this->nodes; ++node)
  {
    const double wanted = this->Ray(node, depth);
    while (ray + 2 < this->count && this->Coordinate(ray + 1) <= wanted)
    {
      ++ray;
    }
    const double gap = this->Coordinate(ray + 1) - this->Coordinate(ray);
    const double share = (wanted - this->Coordinate(ray)) / gap;
    map.index[std::size_t(node)] = ray;
    map.weight[std::size_t(node)] = static_cast<float>(std::min(std::max(share, 0.0), 1.0));
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
