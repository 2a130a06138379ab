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
Interval Pyramid::VoxelColumns(const Station& station, int v) const
{
  Interval rays;
  for (const int neighbour : { std::max(v - 1, 0), v, std::min(v + 1, this->nodesV - 1) })
  {
    const auto row = std::size_t(station.voxelRows.index[std::size_t(neighbour)]);
    rays = Hull(rays, Hull(station.work[row], station.work[row + 1]));
  }
  if (rays.Empty())
  {
    return {};
  }
  // A voxel is interpolated from two rays.
  const int begin = station.firstVoxels[std::size_t(std::max(rays.begin - 1, 0))];
  const int end = station.firstVoxels[std::size_t(rays.end)];
  return { std::max(begin - 1, 0), std::min(end + 1, this->nodesU) };
}

namespace
{
/// A slice closer to a point eye holds no voxel but the eye's own, and rays have no width there
/// [index].
constexpr double nearestSlice = 1e-6;

/// The depth axis of a pyramid: depth of a node k is sign (k - origin).
struct DepthAxis
{
  bool parallel = false;
  double sign = 1;
  double origin = 0; ///< point eye: its position; parallel: the first slice [index]
  int nodes = 0;

  double Of(int slice) const { return this->sign * (slice - this->origin); }
  double Far() const { return this->Of(this->sign > 0 ? this->nodes - 1 : 0); }
  double Near() const { return std::max(0.0, this->Of(this->sign > 0 ? 0 : this->nodes - 1)); }
};

/// Places the Gauss points of the layer between two stations. In front of the first slice behind
/// the eye the layer is a part of a cell.
void PlacePlanes(
  Station& front, const Station& back, double sign, const Lateral& u, const Lateral& v)
{
  const double thickness = back.depth - front.depth;
  for (int half = 0; half < 2; ++half)
  {
    Plane& plane = front.planes[std::size_t(half)];
    const double depth = front.depth + gaussPoints[half] * thickness;
    plane.slices[0] = back.slice - (sign > 0 ? 1 : -1);
    plane.slices[1] = back.slice;
    plane.fraction = static_cast<float>(1.0 - (back.depth - depth));
    plane.rayColumns = u.RayMap(depth);
    plane.rayRows = v.RayMap(depth);
  }
}

/// Columns along the first free axis; along x if possible, as rows of memory run along x.
void ChooseAxes(Pyramid& pyramid, const Grid& grid, int axisW)
{
  pyramid.axisW = axisW;
  pyramid.axisU = axisW == 0 ? 1 : 0;
  pyramid.axisV = axisW == 2 ? 1 : 2;
  pyramid.nodesU = grid.nodes[pyramid.axisU];
  pyramid.nodesV = grid.nodes[pyramid.axisV];
  pyramid.spacing =
    Vec3(grid.spacing[pyramid.axisU], grid.spacing[pyramid.axisV], grid.spacing[axisW]);
}

/// Lays the stations of a pyramid through the slices in front of the eye. Returns the depth of the
/// first slice.
double PlaceStations(Pyramid& pyramid, const DepthAxis& depth)
{
  double base = -1;
  for (int k = 0; k < depth.nodes; ++k)
  {
    const int slice = depth.sign > 0 ? k : depth.nodes - 1 - k;
    Station station;
    station.slice = slice;
    station.depth = depth.Of(slice);
    if (!depth.parallel && !(station.depth > nearestSlice))
    {
      continue;
    }
    if (pyramid.stations.empty())
    {
      base = station.depth;
      if (k > 0)
      {
        Station eye; // the grid reaches to the eye's plane or behind it
        eye.depth = 0;
        eye.relativeDepth = static_cast<float>(-base);
        eye.scale = 0;
        pyramid.stations.push_back(eye);
      }
    }
    station.relativeDepth = static_cast<float>(station.depth - base);
    station.scale = depth.parallel ? 1.0f : static_cast<float>(station.depth / depth.Far());
    pyramid.stations.push_back(station);
  }
  return base;
}

/// What is known of the rays along one lateral axis. A guard that does not enter the slab of the
/// box before `back` runs along its border all the way. `scale`: width of a unit of the rays'
/// coordinate at the far depth [index].
void DescribeRays(const Lateral& lateral, double base, float back, double scale, RayAxis& axis)
{
  constexpr Clip everywhere{ -1e30f, 1e30f };
  const auto count = static_cast<std::size_t>(lateral.count);
  for (std::size_t ray = 0; ray < count; ++ray)
  {
    axis.share.push_back(static_cast<float>(lateral.Width(static_cast<int>(ray)) * scale));
    Clip clip = lateral.ClipOf(static_cast<int>(ray), base);
    const bool misses = clip.entry >= back || clip.exit <= 0 || clip.entry >= clip.exit;
    clip = misses && axis.share[ray] == 0 ? everywhere : clip;
    axis.entry.push_back(clip.entry);
    axis.exit.push_back(clip.exit);
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
void PlaceMaps(Pyramid& pyramid, double sign, double base, const Lateral& u, const Lateral& v)
{
  // Which voxels on the boundary of two pyramids belong to which: the last axis wins.
  const bool closedU = pyramid.axisU < pyramid.axisW;
  const bool closedV = pyramid.axisV < pyramid.axisW;
  ParallelFor(pyramid.LastStation() + 1,
    [&](Index index)
    {
      Station& station = pyramid.stations[std::size_t(index)];
      if (index < pyramid.LastStation())
      {
        const Station& back = pyramid.stations[std::size_t(index) + 1];
        PlacePlanes(station, back, sign, u, v);
        station.insideColumns = InsideColumns(pyramid, station.relativeDepth, back.relativeDepth);
      }
      if (station.slice >= 0)
      {
        station.voxelColumns = u.VoxelMap(station.depth);
        station.voxelRows = v.VoxelMap(station.depth);
        station.firstVoxels = FirstTargets(station.voxelColumns, pyramid.columns);
        station.columnSides = SideWeights(u, station.voxelColumns, station.depth);
        station.rowSides = SideWeights(v, station.voxelRows, station.depth);
        station.columnEntry = u.VoxelEntries(station.depth, base);
        station.rowEntry = v.VoxelEntries(station.depth, base);
        station.ownedColumns = u.Owned(station.depth, closedU);
        station.ownedRows = v.Owned(station.depth, closedV);
      }
    });
}

/// The pyramid about the eye that opens along +axis or -axis; without rays if it misses the grid.
Pyramid MakePyramid(const Grid& grid, const Occupancy& occupancy, const Eye& eye, int axisW,
  double sign, double rayDensity, Placement placement)
{
  Pyramid pyramid;
  ChooseAxes(pyramid, grid, axisW);
  DepthAxis depth;
  depth.parallel = eye.parallel;
  depth.sign = sign;
  depth.nodes = grid.nodes[axisW];
  depth.origin = eye.parallel ? (sign > 0 ? 0.0 : depth.nodes - 1.0) : eye.origin[axisW];
  if (!(depth.Far() > nearestSlice))
  {
    return pyramid;
  }
  Lateral laterals[2];
  for (int side = 0; side < 2; ++side)
  {
    const int axis = side == 0 ? pyramid.axisU : pyramid.axisV;
    Lateral& lateral = laterals[side];
    lateral.parallel = eye.parallel;
    lateral.eye = eye.origin[axis];
    lateral.shear = eye.parallel ? eye.direction[axis] / std::abs(eye.direction[axisW]) : 0.0;
    lateral.nodes = grid.nodes[axis];
    lateral.Fit(depth.Near(), depth.Far(), rayDensity, placement);
    if (lateral.count == 0)
    {
      return pyramid;
    }
  }
  pyramid.lateralU = laterals[0];
  pyramid.lateralV = laterals[1];
  const Lateral& u = pyramid.lateralU;
  const Lateral& v = pyramid.lateralV;
  pyramid.columns = u.count;
  pyramid.rows = v.count;
  pyramid.cellMeasure = grid.CellVolume();
  const double scale = eye.parallel ? 1.0 : depth.Far();
  const double base = PlaceStations(pyramid, depth);
  const float back = pyramid.stations.back().relativeDepth;
  DescribeRays(u, base, back, scale, pyramid.columnAxis);
  DescribeRays(v, base, back, scale, pyramid.rowAxis);
  pyramid.frontColumns = RaysEnteredBy(pyramid.columnAxis, pyramid.FrontDepth());
  pyramid.frontRows = RaysEnteredBy(pyramid.rowAxis, pyramid.FrontDepth());
  PlaceMaps(pyramid, sign, base, u, v);
  FindWork(pyramid, occupancy);
  pyramid.inView = FindInView(pyramid, eye, eye.parallel ? depth.origin : sign);
  return pyramid;
}
}

Interval RaysEnteredBy(const RayAxis& axis, float depth)
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

SpanRows SpansOf(const Pyramid& pyramid, const Occupancy& occupancy, int slice)
{
  // Rows along x lie [z][y], those along y [z][x].
  const bool neighbours = pyramid.axisV < pyramid.axisW;
  const int first = neighbours ? 0 : slice;
  const int second = neighbours ? slice : 0;
  return { &occupancy.Row(pyramid.axisU, first, second),
    neighbours ? 1 : occupancy.RowStride(pyramid.axisU) };
}

std::vector<Pyramid> PlanSweep(const Grid& grid, const Occupancy& occupancy, const Eye& eye,
  double rayDensity, Placement placement, const std::array<bool, 3>& depthAxes)
{
  std::vector<Pyramid> pyramids;
  if (!grid.HasVolume())
  {
    return pyramids;
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
        if (!pyramids.empty() || !steepest || eye.direction[axis] * sign <= 0)
        {
          continue;
        }
      }
      Pyramid pyramid = MakePyramid(grid, occupancy, eye, axis, sign, rayDensity, placement);
      if (pyramid.RayCount() > 0)
      {
        pyramids.push_back(std::move(pyramid));
      }
    }
  }
  // A policy sweep gains most if the largest comes last, see MetNextIterate.
  std::stable_sort(pyramids.begin(), pyramids.end(),
    [](const Pyramid& one, const Pyramid& other)
    {
      return Index(one.RayCount()) * one.LastStation() <
        Index(other.RayCount()) * other.LastStation();
    });
  return pyramids;
}
}
