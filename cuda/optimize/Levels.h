// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Levels_h
#define limpid_optimize_Levels_h

#include "scene/Grid.h"
#include "sweep/RankRegions.h"

#include <vector>

namespace limpid
{
/// A grid over the same box with about 1/factor as many nodes along each axis, at least two where
/// the grid has two.
Grid CoarseGrid(const Grid& grid, int factor);

/// A field on another grid over the same box: along axes that are coarser there as Restrict has it,
/// along others as Prolong has it.
std::vector<float> Resampled(const Grid& from, const float* field, const Grid& to);

/// The same where ranks share both, of each rank a box of nodes. `had`: of the field, no two with a
/// node in common; `wanted`: of the result, whose part for this rank is returned, first axis
/// fastest.
std::vector<float> ResampledBox(const Communicator& ranks, const Grid& from, const FieldView& field,
  const std::vector<NodeBox>& had, const Grid& to, const std::vector<NodeBox>& wanted);

/// The same at all nodes of the other grid, of which every rank gets all.
std::vector<float> ResampledForAll(const Communicator& ranks, const Grid& from,
  const FieldView& field, const std::vector<NodeBox>& had, const Grid& to);

/// The same in a box of nodes, of a field that is here.
std::vector<float> ResampledBox(
  const Grid& from, const float* field, const Grid& to, const NodeBox& wanted);

/// Whether every rank may have all of a grid: that takes little beside its piece of `full`.
bool IsForAll(const Communicator& ranks, const Grid& grid, const Grid& full);

/// A field on a coarse grid over the same box: the mean of the fine field about each coarse node,
/// weighted by the coarse node's trilinear hat function.
std::vector<float> Restrict(const Grid& fine, const float* field, const Grid& coarse);

/// A field on a fine grid over the same box: the coarse field's trilinear interpolation.
std::vector<float> Prolong(const Grid& coarse, const float* field, const Grid& fine);
}

#endif
