// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/OccupiedRays.h"

#include "backend/Backend.h"
#include "backend/Simd.h"
#include "sweep/VoxelSpans.h"

#include <algorithm>

namespace limpid
{
namespace
{
/// Number of rows of voxels in front of the first and behind the last that rays may refer to, see
/// Lateral::FindRayNodes.
constexpr int rowsBefore = 4;
constexpr int rowsBehind = 8;

/// Replaces each row by the hull of itself and the next three. `rows`: `count` + 3 rows.
LIMPID_MULTIVERSION
void JoinFours(int count, Reach* rows)
{
  int* values = rows->least;
  for (int i = 0; i < 4 * count; ++i)
  {
    const int first = values[i + 4] < values[i] ? values[i + 4] : values[i];
    const int second = values[i + 12] < values[i + 8] ? values[i + 12] : values[i + 8];
    values[i] = second < first ? second : first;
  }
}

/// Returns the hull of some rows of voxels, at least four. `fours`: see JoinFours.
LIMPID_INLINE Reach HullOf(const Reach* fours, const Range<int>& rows)
{
  const int last = rows.end - 4;
  Reach hull = fours[last];
  for (int v = rows.begin; v < last; v += 4)
  {
    hull.Include(fours[v]);
  }
  return hull;
}

/// Finds the spans of rows of rays, see RowsTouchedBy. `nodes`: floors of the rows' positions, by
/// row; `rows`: number of all rows; `some`: the rows to visit; `lastVoxel`: last row of voxels.
LIMPID_MULTIVERSION
void FindReaches(const Reach* fours, const int* nodes, int rows, const Range<int>& some,
  int lastVoxel, const ColumnSpans& filled, const ColumnSpans& important)
{
  const Range<int> visited = some;
  for (int row = visited.begin; row < visited.end; ++row)
  {
    const Reach hull = HullOf(fours,
      RowsTouchedBy(
        row, rows, [nodes](int ray) { return nodes[ray]; }, lastVoxel));
    filled.begins[row] = hull.least[0];
    filled.ends[row] = -hull.least[1];
    important.begins[row] = hull.least[2];
    important.ends[row] = -hull.least[3];
  }
}
}

/// Scratch memory for the spans of one slice.
struct OccupiedRays::Memory
{
  explicit Memory(const PlannedFrustum& frustum)
    : columnsUpTo(std::size_t(frustum.nodesU) + 6)
    , reaches(std::size_t(frustum.nodesV) + rowsBefore + rowsBehind)
  {
  }

  Range<int> columns;           ///< Slice::rayColumns
  std::vector<int> columnNodes; ///< floors of the rays' positions
  std::vector<int> rowNodes;    ///< also of the rays beside those of the slice
  std::vector<int> columnsUpTo; ///< per voxel column, from -3 on: rays with floors up to it
  std::vector<Reach> reaches;   ///< per voxel row, from -rowsBefore on

  void CountColumns()
  {
    std::fill(this->columnsUpTo.begin(), this->columnsUpTo.end(), 0);
    for (std::size_t ray = 0; ray < this->columnNodes.size(); ++ray)
    {
      const int next = this->columnNodes[ray] + 3;
      this->columnsUpTo[std::size_t(next)] = this->columns.begin + static_cast<int>(ray) + 1;
    }
    int most = this->columns.begin;
    for (int& count : this->columnsUpTo)
    {
      most = std::max(most, count);
      count = most;
    }
  }

  /// Stores the first and the negative last column of the rays around a span of voxels. Their
  /// floors lie between two voxels before the span and one behind it; one ray is added on either
  /// side.
  void Put(const Range<int>& voxels, int* least) const
  {
    if (!voxels.Empty())
    {
      least[0] = std::max(this->columnsUpTo[std::size_t(voxels.begin)] - 1, this->columns.begin);
      least[1] = -std::min(this->columnsUpTo[std::size_t(voxels.end) + 3] + 1, this->columns.end);
    }
  }
};

OccupiedRays::OccupiedRays(const PlannedFrustum& frustum, const Occupancy& occupancy)
  : Plan(frustum)
  , Spans(new int[std::size_t(TouchingRays::CountFor(frustum))])
{
  constexpr int slicesPerTask = 8;
  const int slices = frustum.SliceCount();
  ParallelFor((slices + slicesPerTask - 1) / slicesPerTask,
    [&](Index task)
    {
      Memory memory(frustum);
      const int begin = static_cast<int>(task) * slicesPerTask;
      for (int slice = begin; slice < std::min(begin + slicesPerTask, slices); ++slice)
      {
        this->FindOnSlice(frustum, occupancy, slice, memory);
      }
    });
}

/// There are no voxels in the plane of an eye inside the grid. Rays there are interpolated from
/// the slice behind the eye.
void OccupiedRays::FindOnSlice(
  const PlannedFrustum& frustum, const Occupancy& occupancy, int s, Memory& memory)
{
  const Slice& slice = frustum.SliceAt(s);
  memory.columns = slice.rayColumns;
  memory.columnNodes.resize(std::size_t(memory.columns.Length()));
  frustum.lateralU.FindRayNodes(slice.depth, memory.columns, memory.columnNodes.data());
  const Range<int> rows = Grown(slice.rayRows, 1, frustum.rows);
  memory.rowNodes.resize(std::size_t(rows.Length()));
  frustum.lateralV.FindRayNodes(slice.depth, rows, memory.rowNodes.data());
  memory.CountColumns();
  const SpanRows spans =
    SpansOf(frustum, occupancy.Along(frustum.axisU), slice.node < 0 ? slice.nodes[0] : slice.node);
  std::fill(memory.reaches.begin(), memory.reaches.end(), outOfReach);
  Reach* reaches = memory.reaches.data() + rowsBefore;
  for (int v = 0; v < frustum.nodesV; ++v)
  {
    memory.Put(spans[v].filled, reaches[v].least);
    memory.Put(spans[v].important, reaches[v].least + 2);
  }
  JoinFours(static_cast<int>(memory.reaches.size()) - 3, memory.reaches.data());
  FindReaches(reaches, memory.rowNodes.data() - rows.begin, frustum.rows, slice.rayRows,
    frustum.nodesV - 1, this->Filled(s), this->Important(s));
}
}
