// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/Lateral.h"

#include "backend/Simd.h"
#include "sweep/SideDensity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace limpid
{
namespace
{
/// Minimum number of rays across a side per voxel of its depth, but at most `mostPart` per voxel of
/// the box's width: in a long box, a side is a small part of the view.
constexpr double facePart = 0.25;
constexpr double mostPart = 0.5;

/// Smallest number of rays across a box, however long it is.
constexpr double leastAcross = 4;

/// Returns the minimum number of rays across a box. Accurate integrals need several rays even
/// across a single voxel. A long box needs fewer, and they would dominate the work.
double FewestAcross(double length)
{
  constexpr double most = 16;
  constexpr double shortest = 64; // [index]
  return std::max(leastAcross, most * std::min(1.0, std::sqrt(shortest / length)));
}

/// Divides an interval into parts of density `perUnit`, but at least `fewest`.
void AddParts(double begin, double end, double perUnit, double fewest, std::vector<double>& edges)
{
  const int parts = PartCount((end - begin) * perUnit, fewest);
  for (int part = 1; part < parts; ++part)
  {
    edges.push_back(begin + (end - begin) * part / parts);
  }
  edges.push_back(end);
}

/// Computes, for every coordinate, the nearest cell of the box and the position inside it.
LIMPID_MULTIVERSION
void FindCells(const double* __restrict coordinates, int count, const DepthLine& line, int nodes,
  int* __restrict index, float* __restrict weight)
{
  const DepthLine at = line;
  for (int i = 0; i < count; ++i)
  {
    const NodePair pair = NodesAt(at.At(coordinates[i]), nodes);
    index[i] = pair.first;
    weight[i] = pair.weight;
  }
}

LIMPID_MULTIVERSION
void FindFloors(const double* __restrict coordinates, int count, const DepthLine& line, int nodes,
  int* __restrict floors)
{
  const DepthLine at = line;
  for (int i = 0; i < count; ++i)
  {
    floors[i] = RayAxis::FloorNear(at.At(coordinates[i]), nodes);
  }
}

/// Computes the coordinates of the rays through voxels begin, begin + 1, ... at a depth.
LIMPID_MULTIVERSION
void FindCoordinates(
  int begin, int count, const DepthLine& line, bool parallel, double* __restrict coordinates)
{
  const DepthLine at = line;
  for (int i = 0; i < count; ++i)
  {
    coordinates[i] = RayAxis::CoordinateThrough(begin + i, at, parallel);
  }
}

/// Computes the weights of `wanted` between the coordinates index[i] and index[i] + 1.
LIMPID_MULTIVERSION
void FindWeights(const double* __restrict coordinates, const double* __restrict wanted,
  const int* __restrict index, int count, float* __restrict weight)
{
  for (int i = 0; i < count; ++i)
  {
    weight[i] = RayAxis::WeightBetween(coordinates[index[i]], coordinates[index[i] + 1], wanted[i]);
  }
}

/// Computes the depths, minus `base`, at which rays of given coordinates enter the box.
LIMPID_MULTIVERSION
void FindEntries(const RayAxis& axis, const double* __restrict coordinates, int count, double base,
  float* __restrict entries)
{
  const RayAxis rays = axis;
  for (int i = 0; i < count; ++i)
  {
    entries[i] = rays.StayAt(coordinates[i], base).begin;
  }
}

/// Calls visit(voxels, coordinates of the rays through them) for batches of voxels at a depth, in
/// ascending order.
template <class Visit>
void VisitVoxels(const Lateral& lateral, double depth, Visit&& visit)
{
  constexpr int most = 256;
  double coordinates[most];
  for (int begin = 0; begin < lateral.nodes; begin += most)
  {
    const Range<int> voxels{ begin, std::min(begin + most, lateral.nodes) };
    FindCoordinates(
      begin, voxels.end - begin, lateral.Axis().LineAt(depth), lateral.parallel, coordinates);
    visit(voxels, coordinates);
  }
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

void Lateral::PutAtGaussPoints(const Range<double>& interval, int rays)
{
  const double half = 0.5 * interval.Length();
  const double middle = interval.begin + half;
  const double outer = half * (rays == 2 ? std::sqrt(1.0 / 3) : std::sqrt(3.0 / 5));
  const double inner = half * 4 / 9; // half the weight of the middle one of three
  this->PutBetween(rays == 2
      ? std::vector<double>{ interval.begin, middle, interval.end }
      : std::vector<double>{ interval.begin, middle - inner, middle + inner, interval.end });
  this->Middles[1] = middle - outer;
  this->Middles[std::size_t(rays)] = middle + outer;
}

void Lateral::Fit(
  double nearDepth, double farDepth, double length, double rayDensity, RayPlacement placement)
{
  const double last = this->nodes - 1;
  constexpr double straight = 1e-3; // largest lateral shift of straight rays in the box [index]
  if (this->parallel && placement == RayPlacement::ForNodes &&
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
  // Outlines of the faces: where rays cross the sides at the near and the far depth.
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
  const double fewest = FewestAcross(length);
  // Across a single cell fields are polynomials, which two or three Gauss points integrate better
  // than four equal parts do.
  const int equalParts = PartCount(rayDensity * last, 2);
  if (placement == RayPlacement::ForIntegrals && this->parallel && this->nodes == 2 &&
    !(size > last + straight) && std::max(fewest, double(equalParts)) <= leastAcross)
  {
    this->PutAtGaussPoints({ outlines.front(), outlines.back() }, std::min(equalParts, 3));
    return;
  }
  const double leastPerUnit = (fewest - 1e-6) / size;
  const double perUnit = std::max(rayDensity * (this->parallel ? 1.0 : farDepth), leastPerUnit);
  std::vector<double> edges{ outlines.front() };
  // A side seen at a grazing angle is a thin strip, but it needs enough rays for its whole depth.
  const double alongSide = placement == RayPlacement::ForNodes ? 1.0
                                                               : rayDensity *
      std::min(facePart * (farDepth - nearDepth), std::max(mostPart * last, 0.25 * fewest));
  bool uniform = true;
  for (std::size_t i = 0; i + 1 < outlines.size(); ++i)
  {
    const Range<double> strip{ outlines[i], outlines[i + 1] };
    if (!(strip.end - strip.begin > 1e-9 * size))
    {
      continue;
    }
    const double side = strip.end > 0 ? last - this->eye : this->eye;
    const SideDensity density(strip, side, last, rayDensity, perUnit, leastPerUnit);
    if (this->parallel || density.IsUniform())
    {
      AddParts(strip.begin, strip.end, perUnit, alongSide, edges);
    }
    else
    {
      density.Divide(alongSide, edges);
      uniform = false;
    }
  }
  if (uniform && placement == RayPlacement::ForNodes)
  {
    edges.resize(1);
    AddParts(outlines.front(), outlines.back(), perUnit, 1, edges);
  }
  edges.back() = outlines.back();
  this->PutBetween(std::move(edges));
}

Range<int> Lateral::RaysNear(double depth, double reach, int more) const
{
  const Range<double> near{ -reach, this->nodes - 1 + reach };
  const Range<int> all{ 0, this->count };
  if (!this->parallel && !(depth > 0)) // all rays meet in the source
  {
    return this->eye >= near.begin && this->eye <= near.end ? all : Range<int>{};
  }
  const DepthLine line = this->Axis().LineAt(depth);
  const auto coordinateOf = [&](double position) { return (position - line.offset) / line.factor; };
  const auto begin = this->Middles.begin();
  const auto first = std::lower_bound(begin, this->Middles.end(), coordinateOf(near.begin));
  const auto end = std::upper_bound(first, this->Middles.end(), coordinateOf(near.end));
  return Intersection(
    Range<int>{ static_cast<int>(first - begin) - more, static_cast<int>(end - begin) + more },
    all);
}

void Lateral::FindRayMap(double depth, const Range<int>& rays, int* index, float* weight) const
{
  FindCells(this->Middles.data() + rays.begin, rays.Length(), this->Axis().LineAt(depth),
    this->nodes, index, weight);
}

void Lateral::FindRayNodes(double depth, const Range<int>& rays, int* floors) const
{
  FindFloors(this->Middles.data() + rays.begin, rays.Length(), this->Axis().LineAt(depth),
    this->nodes, floors);
}

void Lateral::FindVoxelMap(double depth, int firstRay, int* index, float* weight) const
{
  VisitVoxels(*this, depth,
    [&, ray = firstRay](const Range<int>& voxels, const double* wanted) mutable
    {
      int* first = index + voxels.begin;
      for (int i = 0; i < voxels.Length(); ++i)
      {
        while (ray + 2 < this->count && this->Middles[std::size_t(ray) + 1] <= wanted[i])
        {
          ++ray;
        }
        first[i] = ray;
      }
      FindWeights(this->Middles.data(), wanted, first, voxels.Length(), weight + voxels.begin);
    });
}

Range<float> Lateral::StayOf(int ray, double base) const
{
  return this->Axis().StayAt(this->Coordinate(ray), base);
}

void Lateral::FindVoxelEntries(double depth, double base, float* entries) const
{
  VisitVoxels(*this, depth,
    [&](const Range<int>& voxels, const double* coordinates)
    { FindEntries(this->Axis(), coordinates, voxels.Length(), base, entries + voxels.begin); });
}

Range<int> Lateral::Owned(double depth, bool closed) const
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

void FindFirstTargets(const int* index, int targets, const Range<int>& sources, int* first)
{
  int target = 0;
  for (int source = sources.begin; source <= sources.end; ++source)
  {
    while (target < targets && index[target] < source)
    {
      ++target;
    }
    first[source - sources.begin] = target;
  }
}
}
