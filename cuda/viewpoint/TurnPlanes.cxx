// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/TurnPlanes.h"

#include "backend/Backend.h"
#include "math/Require.h"

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
/// The rays of a pyramid along one lateral axis, as its plan has placed them.
Lateral LateralOf(const Pyramid& pyramid, const Eye& eye, int axis, int nodes, double rayDensity)
{
  Lateral lateral;
  lateral.parallel = eye.parallel;
  lateral.eye = eye.origin[axis];
  lateral.shear = eye.parallel ? eye.direction[axis] / std::abs(eye.direction[pyramid.axisW]) : 0.0;
  lateral.nodes = nodes;
  lateral.Fit(std::max(0.0, pyramid.stations.front().depth), pyramid.stations.back().depth,
    rayDensity, Placement::ForIntegrals);
  return lateral;
}

/// Position of a ray, or of a place between rays, in a plane [index].
double PositionAt(const Lateral& lateral, double ray, double depth)
{
  const double coordinate = lateral.first + ray * lateral.step;
  return lateral.parallel ? coordinate + lateral.shear * depth : lateral.eye + coordinate * depth;
}

/// Voxel columns of `count` places, one per ray, the first at `start` rays.
LinearMap MapOf(const Lateral& lateral, double start, int count, double depth)
{
  LinearMap map;
  map.index.resize(std::size_t(count));
  map.weight.resize(std::size_t(count));
  for (int i = 0; i < count; ++i)
  {
    const double position = PositionAt(lateral, start + i, depth);
    const int node = NodeBefore(position, lateral.nodes);
    map.index[std::size_t(i)] = node;
    map.weight[std::size_t(i)] = static_cast<float>(position - node);
  }
  return map;
}
}

RowStencil StencilOf(const TurnPlane& plane, int row, int voxelRows)
{
  RowStencil stencil{};
  for (int k = 0; k < 4; ++k)
  {
    const double position = plane.firstRow + (row + k - 1.5) * plane.rowStep;
    stencil.row[k] = NodeBefore(position, voxelRows);
    stencil.weight[k] = static_cast<float>(position - stencil.row[k]);
    stencil.factor[k] = stencilWeights[k] / static_cast<float>(plane.rowStep);
  }
  return stencil;
}

TurnPlanes::TurnPlanes(const Pyramid& pyramid, const Eye& eye, double rayDensity, int parts)
  : PartCount(parts)
  , Planes(std::size_t(pyramid.LastStation()) * 2 * std::size_t(parts))
{
  const Lateral u = LateralOf(pyramid, eye, pyramid.axisU, pyramid.nodesU, rayDensity);
  const Lateral v = LateralOf(pyramid, eye, pyramid.axisV, pyramid.nodesV, rayDensity);
  LIMPID_EXPECT(u.count == pyramid.columns && v.count == pyramid.rows);
  const std::vector<Station>& stations = pyramid.stations;
  ParallelFor(static_cast<Index>(this->Planes.size()), 8,
    [&](Index index)
    {
      const auto s = std::size_t(index / (2 * parts));
      const int part = static_cast<int>(index / 2 % parts);
      const Station& back = stations[s + 1];
      const double thickness = back.depth - stations[s].depth;
      const double depth = stations[s].depth + (part + gaussPoints[index % 2]) * thickness / parts;
      TurnPlane& plane = this->Planes[std::size_t(index)];
      std::copy_n(stations[s].planes[0].slices, 2, plane.slices);
      plane.fraction = static_cast<float>(1.0 - (back.depth - depth));
      plane.columns = MapOf(u, 0, u.count, depth);
      plane.between = MapOf(u, -1.5, u.count + 3, depth);
      plane.columnStep = static_cast<float>(u.step * (u.parallel ? 1.0 : depth));
      plane.firstRow = PositionAt(v, 0, depth);
      plane.rowStep = v.step * (v.parallel ? 1.0 : depth);
    });
}
}
