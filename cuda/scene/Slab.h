// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_scene_Slab_h
#define limpid_scene_Slab_h

#include "scene/NodeBox.h"

namespace limpid
{
/// Whole slices of a grid along its last axis, which are contiguous in memory.
struct Slab
{
  Int3 nodes; ///< of the whole grid
  Range<int> slices;

  static Slab Of(const Int3& nodes) { return { nodes, { 0, nodes.z } }; }

  Index SliceSize() const { return Index(this->nodes.x) * this->nodes.y; }
  Index Begin() const { return this->SliceSize() * this->slices.begin; } ///< its first node
  Index Count() const { return this->SliceSize() * this->slices.Length(); }

  NodeBox Box() const
  {
    NodeBox box = NodeBox::Of(this->nodes);
    box.along[2] = this->slices;
    return box;
  }
};
}

#endif
