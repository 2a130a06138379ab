// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/ExtinctionOverlay.h"

#include "backend/Backend.h"
#include "render/OverlayNode.h"
#include "render/RaySamples.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace limpid
{
namespace
{
constexpr Index nodesPerTask = 32768;

/// Where the nodes of an axis lie between those of another one over the same length.
struct AxisMap
{
  std::vector<int> before;  ///< the other node at or before
  std::vector<float> share; ///< of the way to the one behind it

  AxisMap(int from, int to)
    : last(from - 1)
  {
    for (int node = 0; node < to; ++node)
    {
      const AxisPlace place = AxisPlace::Of(node, from, to);
      this->before.push_back(place.before);
      this->share.push_back(place.share);
    }
  }

  /// The two lines of numbers, `stride` apart, that a node lies between.
  void Neighbours(int node, const float* lines, Index stride, const float** pair) const
  {
    const int first = this->before[std::size_t(node)];
    pair[0] = lines + stride * first;
    pair[1] = lines + stride * std::min(first + 1, this->last);
  }

private:
  int last;
};

bool SameNodes(const Grid& a, const Grid& b)
{
  return a.nodes == b.nodes && a.spacing == b.spacing && a.origin == b.origin;
}

/// A field on another grid over the same box: its trilinear interpolation
/// there.
OverlayField Resample(const OverlayField& from, const Int3& nodes)
{
  OverlayField to;
  to.nodes = nodes;
  to.changed = from.changed;
  to.packed.resize(std::size_t(4 * Index(nodes.x) * nodes.y * nodes.z));
  float scale[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    scale[axis] = float(from.nodes[axis] - 1) / float(std::max(nodes[axis] - 1, 1));
  }
  ParallelFor(Index(nodes.y) * nodes.z,
    [&](Index row)
    {
      for (int i = 0; i < nodes.x; ++i)
      {
        const float position[3] = { float(i) * scale[0], float(int(row % nodes.y)) * scale[1],
          float(int(row / nodes.y)) * scale[2] };
        const Float4 value = InterpolateOverlay(from, position);
        std::int16_t* out = to.packed.data() + 4 * (row * nodes.x + i);
        for (int number = 0; number < 4; ++number)
        {
          out[number] = static_cast<std::int16_t>(value[number] + 0.5f);
        }
      }
    });
  return to;
}
} // namespace

void ExtinctionOverlay::Clear()
{
  *this = ExtinctionOverlay();
}

void ExtinctionOverlay::MoveTo(
  const Grid& grid, const float* base, const float* extinction, float unit, double share)
{
  const float rescale = unit > 0 && !this->Empty() ? this->Unit / unit : 1.0f;
  if (this->Empty())
  {
    this->Packed.nodes = grid.nodes;
    this->Packed.packed.assign(std::size_t(4 * grid.NodeCount()), 0);
    for (std::size_t kept = 0; kept < this->Packed.packed.size(); kept += 4)
    {
      this->Packed.packed[kept] = std::int16_t(packedOne);
    }
  }
  else if (!SameNodes(grid, this->Place))
  {
    this->Packed = Resample(this->Packed, grid.nodes);
  }
  this->Place = grid;
  this->Unit = unit;
  const OverlayNode body{ { grid.nodes.x, grid.nodes.y, grid.nodes.z }, base, extinction,
    unit > 0 ? 1 / unit : 0.0f, static_cast<float>(share), rescale, this->Packed.packed.data() };
  std::atomic<bool> changed{ false };
  ParallelFor(Index(grid.nodes.y) * grid.nodes.z, 16,
    [&](Index row)
    {
      const OverlayNode node = body; // a copy: nothing that is written below can be part of it
      const int j = int(row % grid.nodes.y);
      const int k = int(row / grid.nodes.y);
      bool any = false;
      for (int i = 0; i < grid.nodes.x; ++i)
      {
        any |= node.Move(row * grid.nodes.x + i, i, j, k);
      }
      if (any)
      {
        changed = true;
      }
    });
  this->Packed.changed = changed;
}

void ExtinctionOverlay::ClearShadow()
{
  std::int16_t* packed = this->Packed.packed.data();
  this->Packed.shadowed = false;
  ParallelFor(this->Place.NodeCount(), nodesPerTask,
    [&](Index node) { packed[4 * node + 2] = std::int16_t(packedOne); });
}

void ExtinctionOverlay::SetShadow(const Int3& nodes, const float* transmittance)
{
  const Int3 to = this->Packed.nodes;
  std::int16_t* packed = this->Packed.packed.data();
  this->Packed.shadowed = true;
  if (nodes == to)
  {
    ParallelFor(this->Place.NodeCount(), nodesPerTask,
      [&](Index node) { packed[4 * node + 2] = PackShare(transmittance[node]); });
    return;
  }
  const AxisMap columns(nodes.x, to.x);
  const AxisMap rows(nodes.y, to.y);
  const AxisMap slices(nodes.z, to.z);
  ParallelFor(to.z,
    [&](Index k)
    {
      std::vector<float> line(static_cast<std::size_t>(nodes.x) + 1); // one more to read beyond
      const float* slice[2];
      slices.Neighbours(int(k), transmittance, Index(nodes.x) * nodes.y, slice);
      for (int j = 0; j < to.y; ++j)
      {
        const float* near[2];
        const float* far[2];
        rows.Neighbours(j, slice[0], nodes.x, near);
        rows.Neighbours(j, slice[1], nodes.x, far);
        const float y = rows.share[std::size_t(j)];
        const float z = slices.share[std::size_t(k)];
        for (int i = 0; i < nodes.x; ++i)
        {
          const float front = near[0][i] + y * (near[1][i] - near[0][i]);
          const float back = far[0][i] + y * (far[1][i] - far[0][i]);
          line[std::size_t(i)] = front + z * (back - front);
        }
        std::int16_t* out = packed + 4 * (to.x * (j + to.y * k)) + 2;
        for (int i = 0; i < to.x; ++i)
        {
          const float* left = line.data() + columns.before[std::size_t(i)];
          out[4 * Index(i)] =
            PackShare(left[0] + columns.share[std::size_t(i)] * (left[1] - left[0]));
        }
      }
    });
}

std::vector<float> ExtinctionOverlay::ShownExtinction(const float* base) const
{
  std::vector<float> shown(std::size_t(this->Place.NodeCount()));
  const std::int16_t* packed = this->Packed.packed.data();
  ParallelFor(this->Place.NodeCount(), nodesPerTask,
    [&](Index node)
    { shown[std::size_t(node)] = ShownExtinctionOf(base[node], packed + 4 * node, this->Unit); });
  return shown;
}
} // namespace limpid
