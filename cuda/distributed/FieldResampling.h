// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_distributed_FieldResampling_h
#define limpid_distributed_FieldResampling_h

#include "distributed/ScenePiece.h"
#include "scene/Resampling.h"

#include <vector>

namespace limpid
{
/// Resamples a distributed field, see ResampledBox. `field`: has the nodes of this rank's box in
/// `piece`; `wanted`: boxes of the result, one per rank. Returns this rank's part of the result,
/// first axis fastest. Collective.
std::vector<float> ResampledIn(const ScenePiece& piece, const Grid& from, const float* field,
  const Grid& to, const std::vector<NodeBox>& wanted);

/// Resamples a distributed field to all nodes of the other grid, on every rank. Collective.
void ResampleForAll(
  const ScenePiece& piece, const Grid& from, const float* field, const Grid& to, float* result);
std::vector<float> ResampledForAll(
  const ScenePiece& piece, const Grid& from, const float* field, const Grid& to);

/// Whether every rank may hold all of a grid, because that is small compared to its part of
/// `full`. A process alone holds all in any case.
bool IsForAll(const Communicator& ranks, const Grid& grid, const Grid& full);
}

#endif
