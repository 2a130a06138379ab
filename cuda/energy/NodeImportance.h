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
 * the node's trilinear hat function phi,
 *
 *    g_i = integral phi_i g dx / integral phi_i dx.
 *
 * The extinction of a node acts on its whole neighbourhood with weight phi_i. The derivative of
 * Eqs. (23) and (24) by the node's extinction therefore contains g_i instead of g at the node
 * (deviation D8). g_i is set to 0 at nodes without extinction and importance, which do not matter.
 * `importance`: grid.NodeCount() values in [0, 1]; the result likewise.
 */
std::vector<float> NodeImportanceOfFilled(
  const Grid& grid, const float* baseExtinction, const float* importance);

/// Computes the contributions of rows of nodes along x to the integral of importance times base
/// extinction, both trilinear, over the box of the nodes: all that can be seen. Contributions are
/// without the volume of a cell, for the range `slices`. The fields start at the first of the
/// slices `given`, which include one more slice on either side if there is one. `rows`:
/// grid.nodes.y * grid.nodes.z values, row by row [1/length].
void FillRowsOfImportantExtinction(const Grid& grid, const Range<int>& given,
  const Range<int>& slices, const float* baseExtinction, const float* importance, double* rows);

/// Returns the integral from the contributions of all rows [length^2]. It does not depend on the
/// number of threads.
double SumOfRows(const Grid& grid, const std::vector<double>& rows);

/// Called when rows of a slice are complete.
using MeanRows = std::function<void(int slice, const Range<int>& rows)>;

/// Writes NodeImportanceOfFilled into grid.NodeCount() zeros; zero results are not written. Calls
/// `done` for all rows: for slices concurrently, for the rows of one slice in order.
void FillNodeImportanceOfFilled(const Grid& grid, const float* baseExtinction,
  const float* importance, float* zeros, const MeanRows& done);
}

#endif
