// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Computations at one node of an extinction overlay.

#ifndef limpid_render_OverlayKernels_h
#define limpid_render_OverlayKernels_h

#include "render/SingleSampler.h"

#include <algorithm>

namespace limpid
{
/// The largest optical depth of a cell that casts shadows. A surface is somewhere between two
/// nodes; light that reaches the node behind it through less than half a cell must not be lost.
constexpr double mostCasting = 4;

/// Limits an extinction to another one.
struct LimitedNode
{
  float most;
  float* extinction; ///< in and out

  LIMPID_HD void operator()(Index node) const
  {
    this->extinction[node] = AtMost(this->extinction[node], this->most);
  }
};

/// Returns a share [0, 1] in units of packedOne.
LIMPID_HD LIMPID_INLINE std::int16_t PackShare(float value)
{
  const float inside = value < 0.0f ? 0.0f : (1.0f < value ? 1.0f : value);
  return static_cast<std::int16_t>(inside * packedOne + 0.5f);
}

/// Initialises a node without changes.
struct UnchangedNode
{
  TwoPacked* packed; ///< out

  LIMPID_HD void operator()(Index node) const
  {
    this->packed[node] = { { std::int16_t(packedOne), 0 } };
  }
};

/// Moves the change of an extinction by a share of the way to another one, and optionally writes
/// the extinction that results.
struct MovedNode
{
  Int3 nodes;
  const float* base;       ///< [1/length]
  const float* extinction; ///< the extinction to move to [1/length]
  float unit;              ///< unit of the added extinction: the majorant [1/length]
  float perUnit;           ///< 1 / unit [length]
  float share;
  float rescale;     ///< the previous unit of `packed` over the present one
  TwoPacked* packed; ///< in and out
  float* shown;      ///< out [1/length]; null: not needed

  LIMPID_HD void operator()(Index node, int i, int j, int k) const
  {
    this->Move(node, i, j, k);
    if (this->shown)
    {
      this->Tell(node);
    }
  }

  /// Returns whether the node changes its extinction.
  LIMPID_HD LIMPID_INLINE bool Move(Index node, int i, int j, int k) const
  {
    std::int16_t* here = this->packed[node].values;
    const std::int16_t kept = PackShare(this->Kept(node, i, j, k));
    const std::int16_t added =
      PackShare((this->extinction[node] - this->base[node]) * this->perUnit);
    here[0] = this->Eased(here[0], 1.0f, kept);
    here[1] = this->Eased(here[1], this->rescale, added);
    return here[0] != std::int16_t(packedOne) || here[1] != 0;
  }

  /// Writes the extinction that a node shows.
  LIMPID_HD LIMPID_INLINE void Tell(Index node) const
  {
    const std::int16_t* here = this->packed[node].values;
    const float kept = this->base[node] * (here[0] / packedOne);
    this->shown[node] = kept + this->unit * (here[1] / packedOne);
  }

private:
  LIMPID_HD LIMPID_INLINE std::int16_t Eased(
    std::int16_t from, float scale, std::int16_t goal) const
  {
    const float old = from * scale;
    const float now = packedOne < old ? packedOne : old;
    const float next = now + this->share * (float(goal) - now);
    return static_cast<std::int16_t>(next + 0.5f);
  }

  LIMPID_HD LIMPID_INLINE float KeptOf(Index node) const
  {
    const float kept = this->extinction[node] / this->base[node];
    return 1.0f < kept ? 1.0f : kept;
  }

  /// Returns the share of the base extinction that is kept; where there is no base extinction, the
  /// mean over those neighbours that have some.
  LIMPID_HD LIMPID_INLINE float Kept(Index node, int i, int j, int k) const
  {
    if (this->base[node] > 0)
    {
      return this->KeptOf(node);
    }
    const int at[3] = { i, j, k };
    float sum = 0;
    int count = 0;
    Index stride = 1;
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int side = -1; side <= 1; side += 2)
      {
        const int neighbour = at[axis] + side;
        if (neighbour >= 0 && neighbour < this->nodes[axis] && this->base[node + side * stride] > 0)
        {
          sum += this->KeptOf(node + side * stride);
          ++count;
        }
      }
      stride *= this->nodes[axis];
    }
    return count > 0 ? sum / float(count) : 1.0f;
  }
};

/// Interpolates an overlay trilinearly on another grid.
struct ResampledNode
{
  CellGrid from;
  const TwoPacked* packed;
  float first[3]; ///< position of its first node [nodes of `from`]
  float scale[3]; ///< nodes of `from` per node
  TwoPacked* out;

  LIMPID_HD void operator()(Index node, int i, int j, int k) const
  {
    const float at[3] = { this->first[0] + float(i) * this->scale[0],
      this->first[1] + float(j) * this->scale[1], this->first[2] + float(k) * this->scale[2] };
    float numbers[2];
    SingleSampler::InterpolateAll(this->from, this->packed, CellPlace(this->from, at), numbers);
    for (int number = 0; number < 2; ++number)
    {
      this->out[node].values[number] = static_cast<std::int16_t>(numbers[number] + 0.5f);
    }
  }
};

/// Copies the light that arrives at the same node.
struct ShadowedNode
{
  const float* light;
  float* shadow; ///< out [packedOne]

  LIMPID_HD void operator()(Index node) const { this->shadow[node] = PackShare(this->light[node]); }
};

/// The position of a node of an axis between those of another one over the same length.
struct AxisPlace
{
  int before;  ///< index of the other axis's node at or before
  float share; ///< fraction of the way to the next node

  /// `from`: number of nodes of the other axis; `to`: of this one.
  AxisPlace(int node, int from, int to)
  {
    const double ratio = double(from - 1) / std::max(to - 1, 1);
    this->before = std::min(static_cast<int>(node * ratio), std::max(from - 2, 0));
    this->share = static_cast<float>(node * ratio - this->before);
  }
};

/// Interpolates a field linearly along one axis, for a grid over the same box with another number
/// of nodes along this axis only.
struct InterpolatedAlong
{
  int axis;
  const AxisPlace* places; ///< one per node along the axis
  const float* field;
  Int3 from; ///< nodes of the field
  float* out;

  LIMPID_HD void operator()(Index node, int i, int j, int k) const
  {
    this->out[node] = this->At(i, j, k);
  }

  LIMPID_HD LIMPID_INLINE float At(int i, int j, int k) const
  {
    const AxisPlace place = this->places[this->axis == 0 ? i : (this->axis == 1 ? j : k)];
    const Index column = this->axis == 0 ? place.before : i;
    const Index row = this->axis == 1 ? place.before : j;
    const Index slice = this->axis == 2 ? place.before : k;
    const float* first = this->field + column + this->from.x * (row + this->from.y * slice);
    const Index stride =
      this->axis == 0 ? 1 : (this->axis == 1 ? this->from.x : Index(this->from.x) * this->from.y);
    return Blend(first[0], first[stride], place.share);
  }
};

/// Interpolates the light that arrives along the last axis.
struct InterpolatedShadowNode
{
  InterpolatedAlong light;
  float* shadow; ///< out [packedOne]

  LIMPID_HD void operator()(Index node, int i, int j, int k) const
  {
    this->shadow[node] = PackShare(this->light.At(i, j, k));
  }
};
}

#endif
