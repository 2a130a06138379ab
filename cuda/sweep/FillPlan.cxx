// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/FillPlan.h"

#include "backend/Backend.h"
#include "sweep/ActiveSpans.h"
#include "sweep/RayGeometry.h"
#include "sweep/VoxelSpans.h"

namespace limpid
{
namespace
{
/// Computes the tables of the voxels along an axis on a slice that need the map to rays.
template <class About>
void DescribeVoxels(const RayAxis& axis, const LinearMap& voxels, const Slice& slice,
  const RayLine* lines, const float* shares, const About& about, float* sides, float* gains)
{
  const Range<double> covered = axis.CoveredAt(slice.depth);
  for (int k = 0; k < axis.nodes; ++k)
  {
    sides[k] = axis.SideOf(voxels, k, slice.depth);
    gains[k] = axis.HatGainOf(k, slice, covered, about, lines, shares);
  }
}

/// Computes the maps from rays to voxels for the layer behind a slice.
void PlaceRays(PlannedFrustum& frustum, int s)
{
  Slice& slice = frustum.Room(frustum.slices)[s];
  const Slice& back = frustum.SliceAt(s + 1);
  for (int half = 0; half < 2; ++half)
  {
    const double depth = slice.depth + gaussPoints[half] * (back.depth - slice.depth);
    const Index row = 2 * Index(s) + half;
    frustum.lateralU.FindRayMap(depth, slice.rayColumns,
      frustum.Room(frustum.planeColumns.index, row),
      frustum.Room(frustum.planeColumns.weight, row));
    frustum.lateralV.FindRayMap(depth, slice.rayRows, frustum.Room(frustum.planeRows.index, row),
      frustum.Room(frustum.planeRows.weight, row));
  }
  slice.insideColumns =
    InsideColumns(frustum, slice.rayColumns, slice.RelativeDepth(), back.RelativeDepth());
}

/// Computes the maps from voxels of a slice to rays.
void PlaceVoxels(PlannedFrustum& frustum, int s)
{
  const Slice& slice = frustum.SliceAt(s);
  const double depth = slice.depth;
  const Lateral& u = frustum.lateralU;
  const Lateral& v = frustum.lateralV;
  u.FindVoxelMap(depth, slice.rayColumns.begin, frustum.Room(frustum.voxelColumns.index, s),
    frustum.Room(frustum.voxelColumns.weight, s));
  v.FindVoxelMap(depth, slice.rayRows.begin, frustum.Room(frustum.voxelRows.index, s),
    frustum.Room(frustum.voxelRows.weight, s));
  FindFirstTargets(frustum.Row(frustum.voxelColumns, s).index, frustum.nodesU, slice.rayColumns,
    frustum.Room(frustum.firstVoxels, s));
  DescribeVoxels(
    u.Axis(), frustum.Row(frustum.voxelColumns, s), slice, frustum.Row(frustum.columnLines),
    frustum.Row(frustum.columnShare),
    [&frustum, s](int k) { return frustum.AllColumnsAbout(s, k); },
    frustum.Room(frustum.columnSides, s), frustum.Room(frustum.columnHatGain, s));
  DescribeVoxels(
    v.Axis(), frustum.Row(frustum.voxelRows, s), slice, frustum.Row(frustum.rowLines),
    frustum.Row(frustum.rowShare), [&frustum, s](int k) { return frustum.AllRowsAbout(s, k); },
    frustum.Room(frustum.rowSides, s), frustum.Room(frustum.rowHatGain, s));
  u.FindVoxelEntries(depth, frustum.BaseDepth(), frustum.Room(frustum.voxelColumnEntry, s));
  v.FindVoxelEntries(depth, frustum.BaseDepth(), frustum.Room(frustum.voxelRowEntry, s));
}

/// Finds the voxels of each slice that may change, and those of them that active rays reach.
void FindVoxelSpans(PlannedFrustum& frustum, const Occupancy& occupancy)
{
  ParallelFor(frustum.SliceCount(),
    [&](Index index)
    {
      const int s = static_cast<int>(index);
      const Slice& slice = frustum.SliceAt(s);
      if (slice.node < 0)
      {
        return;
      }
      const SpanRows spans = SpansOf(frustum, occupancy.Along(frustum.axisU), slice.node);
      for (int v = slice.ownedRows.begin; v < slice.ownedRows.end; ++v)
      {
        const Range<int> filled = FilledColumnsOf(slice, spans, v);
        frustum.Room(frustum.filledVoxels, s)[v] = filled;
        frustum.Room(frustum.activeVoxels, s)[v] = ActiveColumnsOf(frustum, s, v, filled);
      }
    });
}
}

void FillPlan(PlannedFrustum& frustum, const Occupancy& occupancy)
{
  FindRayLengths(frustum);
  ParallelFor(frustum.SliceCount(),
    [&frustum](Index index)
    {
      const int s = static_cast<int>(index);
      if (s < frustum.lastSlice)
      {
        PlaceRays(frustum, s);
      }
      if (frustum.HasVoxels() && frustum.SliceAt(s).node >= 0)
      {
        PlaceVoxels(frustum, s);
      }
    });
  FindActiveSpans(frustum, occupancy);
  if (frustum.HasVoxels())
  {
    FindVoxelSpans(frustum, occupancy);
  }
  if (!frustum.seesAll)
  {
    FindInView(frustum);
  }
}
}
