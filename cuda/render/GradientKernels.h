// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The gradient of the transfer function's extinction at the nodes.

#ifndef limpid_render_GradientKernels_h
#define limpid_render_GradientKernels_h

#include "render/Classification.h"
#include "render/ScalarNodes.h"

#include <cmath>

namespace limpid
{
/// Computes the extinction of the transfer function at a node.
struct ClassifiedNode
{
  OpticalTable table;
  ScalarNodes scalars;
  const float* filled; ///< null: all nodes are
  float majorant;      ///< unit of the result
  float* extinction;   ///< out [1/length], or [majorant] if that is 1

  LIMPID_HD void operator()(Index node) const
  {
    const float all = this->table.At(this->table.axis.Position(this->scalars.At(node)))[0];
    const float here = this->filled ? all * this->filled[node] : all;
    this->extinction[node] = here * this->majorant;
  }
};

/// Computes the gradient of a field at a node by central differences, in world directions.
struct GradientNode
{
  const float* field; ///< some layers of nodes
  int firstLayer;     ///< of the field
  Int3 nodes;
  Mat3 toWorld;
  Vec3 spacing;

  /// The field must have this layer and those next to it.
  LIMPID_HD LIMPID_INLINE void At(int i, int j, int k, float* gradient) const
  {
    const Index row = this->nodes.x;
    const Index layer = row * this->nodes.y;
    const Index node = i + j * row + (k - this->firstLayer) * layer;
    const Vec3 steps(this->Difference(node, i, this->nodes.x, 1),
      this->Difference(node, j, this->nodes.y, row),
      this->Difference(node, k, this->nodes.z, layer));
    const Vec3 world = this->toWorld * (steps / this->spacing);
    gradient[0] = float(world.x);
    gradient[1] = float(world.y);
    gradient[2] = float(world.z);
  }

private:
  /// Returns the difference per node along an axis of `count` nodes, for the node with index `at`.
  LIMPID_HD LIMPID_INLINE float Difference(Index node, int at, int count, Index stride) const
  {
    const int before = at > 0 ? 1 : 0;
    const int after = at + 1 < count ? 1 : 0;
    const float share = before + after > 0 ? 1.0f / float(before + after) : 0.0f;
    return (this->field[node + after * stride] - this->field[node - before * stride]) * share;
  }
};

/// Computes the squared length of a gradient at the nodes of a box.
struct SteepnessNode
{
  GradientNode gradient;
  Int3 first;     ///< of the box
  float* squared; ///< out, at the nodes of the box

  LIMPID_HD void operator()(Index out, int i, int j, int k) const
  {
    const Int3 at = this->first + Int3(i, j, k);
    float here[3];
    this->gradient.At(at.x, at.y, at.z, here);
    this->squared[out] = here[0] * here[0] + here[1] * here[1] + here[2] * here[2];
  }
};

/// Computes the maximum of a run of values, which are at least zero.
struct LargestOfRun
{
  const float* values;
  int length;
  float* largest; ///< out

  LIMPID_HD void operator()(Index run) const
  {
    float most = 0;
    for (Index i = run * this->length; i < (run + 1) * this->length; ++i)
    {
      most = most < this->values[i] ? this->values[i] : most;
    }
    this->largest[run] = most;
  }
};

/// Packs a gradient, divided by the largest length, in world directions, and the light that
/// arrives, which is 1 until ShadowedGradientNode sets it. For the nodes of some layers.
struct PackedGradientNode
{
  GradientNode gradient;
  int firstLayer;
  const float* largest; ///< square of the largest length
  FourPacked* packed;   ///< out, of the layers

  LIMPID_HD void operator()(Index node, int i, int j, int k) const
  {
    const float most = std::sqrt(*this->largest);
    const float unit = most > 0 ? packedOne / most : 0.0f;
    float here[3];
    this->gradient.At(i, j, this->firstLayer + k, here);
    std::int16_t* out = this->packed[node].values;
    for (int axis = 0; axis < 3; ++axis)
    {
      out[axis] = static_cast<std::int16_t>(std::lrint(here[axis] * unit));
    }
    out[3] = std::int16_t(packedOne);
  }
};

/// Copies the light that arrives at the same node.
struct ShadowedGradientNode
{
  const float* shadow; ///< [packedOne]
  FourPacked* packed;  ///< in and out

  LIMPID_HD void operator()(Index node) const
  {
    this->packed[node].values[3] = static_cast<std::int16_t>(this->shadow[node]);
  }
};
}

#endif
