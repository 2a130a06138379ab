// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "scene/AxisPermutation.h"

#include "backend/Backend.h"

#include <algorithm>
#include <array>

namespace limpid
{
namespace
{
using Strides = std::array<Index, 3>;

Strides StridesOf(const Int3& nodes)
{
  return { 1, nodes.x, Index(nodes.x) * nodes.y };
}

Vec3 InOrder(const Vec3& vector, const Int3& axes)
{
  return { vector[axes[0]], vector[axes[1]], vector[axes[2]] };
}

/// Copies a field if rows of both fields run along the same axis.
void CopyRows(const Int3& nodes, const Strides& source, const float* from, float* to)
{
  ParallelFor(Index(nodes.y) * nodes.z, 16,
    [&](Index row)
    {
      const float* first = from + row % nodes.y * source[1] + row / nodes.y * source[2];
      std::copy(first, first + nodes.x, to + row * nodes.x);
    });
}

/// Copies a field if rows of the source run along axis `along` of the target, which is not its
/// first axis: in tiles that are a cache line wide in both fields.
void CopyAcross(const Int3& nodes, const Strides& source, int along, const float* from, float* to)
{
  constexpr int tile = 16;
  const int other = 3 - along;
  const Strides target = StridesOf(nodes);
  ParallelFor(nodes[other],
    [&](Index slice)
    {
      const float* first = from + slice * source[std::size_t(other)];
      float* begin = to + slice * target[std::size_t(other)];
      for (int k = 0; k < nodes[along]; k += tile)
      {
        const int lastRow = std::min(k + tile, nodes[along]);
        for (int u = 0; u < nodes.x; u += tile)
        {
          const int last = std::min(u + tile, nodes.x);
          for (int row = k; row < lastRow; ++row)
          {
            for (int column = u; column < last; ++column)
            {
              begin[row * target[std::size_t(along)] + column] = first[column * source[0] + row];
            }
          }
        }
      }
    });
}

/// Fills a field on `nodes` from one whose values along each axis are `source` apart.
void Copy(const Int3& nodes, const Strides& source, const float* from, float* to)
{
  if (source[0] == 1)
  {
    CopyRows(nodes, source, from, to);
    return;
  }
  CopyAcross(nodes, source, source[1] == 1 ? 1 : 2, from, to);
}
}

Grid AxisPermutation::Of(const Grid& grid) const
{
  Grid ordered = grid;
  for (int axis = 0; axis < 3; ++axis)
  {
    ordered.nodes[axis] = grid.nodes[this->axes[axis]];
    ordered.direction[axis] = grid.direction[this->axes[axis]];
  }
  ordered.spacing = InOrder(grid.spacing, this->axes);
  return ordered;
}

RaySource AxisPermutation::Of(const RaySource& source) const
{
  RaySource ordered = source;
  ordered.origin = InOrder(source.origin, this->axes);
  ordered.direction = InOrder(source.direction, this->axes);
  for (RaySource::Plane& plane : ordered.viewPlanes)
  {
    plane.normal = InOrder(plane.normal, this->axes);
  }
  return ordered;
}

void Permute(const Grid& grid, const AxisPermutation& order, const float* field, float* permuted)
{
  const Strides strides = StridesOf(grid.nodes);
  Strides source{};
  for (int axis = 0; axis < 3; ++axis)
  {
    source[std::size_t(axis)] = strides[std::size_t(order.axes[axis])];
  }
  Copy(order.Of(grid).nodes, source, field, permuted);
}

void PermuteBack(
  const Grid& grid, const AxisPermutation& order, const float* permuted, float* field)
{
  const Strides strides = StridesOf(order.Of(grid).nodes);
  Strides source{};
  for (int axis = 0; axis < 3; ++axis)
  {
    source[std::size_t(order.axes[axis])] = strides[std::size_t(axis)];
  }
  Copy(grid.nodes, source, permuted, field);
}
}
