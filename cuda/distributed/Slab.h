// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_distributed_Slab_h
#define limpid_distributed_Slab_h

#include "distributed/Communicator.h"
#include "scene/NodeBox.h"

#include <vector>

namespace limpid
{
/// Whole slices of a grid along its last axis, which are contiguous in memory: a rank's share of
/// work on voxels that needs no rays.
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

/// Returns one slab per rank. Together they are the grid; their numbers of slices differ by at most
/// one.
std::vector<NodeBox> EvenSlabs(const Communicator& ranks, const Int3& nodes);

/// Returns the slab of this rank.
Slab OwnSlab(const Communicator& ranks, const Int3& nodes);
}

#endif
