// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The gradient of the transfer function's extinction on a device: PackGradient, node by node.

#ifndef limpid_render_GradientBodies_h
#define limpid_render_GradientBodies_h

#include "render/Gradient.h"
#include "render/OverlayKernels.h"

namespace limpid
{
/// The gradient at a node [majorant/length], world.
struct GradientNode
{
  ClassifiedNode classified;
  NodeCounts nodes;
  Mat3 toWorld;
  Vec3 spacing;

  LIMPID_HD LIMPID_INLINE GradientVector At(Index node) const
  {
    const Index row = this->nodes.x;
    const Index slice = row * this->nodes.y;
    const int i = this->nodes.ColumnOf(node);
    const int j = this->nodes.RowOf(node);
    const int k = this->nodes.SliceOf(node);
    const Vec3 steps(this->Difference(Neighbours(i, this->nodes.x), node - i, 1),
      this->Difference(Neighbours(j, this->nodes.y), node - row * j, row),
      this->Difference(Neighbours(k, this->nodes.z), node - slice * k, slice));
    return GradientOf(steps, this->toWorld, this->spacing);
  }

private:
  /// `line`: first node of the line through the node.
  LIMPID_HD LIMPID_INLINE float Difference(
    const Neighbours& neighbours, Index line, Index stride) const
  {
    return (this->classified.At(line + stride * neighbours.after) -
             this->classified.At(line + stride * neighbours.before)) *
      neighbours.Share();
  }
};

/// Square of a gradient's length.
struct SteepnessOfNode
{
  GradientNode gradient;
  LIMPID_HD LIMPID_INLINE float operator()(Index node) const
  {
    return this->gradient.At(node).SquaredLength();
  }
};

/// What another pass has found.
struct FoundSteepness
{
  const float* found;
  LIMPID_HD LIMPID_INLINE float operator()(Index lane) const { return this->found[lane]; }
};

/// Lane `lane` finds the largest of every `lanes`-th value of `count`.
template <class Value>
struct LargestOfLane
{
  Value value;
  Index count;
  Index lanes;
  float* largest;

  LIMPID_HD void operator()(Index lane) const
  {
    float most = 0;
    for (Index i = lane; i < this->count; i += this->lanes)
    {
      const float here = this->value(i);
      most = most < here ? here : most;
    }
    this->largest[lane] = most;
  }
};

/// Packs a gradient over the largest length.
struct PackedGradientNode
{
  GradientNode gradient;
  const float* largest; ///< square of that length
  std::int16_t* packed; ///< out, see GradientField

  LIMPID_HD void operator()(Index node) const
  {
    const float unit = GradientUnit(*this->largest);
    const GradientVector here = this->gradient.At(node);
    std::int16_t* out = this->packed + 4 * node;
    for (int axis = 0; axis < 3; ++axis)
    {
      out[axis] = static_cast<std::int16_t>(std::lrint(here.values[axis] * unit));
    }
    out[3] = 0;
  }
};
}

#endif
