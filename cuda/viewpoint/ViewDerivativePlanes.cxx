// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/ViewDerivativePlanes.h"

#include "backend/Backend.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
int NodeBefore(double position, int nodes)
{
  const double last = nodes - 2;
  return static_cast<int>(std::min(std::max(std::floor(position), 0.0), last));
}

namespace
{
/// Voxel columns of places with these coordinates.
OwnedMap MapOf(const Lateral& lateral, const std::vector<double>& coordinates, double depth)
{
  OwnedMap map;
  for (const double coordinate : coordinates)
  {
    const double position = lateral.Position(coordinate, depth);
    const int node = NodeBefore(position, lateral.nodes);
    map.index.push_back(node);
    map.weight.push_back(static_cast<float>(position - node));
  }
  return map;
}

/// Weights of the values at four places in the derivative at another one: that of the cubic through
/// them.
std::array<double, 4> DerivativeWeights(const std::array<double, 4>& places, double at)
{
  std::array<double, 4> weights{};
  for (std::size_t i = 0; i < 4; ++i)
  {
    double scale = 1;
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k)
    {
      if (k == i)
      {
        continue;
      }
      scale /= places[i] - places[k];
      double product = 1;
      for (std::size_t m = 0; m < 4; ++m)
      {
        product *= m == i || m == k ? 1.0 : at - places[m];
      }
      sum += product;
    }
    weights[i] = scale * sum;
  }
  return weights;
}
}

ViewDerivativeAxis::ViewDerivativeAxis(const Lateral& lateral)
  : Rays(lateral)
{
  for (int ray = 0; ray < lateral.count; ++ray)
  {
    this->Middles.push_back(lateral.Coordinate(ray));
    const std::array<double, 4> weights =
      DerivativeWeights({ { lateral.Edge(ray - 1), lateral.Edge(ray), lateral.Edge(ray + 1),
                          lateral.Edge(ray + 2) } },
        lateral.Coordinate(ray));
    for (std::size_t k = 0; k < 4; ++k)
    {
      this->Weights[k].push_back(static_cast<float>(weights[k]));
    }
  }
  for (int edge = -1; edge < lateral.count + 2; ++edge)
  {
    this->Edges.push_back(lateral.Edge(edge));
  }
}

RowStencil ViewDerivativePlanes::StencilOf(const ViewDerivativePlane& plane, int row) const
{
  const Lateral& lateral = this->V.Rays;
  RowStencil stencil{};
  for (int k = 0; k < 4; ++k)
  {
    const double position =
      lateral.Position(this->V.Edges[std::size_t(row) + std::size_t(k)], plane.depth);
    stencil.row[k] = NodeBefore(position, lateral.nodes);
    stencil.weight[k] = static_cast<float>(position - stencil.row[k]);
    stencil.factor[k] = this->V.Weights[std::size_t(k)][std::size_t(row)] * plane.perIndex;
  }
  return stencil;
}

RowPlace ViewDerivativePlanes::RowAt(const ViewDerivativePlane& plane, int row) const
{
  const Lateral& lateral = this->V.Rays;
  const double position = lateral.Position(lateral.Coordinate(row), plane.depth);
  const int node = NodeBefore(position, lateral.nodes);
  return { node, static_cast<float>(position - node) };
}

ViewDerivativePlanes::ViewDerivativePlanes(const PlannedFrustum& frustum, int parts)
  : PartCount(parts)
  , U(frustum.lateralU)
  , V(frustum.lateralV)
  , Planes(std::size_t(frustum.lastSlice) * 2 * std::size_t(parts))
{
  const Slice* slices = frustum.Row(frustum.slices);
  ParallelFor(static_cast<Index>(this->Planes.size()), 8,
    [&](Index index)
    {
      const auto s = std::size_t(index / (2 * parts));
      const int part = static_cast<int>(index / 2 % parts);
      const Slice& back = slices[s + 1];
      const double thickness = back.depth - slices[s].depth;
      const double depth = slices[s].depth + (part + gaussPoints[index % 2]) * thickness / parts;
      ViewDerivativePlane& plane = this->Planes[std::size_t(index)];
      std::copy_n(slices[s].nodes, 2, plane.nodes);
      plane.fraction = static_cast<float>(1.0 - (back.depth - depth));
      plane.depth = depth;
      plane.perIndex = this->U.Rays.parallel ? 1.0f : static_cast<float>(1 / depth);
      plane.columns = MapOf(this->U.Rays, this->U.Middles, depth);
      plane.between = MapOf(this->U.Rays, this->U.Edges, depth);
    });
}
}
