// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_distributed_OccupancyOnRanks_h
#define limpid_distributed_OccupancyOnRanks_h

#include "distributed/Communicator.h"
#include "scene/FieldView.h"
#include "scene/Grid.h"

namespace limpid
{
/// Computes the Occupancy of a distributed scene; the result is the same on all ranks. `box`: the
/// nodes that this rank owns. The boxes of ranks must not overlap. Collective.
Occupancy OccupancyOnRanks(const Communicator& ranks, const Grid& grid, const NodeBox& box,
  const FieldView& extinction, const FieldView& importance, bool skip);
}

#endif
