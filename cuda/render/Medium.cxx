// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/Medium.h"

#include "backend/Backend.h"
#include "render/RaySamples.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace limpid
{
namespace
{
constexpr Index nodesPerTask = 32768;

std::int16_t Pack(float value)
{
  return static_cast<std::int16_t>(std::clamp(value, 0.0f, 1.0f) * packedOne + 0.5f);
}

/// Share of the base extinction that is kept at a node; where there is none,
/// the mean of the neighbours that have some.
class KeptShare
{
public:
  KeptShare(const Int3& nodes, const float* base, const float* extinction)
    : Nodes(nodes)
    , Base(base)
    , Extinction(extinction)
  {
  }

  float At(Index node, const Int3& at) const
  {
    if (this->Base[node] > 0)
    {
      return this->Of(node);
    }
    float sum = 0;
    int count = 0;
    Index stride = 1;
    for (int axis = 0; axis < 3; ++axis)
    {
      for (const int side : { -1, 1 })
      {
        const int neighbour = at[axis] + side;
        if (neighbour >= 0 && neighbour < this->Nodes[axis] && this->Base[node + side * stride] > 0)
        {
          sum += this->Of(node + side * stride);
          ++count;
        }
      }
      stride *= this->Nodes[axis];
    }
    return count > 0 ? sum / float(count) : 1.0f;
  }

private:
  float Of(Index node) const { return std::min(this->Extinction[node] / this->Base[node], 1.0f); }

  Int3 Nodes;
  const float* Base;
  const float* Extinction;
};

/// Where the nodes of an axis lie between those of another one over the same length.
struct AxisMap
{
  std::vector<int> before;  ///< the other node at or before
  std::vector<float> share; ///< of the way to the one behind it

  AxisMap(int from, int to)
    : last(from - 1)
  {
    const double ratio = double(from - 1) / std::max(to - 1, 1);
    for (int node = 0; node < to; ++node)
    {
      const int first = std::min(static_cast<int>(node * ratio), std::max(from - 2, 0));
      this->before.push_back(first);
      this->share.push_back(static_cast<float>(node * ratio - first));
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
MediumField Resample(const MediumField& from, const Int3& nodes)
{
  MediumField to;
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
        const Float4 value = InterpolateMedium(from, position);
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

void Medium::Clear()
{
  *this = Medium();
}

void Medium::MoveTo(
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
  const float perUnit = unit > 0 ? 1 / unit : 0.0f;
  const float part = static_cast<float>(share);
  const float units[2] = { 1, rescale };
  const KeptShare kept(grid.nodes, base, extinction);
  std::atomic<bool> changed{ false };
  ParallelFor(Index(grid.nodes.y) * grid.nodes.z, 16,
    [&](Index row)
    {
      bool any = false;
      for (int i = 0; i < grid.nodes.x; ++i)
      {
        const Index node = row * grid.nodes.x + i;
        const Int3 at(i, int(row % grid.nodes.y), int(row / grid.nodes.y));
        std::int16_t* packed = this->Packed.packed.data() + 4 * node;
        const float goals[2] = { float(Pack(kept.At(node, at))),
          float(Pack((extinction[node] - base[node]) * perUnit)) };
        for (int number = 0; number < 2; ++number)
        {
          const float now = std::min(packed[number] * units[number], packedOne);
          const float next = now + part * (goals[number] - now);
          packed[number] = static_cast<std::int16_t>(next + 0.5f);
        }
        any |= packed[0] != std::int16_t(packedOne) || packed[1] != 0;
      }
      if (any)
      {
        changed = true;
      }
    });
  this->Packed.changed = changed;
}

void Medium::ClearShadow()
{
  std::int16_t* packed = this->Packed.packed.data();
  this->Packed.shadowed = false;
  ParallelFor(this->Place.NodeCount(), nodesPerTask,
    [&](Index node) { packed[4 * node + 2] = std::int16_t(packedOne); });
}

void Medium::SetShadow(const Int3& nodes, const float* transmittance)
{
  const Int3 to = this->Packed.nodes;
  std::int16_t* packed = this->Packed.packed.data();
  this->Packed.shadowed = true;
  if (nodes == to)
  {
    ParallelFor(this->Place.NodeCount(), nodesPerTask,
      [&](Index node) { packed[4 * node + 2] = Pack(transmittance[node]); });
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
          out[4 * Index(i)] = Pack(left[0] + columns.share[std::size_t(i)] * (left[1] - left[0]));
        }
      }
    });
}

std::vector<float> Medium::ShownExtinction(const float* base) const
{
  std::vector<float> shown(std::size_t(this->Place.NodeCount()));
  const std::int16_t* packed = this->Packed.packed.data();
  ParallelFor(this->Place.NodeCount(), nodesPerTask,
    [&](Index node)
    {
      const float kept = base[node] * (packed[4 * node] / packedOne);
      shown[std::size_t(node)] = kept + this->Unit * (packed[4 * node + 1] / packedOne);
    });
  return shown;
}
} // namespace limpid
