// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// RefineTransmittance on the processor: sixteen nodes of a row side by side.

#include "energy/NodeTransmittance.h"

#include "backend/HostDevice.h"
#include "backend/Simd.h"
#include "math/FloatLanes.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace limpid
{
namespace
{
constexpr int laneCount = FloatLanes::count;

/// Which bricks of cells have extinction. Where they have none, sixteen flags say so instead of 128
/// nodes.
class FilledBricks
{
public:
  FilledBricks(HostDevice& device, const Grid& grid, const float* extinction)
    : Counts((grid.nodes - 2) / side + 1)
    , Filled(std::size_t(this->Counts.x) * this->Counts.y * this->Counts.z)
  {
    device.ForRows("bricks with extinction", this->Counts,
      [&](Index first, int j, int k)
      {
        const Int3 begin(0, j * side, k * side);
        const Int3 end = glm::min(begin + side + 1, grid.nodes);
        for (int z = begin.z; z < end.z; ++z)
        {
          for (int y = begin.y; y < end.y; ++y)
          {
            this->AddRow(
              first, extinction + grid.nodes.x * (y + Index(grid.nodes.y) * z), grid.nodes.x);
          }
        }
      });
  }

  /// Whether any of some cells is in such a brick.
  LIMPID_INLINE bool AnyAt(const IntLanes (&cell)[3], const IntLanes& among) const
  {
    const auto at = [&](int axis) LIMPID_INLINE_LAMBDA { return cell[axis] >> shift; };
    const IntLanes brick = at(0) + this->Counts.x * (at(1) + this->Counts.y * at(2));
    return AnyOf(Gather(this->Filled.data(), brick & among) & among);
  }

private:
  static constexpr int shift = 3;
  static constexpr int side = 1 << shift; ///< cells along each axis

  void AddRow(Index first, const float* nodes, int count)
  {
    for (int brick = 0; brick < this->Counts.x; ++brick)
    {
      const float* begin = nodes + brick * side;
      const float* end = nodes + std::min(brick * side + side + 1, count);
      const bool filled = std::any_of(begin, end, [](float value) { return value > 0.0f; });
      this->Filled[std::size_t(first + brick)] |= filled ? 1 : 0;
    }
  }

  Int3 Counts;
  std::vector<std::uint8_t> Filled;
};

/// Reads the corners of sixteen cells.
struct CornersInLanes
{
  const FieldWithin& extinction;
  const FilledBricks& bricks;

  LIMPID_INLINE bool Read(
    const IntLanes (&cell)[3], const IntLanes& goesOn, CellCorners<FloatLanes>& corners) const
  {
    if (!this->bricks.AnyAt(cell, goesOn))
    {
      return false;
    }
    alignas(64) std::int32_t cells[3][laneCount];
    alignas(64) float nodes[2][2][2][laneCount];
    for (int axis = 0; axis < 3; ++axis)
    {
      (cell[axis] & goesOn).Store(cells[axis]);
    }
    const Index row = this->extinction.box.end.x;
    const Index slice = row * this->extinction.box.end.y;
    for (int i = 0; i < laneCount; ++i)
    {
      const float* first =
        this->extinction.values + cells[0][i] + row * cells[1][i] + slice * cells[2][i];
      for (int corner = 0; corner < 8; ++corner)
      {
        const int x = corner & 1;
        const int y = corner >> 1 & 1;
        const int z = corner >> 2;
        nodes[z][y][x][i] = first[x + row * y + slice * z];
      }
    }
    for (int corner = 0; corner < 8; ++corner)
    {
      const int x = corner & 1;
      const int y = corner >> 1 & 1;
      const int z = corner >> 2;
      corners.at[z][y][x] = FloatLanes::Load(nodes[z][y][x]);
    }
    return true;
  }
};

/// Returns a member of sixteen paths side by side.
template <class Number, class Get>
LIMPID_INLINE LanesOf<Number> OfPaths(const NodePath<float>* paths, const Get& get)
{
  alignas(64) Number numbers[laneCount];
  for (int i = 0; i < laneCount; ++i)
  {
    numbers[i] = get(paths[i]);
  }
  return LanesOf<Number>::Load(numbers);
}

LIMPID_INLINE NodePath<FloatLanes> InLanes(const NodePath<float>* paths)
{
  using Path = NodePath<float>;
  NodePath<FloatLanes> lanes;
  lanes.length = OfPaths<float>(paths, [](const Path& path) { return path.length; });
  lanes.end = OfPaths<float>(paths, [](const Path& path) { return path.end; });
  lanes.at = OfPaths<float>(paths, [](const Path& path) { return path.at; });
  for (int axis = 0; axis < 3; ++axis)
  {
    lanes.node[axis] = OfPaths<float>(paths, [axis](const Path& path) { return path.node[axis]; });
    lanes.way[axis] = OfPaths<float>(paths, [axis](const Path& path) { return path.way[axis]; });
    lanes.slowness[axis] =
      OfPaths<float>(paths, [axis](const Path& path) { return path.slowness[axis]; });
    lanes.face[axis] = OfPaths<float>(paths, [axis](const Path& path) { return path.face[axis]; });
    lanes.cell[axis] =
      OfPaths<std::int32_t>(paths, [axis](const Path& path) { return path.cell[axis]; });
    lanes.onward[axis] =
      OfPaths<std::int32_t>(paths, [axis](const Path& path) { return path.onward[axis]; });
  }
  return lanes;
}

/// Finds the optical depths of sixteen paths.
void FindDepths(
  const NodePath<float>* paths, const CornersInLanes& corners, WholeDepth (&depths)[laneCount])
{
  RunMultiversioned([&]() LIMPID_INLINE_LAMBDA { InLanes(paths).Depth(corners).Store(depths); });
}
}

void RefineTransmittance(HostDevice& device, const Grid& grid, const RaySource& source,
  const float* extinction, const float* swept, float* transmittance)
{
  const NodesWithin all = NodesWithin::Whole(grid);
  const NodesWithin cells = NodesWithin::CellsOf(grid);
  const FieldWithin absorbing{ extinction, all };
  const FieldWithin before{ swept, all };
  const NodeRays rays(grid, source);
  const FilledBricks bricks(device, grid, extinction);
  const CornersInLanes corners{ absorbing, bricks };
  device.ForRows("refine transmittance", grid.nodes,
    [&](Index first, int j, int k)
    {
      std::copy_n(swept + first, grid.nodes.x, transmittance + first);
      NodePath<float> paths[laneCount];
      int columns[laneCount];
      int count = 0;
      const auto finish = [&]
      {
        std::fill(paths + count, paths + laneCount, paths[0]);
        WholeDepth depths[laneCount];
        FindDepths(paths, corners, depths);
        for (; count > 0; --count)
        {
          transmittance[first + columns[count - 1]] = TransmittanceOf(depths[count - 1]);
        }
      };
      for (int i = 0; i < grid.nodes.x; ++i)
      {
        const Int3 node(i, j, k);
        if (before.IsSteepAt(node) && rays.See(node))
        {
          paths[count] = rays.PathFrom(node, cells);
          columns[count] = i;
          ++count;
        }
        if (count == laneCount)
        {
          finish();
        }
      }
      if (count > 0)
      {
        finish();
      }
    });
}
}
