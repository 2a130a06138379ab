// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What one node of a overlay does on a device: ExtinctionOverlay.cxx, node by node. The mathematics
// is in OverlayNode.h and Trilinear.h.

#ifndef limpid_render_ExtinctionOverlayBodies_h
#define limpid_render_ExtinctionOverlayBodies_h

#include "render/OpticalTable.h"
#include "render/OverlayNode.h"
#include "render/Trilinear.h"

namespace limpid
{
/// Nodes along the axes of a grid, and which of them has an index.
struct NodeCounts
{
  int x;
  int y;
  int z;

  LIMPID_HD LIMPID_INLINE Index Count() const { return Index(this->x) * this->y * this->z; }
  LIMPID_HD LIMPID_INLINE int ColumnOf(Index node) const { return int(node % this->x); }
  LIMPID_HD LIMPID_INLINE int RowOf(Index node) const { return int(node / this->x % this->y); }
  LIMPID_HD LIMPID_INLINE int SliceOf(Index node) const
  {
    return int(node / (Index(this->x) * this->y));
  }
};

/// Nothing is changed, and there is no light.
struct UnchangedNode
{
  std::int16_t* packed;

  LIMPID_HD void operator()(Index node) const
  {
    std::int16_t* here = this->packed + 4 * node;
    here[0] = std::int16_t(packedOne);
    here[1] = here[2] = here[3] = 0;
  }
};

/// Moves what is shown, and tells what casts the shadows then.
struct MovedNode
{
  OverlayNode overlay;
  float unit;   ///< of what is added [1/length]
  float* shown; ///< out [1/length]; null: something else casts them

  LIMPID_HD void operator()(Index node) const
  {
    const NodeCounts nodes{ this->overlay.nodes[0], this->overlay.nodes[1],
      this->overlay.nodes[2] };
    this->overlay.Move(node, nodes.ColumnOf(node), nodes.RowOf(node), nodes.SliceOf(node));
    if (this->shown)
    {
      this->shown[node] =
        ShownExtinctionOf(this->overlay.base[node], this->overlay.packed + 4 * node, this->unit);
    }
  }
};

/// The trilinear interpolation of a overlay on another grid over the same box.
struct ResampledNode
{
  CellGrid from;
  const FourPacked* packed;
  NodeCounts nodes;
  float scale[3]; ///< nodes of `from` per node
  FourPacked* out;

  LIMPID_HD void operator()(Index node) const
  {
    const CellPlace place(this->from, float(this->nodes.ColumnOf(node)) * this->scale[0],
      float(this->nodes.RowOf(node)) * this->scale[1],
      float(this->nodes.SliceOf(node)) * this->scale[2]);
    const FourFloats value = place.Sample(this->from, this->packed);
    for (int number = 0; number < 4; ++number)
    {
      this->out[node].values[number] = static_cast<std::int16_t>(value[number] + 0.5f);
    }
  }
};

/// A transmittance of 1.
struct UnshadowedNode
{
  std::int16_t* packed;

  LIMPID_HD void operator()(Index node) const
  {
    this->packed[4 * node + 2] = std::int16_t(packedOne);
  }
};

/// Takes a transmittance from the nodes of the same or another grid over the same box.
struct ShadowedNode
{
  NodeCounts from;
  const float* transmittance;
  NodeCounts nodes;
  std::int16_t* packed;

  LIMPID_HD void operator()(Index node) const
  {
    this->packed[4 * node + 2] = PackShare(this->At(node));
  }

private:
  LIMPID_HD LIMPID_INLINE float At(Index node) const
  {
    if (this->from.x == this->nodes.x && this->from.y == this->nodes.y &&
      this->from.z == this->nodes.z)
    {
      return this->transmittance[node];
    }
    const AxisPlace x = AxisPlace::Of(this->nodes.ColumnOf(node), this->from.x, this->nodes.x);
    const AxisPlace y = AxisPlace::Of(this->nodes.RowOf(node), this->from.y, this->nodes.y);
    const AxisPlace z = AxisPlace::Of(this->nodes.SliceOf(node), this->from.z, this->nodes.z);
    const Index row = this->from.x;
    const Index slice = row * this->from.y;
    const float* first = this->transmittance + x.before + row * y.before + slice * z.before;
    const auto column = [&](const float* at)
    {
      const float front = Blend(at[0], at[row], y.share);
      return Blend(front, Blend(at[slice], at[slice + row], y.share), z.share);
    };
    return Blend(column(first), column(first + 1), x.share);
  }
};

/// Extinction of the transfer function at a node.
struct ClassifiedNode
{
  OpticalTable<FourFloats> table;
  const float* scalars;
  const float* filled; ///< null: all are

  /// [majorant]
  LIMPID_HD LIMPID_INLINE float At(Index node) const
  {
    const float extinction = this->table.At(this->table.Position(this->scalars[node]))[0];
    return this->filled ? extinction * this->filled[node] : extinction;
  }
};

/// The same as a field.
struct BaseNode
{
  ClassifiedNode classified;
  float majorant; ///< [1/length]
  float* out;     ///< [1/length]

  LIMPID_HD void operator()(Index node) const
  {
    this->out[node] = this->classified.At(node) * this->majorant;
  }
};

/// A field on a grid with fewer nodes along one axis, over the same box: Restrict, one axis at a
/// time. Every node is the mean of the finer ones about it, weighted by its hat function.
struct RestrictedNode
{
  NodeCounts from;
  const float* field;
  NodeCounts nodes;
  int axis;
  float* out;

  LIMPID_HD void operator()(Index node) const
  {
    int at[3] = { this->nodes.ColumnOf(node), this->nodes.RowOf(node), this->nodes.SliceOf(node) };
    const int fine =
      this->axis == 0 ? this->from.x : (this->axis == 1 ? this->from.y : this->from.z);
    const int coarse =
      this->axis == 0 ? this->nodes.x : (this->axis == 1 ? this->nodes.y : this->nodes.z);
    const double ratio = coarse > 1 ? (fine - 1.0) / (coarse - 1.0) : 1.0;
    const double width = ratio > 1.0 ? ratio : 1.0;
    const double centre = at[this->axis] * ratio;
    const int low = static_cast<int>(std::ceil(centre - width));
    const int high = static_cast<int>(std::floor(centre + width));
    const int first = low > 0 ? low : 0;
    const int last = high < fine - 1 ? high : fine - 1;
    double sum = 0;
    for (int source = first; source <= last; ++source)
    {
      sum += Hat(source, centre, width);
    }
    float mean = 0;
    for (int source = first; source <= last; ++source)
    {
      at[this->axis] = source;
      const auto weight = static_cast<float>(float(Hat(source, centre, width)) / sum);
      mean += weight * this->field[at[0] + this->from.x * (at[1] + Index(this->from.y) * at[2])];
    }
    this->out[node] = mean;
  }

private:
  LIMPID_HD static LIMPID_INLINE double Hat(int source, double centre, double width)
  {
    const double distance = source > centre ? source - centre : centre - source;
    const double height = 1.0 - distance / width;
    return height > 0.0 ? height : 0.0;
  }
};
}

#endif
