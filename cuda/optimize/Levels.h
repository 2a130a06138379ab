// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Levels_h
#define limpid_optimize_Levels_h

#include "distributed/Communicator.h"
#include "scene/FieldView.h"
#include "scene/Grid.h"

#include <vector>

namespace limpid
{
/// Returns a grid over the same box with about 1/factor as many nodes along each axis, but at
/// least two if `grid` has two.
Grid CoarseGrid(const Grid& grid, int factor);

/// Resamples a field to another grid over the same box: by Restrict along axes where that is
/// coarser, by linear interpolation along the others.
std::vector<float> Resampled(const Grid& from, const float* field, const Grid& to);

/// Resamples a distributed field, one box of nodes per rank. `had`: disjoint boxes of the field;
/// `wanted`: boxes of the result. Returns this rank's part of the result, first axis fastest.
std::vector<float> ResampledBox(const Communicator& ranks, const Grid& from, const FieldView& field,
  const std::vector<NodeBox>& had, const Grid& to, const std::vector<NodeBox>& wanted);

/// Resamples a distributed field to all nodes of the other grid, on every rank.
std::vector<float> GatheredResampling(const Communicator& ranks, const Grid& from,
  const FieldView& field, const std::vector<NodeBox>& had, const Grid& to);

/// Resamples a field that this process holds completely to a box of nodes.
std::vector<float> ResampledBox(
  const Grid& from, const float* field, const Grid& to, const NodeBox& wanted);

/// Whether every rank may hold all of a grid, because that is small compared to its part of
/// `full`.
bool IsForAll(const Communicator& ranks, const Grid& grid, const Grid& full);

/// Restricts a field to a coarser grid over the same box: the mean around each coarse node,
/// weighted by the coarse node's trilinear hat function.
std::vector<float> Restrict(const Grid& fine, const float* field, const Grid& coarse);
}

#endif
