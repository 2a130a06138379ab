// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/Plan.h"

#include "backend/Backend.h"
#include "sweep/HalfLayer.h"
#include "sweep/RayGeometry.h"
#include "sweep/RayMeans.h"
#include "sweep/Work.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
Range<int> FaceFrustum::VoxelColumns(const Slice& slice, int v) const
{
  Range<int> rays;
  for (const int neighbour : { std::max(v - 1, 0), v, std::min(v + 1, this->nodesV - 1) })
  {
    const auto row = std::size_t(slice.voxelRows.index[std::size_t(neighbour)]);
    rays = Hull(rays, Hull(slice.work[row], slice.work[row + 1]));
  }
  if (rays.Empty())
  {
    return {};
  }
  // A voxel is interpolated from two rays.
  const int begin = slice.firstVoxels[std::size_t(std::max(rays.begin - 1, 0))];
  const int end = slice.firstVoxels[std::size_t(rays.end)];
  return { std::max(begin - 1, 0), std::min(end + 1, this->nodesU) };
}

namespace
{
/// A slice closer to a point eye holds no voxel but the eye's own, and rays have no width there
/// [index].
constexpr double nearestSlice = 1e-6;

/// The depth axis of a frustum: depth of a node k is sign (k - origin).
struct DepthAxis
{
  bool parallel = false;
  double sign = 1;
  double origin = 0; ///< point eye: its position; parallel: the first slice [index]
  int nodes = 0;

  double Of(int node) const { return this->sign * (node - this->origin); }
  double Far() const { return this->Of(this->sign > 0 ? this->nodes - 1 : 0); }
  double Near() const { return std::max(0.0, this->Of(this->sign > 0 ? 0 : this->nodes - 1)); }
};

/// Places the Gauss points of the layer between two slices. In front of the first slice behind
/// the eye the layer is a part of a cell.
void PlacePlanes(Slice& front, const Slice& back, double sign, const Lateral& u, const Lateral& v)
{
  const double thickness = back.depth - front.depth;
  for (int half = 0; half < 2; ++half)
  {
    Plane& plane = front.planes[std::size_t(half)];
    const double depth = front.depth + gaussPoints[half] * thickness;
    plane.nodes[0] = back.node - (sign > 0 ? 1 : -1);
    plane.nodes[1] = back.node;
    plane.fraction = static_cast<float>(1.0 - (back.depth - depth));
    plane.rayColumns = u.RayMap(depth);
    plane.rayRows = v.RayMap(depth);
  }
}

/// Columns along the first free axis; along x if possible, as rows of memory run along x.
void ChooseAxes(FaceFrustum& frustum, const Grid& grid, int axisW)
{
  frustum.axisW = axisW;
  frustum.axisU = axisW == 0 ? 1 : 0;
  frustum.axisV = axisW == 2 ? 1 : 2;
  frustum.nodesU = grid.nodes[frustum.axisU];
  frustum.nodesV = grid.nodes[frustum.axisV];
  frustum.spacing =
    Vec3(grid.spacing[frustum.axisU], grid.spacing[frustum.axisV], grid.spacing[axisW]);
}

/// Lays the slices of a frustum through the slices in front of the eye. Returns the depth of the
/// first slice.
double PlaceSlices(FaceFrustum& frustum, const DepthAxis& depth)
{
  double base = -1;
  for (int k = 0; k < depth.nodes; ++k)
  {
    const int node = depth.sign > 0 ? k : depth.nodes - 1 - k;
    Slice slice;
    slice.node = node;
    slice.depth = depth.Of(node);
    if (!depth.parallel && !(slice.depth > nearestSlice))
    {
      continue;
    }
    if (frustum.slices.empty())
    {
      base = slice.depth;
      if (k > 0)
      {
        Slice eye; // the grid reaches to the eye's plane or behind it
        eye.depth = 0;
        eye.relativeDepth = static_cast<float>(-base);
        eye.scale = 0;
        frustum.slices.push_back(eye);
      }
    }
    slice.relativeDepth = static_cast<float>(slice.depth - base);
    slice.scale = depth.parallel ? 1.0f : static_cast<float>(slice.depth / depth.Far());
    frustum.slices.push_back(slice);
  }
  return base;
}

/// What is known of the rays along one lateral axis. A guard that does not enter the slab of the
/// box before `back` runs along its border all the way. `scale`: width of a unit of the rays'
/// coordinate at the far depth [index].
void DescribeRays(const Lateral& lateral, double base, float back, double scale, RayAxis& axis)
{
  constexpr Range<float> everywhere{ -1e30f, 1e30f };
  const auto count = static_cast<std::size_t>(lateral.count);
  for (std::size_t ray = 0; ray < count; ++ray)
  {
    axis.share.push_back(static_cast<float>(lateral.Width(static_cast<int>(ray)) * scale));
    Range<float> clip = lateral.ClipOf(static_cast<int>(ray), base);
    const bool misses = clip.begin >= back || clip.end <= 0 || clip.begin >= clip.end;
    clip = misses && axis.share[ray] == 0 ? everywhere : clip;
    axis.entry.push_back(clip.begin);
    axis.exit.push_back(clip.end);
    axis.slope.push_back(lateral.Slope(static_cast<int>(ray)));
  }
}

/// Per ray, and one more: the first target whose first source it is, or a later one.
std::vector<int> FirstTargets(const LinearMap& map, int sources)
{
  std::vector<int> first;
  first.reserve(std::size_t(sources) + 1);
  int target = 0;
  const int targets = static_cast<int>(map.index.size());
  for (int source = 0; source <= sources; ++source)
  {
    while (target < targets && map.index[std::size_t(target)] < source)
    {
      ++target;
    }
    first.push_back(target);
  }
  return first;
}

/// How rays and voxels of every slice read each other.
void PlaceMaps(FaceFrustum& frustum, double sign, double base, const Lateral& u, const Lateral& v)
{
  // Which voxels on the boundary of two frusta belong to which: the last axis wins.
  const bool closedU = frustum.axisU < frustum.axisW;
  const bool closedV = frustum.axisV < frustum.axisW;
  ParallelFor(frustum.LastSlice() + 1,
    [&](Index index)
    {
      Slice& slice = frustum.slices[std::size_t(index)];
      if (index < frustum.LastSlice())
      {
        const Slice& back = frustum.slices[std::size_t(index) + 1];
        PlacePlanes(slice, back, sign, u, v);
        slice.insideColumns = InsideColumns(frustum, slice.relativeDepth, back.relativeDepth);
      }
      if (slice.node >= 0)
      {
        slice.voxelColumns = u.VoxelMap(slice.depth);
        slice.voxelRows = v.VoxelMap(slice.depth);
        slice.firstVoxels = FirstTargets(slice.voxelColumns, frustum.columns);
        slice.columnSides = SideWeights(u, slice.voxelColumns, slice.depth);
        slice.rowSides = SideWeights(v, slice.voxelRows, slice.depth);
        slice.columnEntry = u.VoxelEntries(slice.depth, base);
        slice.rowEntry = v.VoxelEntries(slice.depth, base);
        slice.ownedColumns = u.Owned(slice.depth, closedU);
        slice.ownedRows = v.Owned(slice.depth, closedV);
      }
    });
}

/// The frustum about the eye that opens along +axis or -axis; without rays if it misses the grid.
FaceFrustum MakeFrustum(const Grid& grid, const Occupancy& occupancy, const RaySource& eye,
  int axisW, double sign, double rayDensity, Placement placement)
{
  FaceFrustum frustum;
  ChooseAxes(frustum, grid, axisW);
  DepthAxis depth;
  depth.parallel = eye.parallel;
  depth.sign = sign;
  depth.nodes = grid.nodes[axisW];
  depth.origin = eye.parallel ? (sign > 0 ? 0.0 : depth.nodes - 1.0) : eye.origin[axisW];
  if (!(depth.Far() > nearestSlice))
  {
    return frustum;
  }
  Lateral laterals[2];
  for (int side = 0; side < 2; ++side)
  {
    const int axis = side == 0 ? frustum.axisU : frustum.axisV;
    Lateral& lateral = laterals[side];
    lateral.parallel = eye.parallel;
    lateral.eye = eye.origin[axis];
    lateral.shear = eye.parallel ? eye.direction[axis] / std::abs(eye.direction[axisW]) : 0.0;
    lateral.nodes = grid.nodes[axis];
    lateral.Fit(depth.Near(), depth.Far(), rayDensity, placement);
    if (lateral.count == 0)
    {
      return frustum;
    }
  }
  frustum.lateralU = laterals[0];
  frustum.lateralV = laterals[1];
  const Lateral& u = frustum.lateralU;
  const Lateral& v = frustum.lateralV;
  frustum.columns = u.count;
  frustum.rows = v.count;
  frustum.cellMeasure = grid.CellVolume();
  const double scale = eye.parallel ? 1.0 : depth.Far();
  const double base = PlaceSlices(frustum, depth);
  const float back = frustum.slices.back().relativeDepth;
  DescribeRays(u, base, back, scale, frustum.columnAxis);
  DescribeRays(v, base, back, scale, frustum.rowAxis);
  frustum.frontColumns = RaysEnteredBy(frustum.columnAxis, frustum.FrontDepth());
  frustum.frontRows = RaysEnteredBy(frustum.rowAxis, frustum.FrontDepth());
  PlaceMaps(frustum, sign, base, u, v);
  FindWork(frustum, occupancy);
  frustum.inView = FindInView(frustum, eye, eye.parallel ? depth.origin : sign);
  return frustum;
}
}

Range<int> RaysEnteredBy(const RayAxis& axis, float depth)
{
  int begin = 1;
  int end = axis.Count() - 1;
  while (begin < end && axis.entry[std::size_t(begin)] > depth)
  {
    ++begin;
  }
  while (begin < end && axis.entry[std::size_t(end) - 1] > depth)
  {
    --end;
  }
  return { begin, end };
}

SpanRows SpansOf(const FaceFrustum& frustum, const Occupancy& occupancy, int node)
{
  // Rows along x lie [z][y], those along y [z][x].
  const bool neighbours = frustum.axisV < frustum.axisW;
  const int first = neighbours ? 0 : node;
  const int second = neighbours ? node : 0;
  return { &occupancy.Row(frustum.axisU, first, second),
    neighbours ? 1 : occupancy.RowStride(frustum.axisU) };
}

std::vector<FaceFrustum> PlanSweep(const Grid& grid, const Occupancy& occupancy,
  const RaySource& eye, double rayDensity, Placement placement,
  const std::array<bool, 3>& depthAxes)
{
  std::vector<FaceFrustum> frusta;
  if (!grid.HasVolume())
  {
    return frusta;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double sign : { 1.0, -1.0 })
    {
      if (!depthAxes[std::size_t(axis)])
      {
        continue;
      }
      if (eye.parallel)
      {
        const Vec3 size = glm::abs(eye.direction);
        const bool steepest =
          size[axis] >= size[(axis + 1) % 3] && size[axis] >= size[(axis + 2) % 3];
        if (!frusta.empty() || !steepest || eye.direction[axis] * sign <= 0)
        {
          continue;
        }
      }
      FaceFrustum frustum = MakeFrustum(grid, occupancy, eye, axis, sign, rayDensity, placement);
      if (frustum.RayCount() > 0)
      {
        frusta.push_back(std::move(frustum));
      }
    }
  }
  // A policy sweep gains most if the largest comes last, see MetNextIterate.
  std::stable_sort(frusta.begin(), frusta.end(),
    [](const FaceFrustum& one, const FaceFrustum& other) {
      return Index(one.RayCount()) * one.LastSlice() < Index(other.RayCount()) * other.LastSlice();
    });
  return frusta;
}
}
