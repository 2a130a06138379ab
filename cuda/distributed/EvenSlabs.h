// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_distributed_EvenSlabs_h
#define limpid_distributed_EvenSlabs_h

#include "distributed/Communicator.h"
#include "scene/NodeBox.h"
#include "scene/Slab.h"

#include <vector>

namespace limpid
{
/// Returns one slab per rank. Together they are the grid; their numbers of slices differ by at most
/// one.
std::vector<NodeBox> EvenSlabs(const Communicator& ranks, const Int3& nodes);

/// Returns the slab of this rank: its share of work on voxels that needs no rays.
Slab OwnSlab(const Communicator& ranks, const Int3& nodes);
}

#endif
