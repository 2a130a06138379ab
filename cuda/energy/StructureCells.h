// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Which structures the cells of a row and the rays through them are in, several columns per vector
// register. Structures are the numbers of LedgerRays.

#ifndef limpid_energy_StructureCells_h
#define limpid_energy_StructureCells_h

#include "sweep/FaceFrustum.h"

namespace limpid
{
/// Sets `differs` to 1 where two rows of nodes differ.
void MarkDifferences(const float* row, const float* other, const Range<int>& nodes, float* differs);

/// Finds the structure of the nodes of each cell, LedgerRays::several if they differ. `row`: one
/// row of nodes; `differs`: whether others differ from it.
void FindStructuresOfCells(
  const float* row, const float* differs, const Range<int>& cells, float* inCell);

/// Finds the structure that each ray is in between two depths, in which it moves by at most one
/// cell.
void FindStructures(const RayLine* lines, const Range<int>& columns, const Range<double>& depths,
  const float* inCell, int nodes, float* in);
}

#endif
