// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_scene_Resampling_h
#define limpid_scene_Resampling_h

#include "scene/AxisFilter.h"
#include "scene/Grid.h"
#include "scene/NodeBox.h"

#include <vector>

namespace limpid
{
/// Returns a grid over the same box with about 1/factor as many nodes along each axis, but at
/// least two if `grid` has two.
Grid CoarseGrid(const Grid& grid, int factor);

/// Resamples a field to a box of nodes of another grid: along axes where that is coarser, by the
/// mean around each coarse node, weighted by its linear hat function; by linear interpolation along
/// the others. `field`: has the nodes of filter.SourcesOf(box) only.
std::vector<float> ResampledBox(const GridFilter& filter, const float* field, const NodeBox& box);
}

#endif
