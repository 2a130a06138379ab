// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The voxels of a frustum that can change, row by row.

#ifndef limpid_sweep_VoxelSpans_h
#define limpid_sweep_VoxelSpans_h

#include "scene/Occupancy.h"
#include "sweep/FaceFrustum.h"
#include "sweep/Registers.h"

namespace limpid
{
/// The spans of all rows of voxels on one slice of a frustum.
struct SpanRows
{
  Occupancy::Rows rows;
  int node;        ///< node index of the slice along the depth axis
  bool depthFirst; ///< whether the depth axis is the lower one of the axes across the rows

  LIMPID_HD LIMPID_INLINE const Occupancy::Spans& operator[](int v) const
  {
    return this->depthFirst ? this->rows.At(this->node, v) : this->rows.At(v, this->node);
  }
};

/// `rows`: those along frustum.axisU; `node`: see SpanRows.
LIMPID_HD LIMPID_INLINE SpanRows SpansOf(
  const FaceFrustum& frustum, const Occupancy::Rows& rows, int node)
{
  return { rows, node, frustum.axisW < frustum.axisV };
}

/// Returns the columns of voxel row `v` that the frustum owns and that may change.
LIMPID_HD LIMPID_INLINE Range<int> FilledColumnsOf(const Slice& slice, const SpanRows& spans, int v)
{
  return WholeRegisters(Intersection(slice.ownedColumns, spans[v].filled), slice.ownedColumns);
}

/// Returns the columns of voxel row `v` that rays can matter to: voxels around a ray that is
/// active in a layer next to the slice (VoxelRow::FindSeen, FindEffect). `filled`: those that may
/// change.
LIMPID_HD LIMPID_INLINE Range<int> ActiveColumnsOf(
  const FaceFrustum& frustum, int s, int v, const Range<int>& filled)
{
  const Range<int> about = frustum.RowsAbout(s, v);
  const int front = s > 0 ? s - 1 : 0;
  Range<int> rays;
  for (int row = about.begin; row < about.end; ++row)
  {
    rays = Hull(rays, Hull(frustum.ActiveRays(front, row), frustum.ActiveRays(s, row)));
  }
  if (rays.Empty())
  {
    return {};
  }
  // A voxel is interpolated from two rays.
  const Range<int> reached{ frustum.FirstVoxel(s, rays.begin - 1) - 1,
    frustum.FirstVoxel(s, rays.end) + 1 };
  return WholeRegisters(
    Intersection(Intersection(reached, Range<int>{ 0, frustum.nodesU }), filled), filled);
}
}

#endif
