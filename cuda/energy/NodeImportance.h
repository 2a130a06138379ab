// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_NodeImportance_h
#define limpid_energy_NodeImportance_h

#include "math/Range.h"
#include "scene/Grid.h"

#include <functional>
#include <vector>

namespace limpid
{
/**
 * The importance that a node's extinction can show: the mean of the trilinear field g, weighted by
 * the node's own trilinear hat function phi,
 *
 *   g_i = integral phi_i g dx / integral phi_i dx.
 *
 * The extinction of a node acts on its whole neighbourhood with weight phi_i, so this, not g at the
 * node, stands in the derivative of Eqs. (23) and (24) with respect to the node's extinction
 * (deviation D8). It is 0 at nodes that have neither extinction nor importance: they are no one's
 * concern. `importance`: grid.NodeCount() values in [0, 1]; so is the result.
 */
std::vector<float> NodeImportanceOfFilled(
  const Grid& grid, const float* baseExtinction, const float* importance);

/// The integral of importance times base extinction, both trilinear between the nodes, over their
/// box: all that there is to be seen [length^2]. The same for any number of threads.
double ImportantExtinction(const Grid& grid, const float* baseExtinction, const float* importance);

/// The integrals over the nodes of rows along x, without the volume of a cell, of which that is the
/// sum: of `slices`, from fields of the slices `given`, which have one more on either side where
/// there is one. `rows`: grid.nodes.y * grid.nodes.z, row by row [1/length].
void FillRowsOfImportantExtinction(const Grid& grid, const Range<int>& given,
  const Range<int>& slices, const float* baseExtinction, const float* importance, double* rows);

/// The integral from those of all rows [length^2].
double SumOfRows(const Grid& grid, const std::vector<double>& rows);

/// Is told that some rows of a slice are complete.
using MeanRows = std::function<void(int slice, const Range<int>& rows)>;

/// The same, in place of grid.NodeCount() zeros. What is not important is not written. Tells `done`
/// of all rows: of slices in parallel, of the rows of one in order.
void FillNodeImportanceOfFilled(const Grid& grid, const float* baseExtinction,
  const float* importance, float* zeros, const MeanRows& done);
}

#endif
