// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/PlanOutline.h"

#include "backend/PhysicalMemory.h"
#include "math/Require.h"
#include "sweep/RayWindows.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace limpid
{
namespace
{
/// The depth axis of a frustum: the depth of node k is sign (k - origin).
struct DepthAxis
{
  bool parallel = false;
  double sign = 1;
  double origin = 0; ///< position of a point source, or the first slice of a parallel one [index]
  int nodes = 0;

  double Of(int node) const { return this->sign * (node - this->origin); }
  double Far() const { return this->Of(this->sign > 0 ? this->nodes - 1 : 0); }
  double Near() const { return std::max(0.0, this->Of(this->sign > 0 ? 0 : this->nodes - 1)); }
};

/// Chooses the first free axis for columns; along x if possible, as rows in memory run along x.
void ChooseAxes(PlannedFrustum& frustum, const Grid& grid, int axisW)
{
  const Index strides[3] = { 1, grid.nodes.x, Index(grid.nodes.x) * grid.nodes.y };
  frustum.axisW = axisW;
  frustum.axisU = axisW == 0 ? 1 : 0;
  frustum.axisV = axisW == 2 ? 1 : 2;
  frustum.nodesU = grid.nodes[frustum.axisU];
  frustum.nodesV = grid.nodes[frustum.axisV];
  frustum.strideU = strides[frustum.axisU];
  frustum.strideV = strides[frustum.axisV];
  frustum.strideW = strides[axisW];
  frustum.spacing =
    Vec3(grid.spacing[frustum.axisU], grid.spacing[frustum.axisV], grid.spacing[axisW]);
  frustum.cellMeasure = grid.CellVolume();
}

/// Returns the slices in front of the source, front to back, with the layers behind them. If the
/// grid extends to the plane of the source or behind it, that plane is the first slice.
std::vector<Slice> PlaceSlices(const DepthAxis& depth)
{
  std::vector<Slice> slices;
  for (int k = 0; k < depth.nodes; ++k)
  {
    Slice slice;
    slice.node = depth.sign > 0 ? k : depth.nodes - 1 - k;
    slice.depth = depth.Of(slice.node);
    slice.scale = depth.parallel ? 1.0f : static_cast<float>(slice.depth / depth.Far());
    if (!depth.parallel && !(slice.depth > nearestSlice))
    {
      continue;
    }
    if (slices.empty() && k > 0)
    {
      Slice source;
      source.scale = 0;
      slices.push_back(source);
    }
    slices.push_back(slice);
  }
  const double base = slices[slices.front().node < 0 ? 1 : 0].depth;
  for (Slice& slice : slices)
  {
    slice.layer.front = static_cast<float>(slice.depth - base);
  }
  // The layer in front of the first slice behind the source is a part of a cell.
  for (std::size_t s = 0; s + 1 < slices.size(); ++s)
  {
    Slice& front = slices[s];
    const Slice& back = slices[s + 1];
    front.layer = { front.layer.front, back.layer.front - front.layer.front, front.scale,
      back.scale };
    front.nodes[0] = back.node - (depth.sign > 0 ? 1 : -1);
    front.nodes[1] = back.node;
    for (int half = 0; half < 2; ++half)
    {
      const double at = front.depth + gaussPoints[half] * (back.depth - front.depth);
      front.fractions[half] = static_cast<float>(1.0 - (back.depth - at));
    }
  }
  for (std::size_t s = 0; s < slices.size(); ++s)
  {
    const float inFront = s > 0 ? slices[s - 1].layer.thickness : 0.0f;
    const float behind = slices[s].layer.thickness; // a hat extends over at most one node
    const auto share = [](float way) { return way - 0.5f * way * way; };
    slices[s].hatGain = 1.0f / (share(inFront) + share(behind));
  }
  return slices;
}

/// Lays out the tables, first those of the outline. Fills those of windows.
void MakeTables(
  PlannedFrustum& frustum, const RayWindows& windows, const RaySource& source, Readers readers)
{
  const Index count = frustum.SliceCount();
  TableRoom room;
  room.Add(frustum.slices, 1, frustum.SliceCount());
  room.Add(frustum.rowColumns, 1, frustum.rows);
  room.Add(frustum.rowLayers, 1, frustum.rows);
  room.Add(frustum.blockLayers, 1, (frustum.rows + rowsPerBlock - 1) / rowsPerBlock);
  room.Add(frustum.rowStarts, 1, windows.banded ? frustum.rows : 0);
  room.Add(frustum.columnLines, 1, frustum.columns);
  room.Add(frustum.rowLines, 1, frustum.rows);
  for (Table<float>* table : { &frustum.columnEntry, &frustum.columnExit, &frustum.columnShare })
  {
    room.Add(*table, 1, frustum.columns);
  }
  for (Table<float>* table : { &frustum.rowEntry, &frustum.rowExit, &frustum.rowShare })
  {
    room.Add(*table, 1, frustum.rows);
  }
  room.Add(frustum.columnCoordinates, 1, frustum.columns);
  room.Add(frustum.rowCoordinates, 1, frustum.rows);
  room.Add(frustum.viewPlanes, 1, static_cast<int>(source.viewPlanes.size()));
  frustum.outlineBytes = room.Bytes();
  room.Add(frustum.planeColumns, 2 * count, windows.mostColumns);
  room.Add(frustum.planeRows, 2 * count, windows.mostRows);
  room.Add(frustum.activeRays, count, windows.mostRows);
  room.Add(frustum.length, 1, frustum.rayCount);
  room.Add(frustum.inView, 1, frustum.seesAll ? 0 : frustum.rayCount);
  if (readers == Readers::RaysAndVoxels)
  {
    room.Add(frustum.voxelColumns, count, frustum.nodesU);
    room.Add(frustum.voxelRows, count, frustum.nodesV);
    room.Add(frustum.columnSides, count, frustum.nodesU);
    room.Add(frustum.rowSides, count, frustum.nodesV);
    room.Add(frustum.columnHatGain, count, frustum.nodesU);
    room.Add(frustum.rowHatGain, count, frustum.nodesV);
    room.Add(frustum.voxelColumnEntry, count, frustum.nodesU);
    room.Add(frustum.voxelRowEntry, count, frustum.nodesV);
    room.Add(frustum.firstVoxels, count, windows.mostColumns + 1);
    room.Add(frustum.activeVoxels, count, frustum.nodesV);
    room.Add(frustum.filledVoxels, count, frustum.nodesV);
  }
  room.Give(frustum);
  std::copy(windows.rowColumns.begin(), windows.rowColumns.end(), frustum.Room(frustum.rowColumns));
  std::copy(windows.rowLayers.begin(), windows.rowLayers.end(), frustum.Room(frustum.rowLayers));
  std::copy(source.viewPlanes.begin(), source.viewPlanes.end(), frustum.Room(frustum.viewPlanes));
  for (int row = 0; row < frustum.rows; ++row)
  {
    Range<int>& layers = frustum.Room(frustum.blockLayers)[row / rowsPerBlock];
    layers = Hull(layers, frustum.LayersOf(row));
  }
  int before = 0;
  for (int row = 0; windows.banded && row < frustum.rows; ++row)
  {
    const Range<int>& columns = windows.rowColumns[std::size_t(row)];
    frustum.Room(frustum.rowStarts)[row] = before - columns.begin;
    before += columns.Length();
  }
}

/// Fills the tables of the rays along one axis. A guard ray that stays outside the box up to
/// `back` reads the border for as long as its neighbour is inside. `scale`: width of a unit of the
/// ray coordinate at the far depth [index].
void DescribeRays(const Lateral& lateral, double base, float back, double scale, RayLine* lines,
  float* entry, float* exit, float* share)
{
  for (int ray = 0; ray < lateral.count; ++ray)
  {
    lines[ray] = { lateral.Position(lateral.Coordinate(ray), base), lateral.Slope(ray) };
    share[ray] = static_cast<float>(lateral.Width(ray) * scale);
    const Range<float> stay = lateral.StayOf(ray, base);
    entry[ray] = stay.begin;
    exit[ray] = stay.end;
  }
  const int last = lateral.count - 1;
  for (const auto& [guard, inner] : { std::pair{ 0, 1 }, std::pair{ last, last - 1 } })
  {
    if (entry[guard] >= back || exit[guard] <= 0 || entry[guard] >= exit[guard])
    {
      entry[guard] = entry[inner];
      exit[guard] = exit[inner];
    }
  }
}

/// Chooses the rays of a frustum along u and v. Returns whether there are any.
bool PlaceLaterals(PlannedFrustum& frustum, const Grid& grid, const RaySource& source,
  const DepthAxis& depth, const PlanSettings& settings)
{
  for (Lateral* lateral : { &frustum.lateralU, &frustum.lateralV })
  {
    const int axis = lateral == &frustum.lateralU ? frustum.axisU : frustum.axisV;
    lateral->parallel = source.parallel;
    lateral->eye = source.origin[axis];
    lateral->shear =
      source.parallel ? source.direction[axis] / std::abs(source.direction[frustum.axisW]) : 0.0;
    lateral->nodes = grid.nodes[axis];
    const double layers = depth.Far() - depth.Near();
    lateral->Fit(depth.Near(), depth.Far(),
      IsLong(grid.nodes) ? std::max({ grid.nodes.x, grid.nodes.y, grid.nodes.z }) - 1.0 : layers,
      settings.rayDensity, settings.placement);
    if (lateral->count == 0)
    {
      return false;
    }
  }
  frustum.columns = frustum.lateralU.count;
  frustum.rows = frustum.lateralV.count;
  return true;
}

/// Throws if the rays would not fit into the machine's memory: the system might grant the memory
/// and later end the process.
void RequireMemory(const RayWindows& windows, const Grid& grid, std::size_t slices)
{
  constexpr double bytesOfRay = 100;  // RayStates, its length and whether it is in view
  constexpr double bytesOfPlace = 24; // of a row or a column on a slice
  constexpr double gigabyte = 1 << 30;
  constexpr double most = 0.25; // of all memory: camera, light and scores have rays of their own
  const double rays = windows.rays;
  const double bytes = bytesOfRay * rays +
    bytesOfPlace * double(slices) * (double(windows.mostColumns) + windows.mostRows);
  LIMPID_REQUIRE(bytes < most * PhysicalMemory(),
    "From this position, an image of "
      << grid.nodes.x << " x " << grid.nodes.y << " x " << grid.nodes.z << " points needs " << rays
      << " rays (they would take " << bytes / gigabyte << " GiB of memory; this machine has "
      << PhysicalMemory() / gigabyte
      << " GiB). Lower the ray density, or resample the image to fewer points.");
}

/// Finds the voxels that the frustum owns on each slice, and the columns that are outside the box.
void FinishSlices(PlannedFrustum& frustum)
{
  // Voxels on the boundary of two frusta belong to the frustum of the last axis.
  const bool closedU = frustum.axisU < frustum.axisW;
  const bool closedV = frustum.axisV < frustum.axisW;
  const float* entry = frustum.Row(frustum.columnEntry);
  Range<int> outside{ 0, frustum.columns };
  for (int s = 0; s < frustum.SliceCount(); ++s)
  {
    Slice& slice = frustum.Room(frustum.slices)[s];
    const auto inside = [&](int column) { return !(entry[column] > slice.RelativeDepth()); };
    while (!outside.Empty() && inside(outside.begin))
    {
      ++outside.begin;
    }
    while (!outside.Empty() && inside(outside.end - 1))
    {
      --outside.end;
    }
    slice.outsideColumns = outside;
    if (slice.node >= 0)
    {
      slice.ownedColumns = frustum.lateralU.Owned(slice.depth, closedU);
      slice.ownedRows = frustum.lateralV.Owned(slice.depth, closedV);
    }
  }
}

/// Makes the outline of the frustum around the source that opens along +axis or -axis. It has no
/// rays if it misses the grid.
PlannedFrustum OutlineFrustum(
  const Grid& grid, const RaySource& source, int axisW, double sign, const PlanSettings& settings)
{
  PlannedFrustum frustum;
  ChooseAxes(frustum, grid, axisW);
  DepthAxis depth;
  depth.parallel = source.parallel;
  depth.sign = sign;
  depth.nodes = grid.nodes[axisW];
  depth.origin = source.parallel ? (sign > 0 ? 0.0 : depth.nodes - 1.0) : source.origin[axisW];
  if (!(depth.Far() > nearestSlice) || !PlaceLaterals(frustum, grid, source, depth, settings))
  {
    return frustum;
  }
  std::vector<Slice> slices = PlaceSlices(depth);
  const RayWindows windows(frustum, grid.nodes, settings, slices);
  RequireMemory(windows, grid, slices.size());
  frustum.rayCount = static_cast<int>(windows.rays);
  frustum.banded = windows.banded;
  frustum.lastSlice = static_cast<int>(slices.size()) - 1;
  frustum.firstNodeSlice = slices.front().node < 0 ? 1 : 0;
  frustum.frontDepth = slices.front().RelativeDepth();
  frustum.seesAll = source.viewPlanes.empty();
  frustum.viewDepth = source.parallel ? depth.origin : sign;
  MakeTables(frustum, windows, source, settings.readers);
  std::copy(slices.begin(), slices.end(), frustum.Room(frustum.slices));

  const double scale = source.parallel ? 1.0 : depth.Far();
  const float back = slices.back().RelativeDepth();
  DescribeRays(frustum.lateralU, frustum.BaseDepth(), back, scale,
    frustum.Room(frustum.columnLines), frustum.Room(frustum.columnEntry),
    frustum.Room(frustum.columnExit), frustum.Room(frustum.columnShare));
  DescribeRays(frustum.lateralV, frustum.BaseDepth(), back, scale, frustum.Room(frustum.rowLines),
    frustum.Room(frustum.rowEntry), frustum.Room(frustum.rowExit), frustum.Room(frustum.rowShare));
  const auto copy = [](const std::vector<double>& coordinates, double* to)
  { std::copy(coordinates.begin(), coordinates.end(), to); };
  copy(frustum.lateralU.Coordinates(), frustum.Room(frustum.columnCoordinates));
  copy(frustum.lateralV.Coordinates(), frustum.Room(frustum.rowCoordinates));
  frustum.frontColumns =
    RaysEnteredBy(frustum.Row(frustum.columnEntry), { 1, frustum.columns - 1 }, frustum.frontDepth);
  frustum.frontRows =
    RaysEnteredBy(frustum.Row(frustum.rowEntry), { 1, frustum.rows - 1 }, frustum.frontDepth);
  FinishSlices(frustum);
  return frustum;
}

/// Decides between two axes along which parallel rays advance equally. The choice depends on the
/// scene and not on the numbering of axes, so results do not depend on the order of the nodes.
bool ComesBefore(const Grid& grid, int axis, int other)
{
  const auto place = [&grid](int of)
  {
    const Vec3 world = glm::abs(grid.direction[of]);
    return std::make_tuple(grid.nodes[of], world.x, world.y, world.z);
  };
  return place(axis) > place(other);
}

/// Returns the axis along which parallel rays advance most.
int DepthAxisOf(const Grid& grid, const RaySource& source)
{
  constexpr double rounding = 1e-12;
  const Vec3 size = glm::abs(source.direction);
  int found = 0;
  for (const int axis : { 1, 2 })
  {
    const bool alike = std::abs(size[axis] - size[found]) <= rounding * size[found];
    const bool taken = alike ? ComesBefore(grid, axis, found) : size[axis] > size[found];
    found = taken ? axis : found;
  }
  return found;
}
}

Range<int> RaysEnteredBy(const float* entries, const Range<int>& among, float depth)
{
  int begin = among.begin;
  int end = among.end;
  while (begin < end && entries[begin] > depth)
  {
    ++begin;
  }
  while (begin < end && entries[end - 1] > depth)
  {
    --end;
  }
  return { begin, end };
}

std::vector<PlannedFrustum> OutlineSweep(
  const Grid& grid, const RaySource& source, const PlanSettings& settings)
{
  std::vector<PlannedFrustum> frusta;
  if (!grid.HasVolume())
  {
    return frusta;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double sign : { 1.0, -1.0 })
    {
      const bool seen = !source.parallel ||
        (axis == DepthAxisOf(grid, source) && source.direction[axis] * sign > 0);
      const bool wanted = seen && settings.depthAxes[std::size_t(axis)];
      if (!wanted)
      {
        continue;
      }
      PlannedFrustum frustum = OutlineFrustum(grid, source, axis, sign, settings);
      if (frustum.RayCount() > 0)
      {
        frusta.push_back(std::move(frustum));
      }
    }
  }
  // A policy sweep gains most if the largest frustum comes last, see MetNextIterate.
  std::stable_sort(frusta.begin(), frusta.end(),
    [](const FaceFrustum& one, const FaceFrustum& other)
    {
      const auto size = [](const FaceFrustum& frustum)
      { return double(frustum.columns) * frustum.rows * frustum.lastSlice; };
      return size(one) < size(other);
    });
  return frusta;
}
}
