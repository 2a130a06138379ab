// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "energy/StructureCells.h"

#include "backend/Simd.h"
#include "energy/LedgerRays.h"

namespace limpid
{
LIMPID_MULTIVERSION
void MarkDifferences(const float* __restrict row, const float* __restrict other,
  const Range<int>& nodes, float* __restrict differs)
{
  for (int u = nodes.begin; u < nodes.end; ++u)
  {
    differs[u] = row[u] != other[u] ? 1.0f : differs[u];
  }
}

LIMPID_MULTIVERSION
void FindStructuresOfCells(const float* __restrict row, const float* __restrict differs,
  const Range<int>& cells, float* __restrict inCell)
{
  for (int u = cells.begin; u < cells.end; ++u)
  {
    const float either = differs[u] + differs[u + 1];
    const bool isOne = row[u] == row[u + 1] && either == 0.0f;
    inCell[u] = isOne ? row[u] : LedgerRays::several;
  }
}

LIMPID_MULTIVERSION
void FindStructures(const RayLine* __restrict lines, const Range<int>& columns,
  const Range<double>& depths, const float* __restrict inCell, int nodes, float* __restrict in)
{
  const Range<double> between = depths;
  for (int i = columns.begin; i < columns.end; ++i)
  {
    const float first = inCell[NodesAt(lines[i].At(between.begin), nodes).first];
    const float last = inCell[NodesAt(lines[i].At(between.end), nodes).first];
    in[i] = first == last ? first : LedgerRays::several;
  }
}
}
