// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "sweep/Plan.h"

#include "backend/Backend.h"
#include "sweep/HalfLayer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limpid
{
Interval Hull(const Interval& a, const Interval& b)
{
  if (a.Empty())
  {
    return b;
  }
  if (b.Empty())
  {
    return a;
  }
  return { std::min(a.begin, b.begin), std::max(a.end, b.end) };
}

Interval Intersection(const Interval& a, const Interval& b)
{
  return { std::max(a.begin, b.begin), std::min(a.end, b.end) };
}

Occupancy::Occupancy(
  const Grid& grid, const float* baseExtinction, const float* importance, bool skip)
  : Nodes(grid.nodes)
  , Skip(skip)
{
  const int nx = grid.nodes.x;
  const int ny = grid.nodes.y;
  const int nz = grid.nodes.z;
  this->AlongX.resize(std::size_t(ny) * nz);
  this->AlongY.resize(std::size_t(nx) * nz);
  std::vector<Index> filled(std::size_t(nz), 0);
  ParallelFor(nz,
    [&](Index z)
    {
      Spans* columns = this->AlongY.data() + z * nx;
      for (int y = 0; y < ny; ++y)
      {
        Spans& row = this->AlongX[std::size_t(z) * ny + y];
        const Index first = (z * ny + y) * nx;
        for (int x = 0; x < nx; ++x)
        {
          const bool important = importance[first + x] > 0;
          if (important || baseExtinction[first + x] > 0)
          {
            row.filled = Hull(row.filled, { x, x + 1 });
            columns[x].filled = Hull(columns[x].filled, { y, y + 1 });
            ++filled[std::size_t(z)];
          }
          if (important)
          {
            row.important = Hull(row.important, { x, x + 1 });
            columns[x].important = Hull(columns[x].important, { y, y + 1 });
          }
        }
      }
    });
  if (!skip)
  {
    std::fill(this->AlongX.begin(), this->AlongX.end(), Spans{ { 0, nx }, { 0, nx } });
    std::fill(this->AlongY.begin(), this->AlongY.end(), Spans{ { 0, ny }, { 0, ny } });
  }
  for (const Index count : filled)
  {
    this->Filled += count;
  }
}

float Pyramid::RayLength(int column, int row) const
{
  const Vec3 step(this->columnSlope[std::size_t(column)] * this->spacing.x,
    this->rowSlope[std::size_t(row)] * this->spacing.y, this->spacing.z);
  return static_cast<float>(glm::length(step));
}

Interval Pyramid::VoxelColumns(const Station& station, int v) const
{
  const auto row = std::size_t(station.voxelRows.index[std::size_t(v)]);
  const Interval rays = Hull(station.work[row], station.work[row + 1]);
  if (rays.Empty())
  {
    return {};
  }
  // Voxel u reads the rays index[u] and index[u] + 1, ascending in u.
  const std::vector<int>& index = station.voxelColumns.index;
  const auto begin = std::lower_bound(index.begin(), index.end(), rays.begin - 1);
  const auto end = std::lower_bound(index.begin(), index.end(), rays.end);
  return { static_cast<int>(begin - index.begin()), static_cast<int>(end - index.begin()) };
}

namespace
{
/// One lateral axis of a pyramid: position = offset(D) + ray * scale(D).
struct Lateral
{
  bool parallel = false;
  double eye = 0;   ///< point eye: its position [index]
  double shear = 0; ///< parallel eye: lateral step per slice [index]
  int nodes = 0;

  int count = 0;    ///< rays, guards included
  double first = 0; ///< ray coordinate of ray 0: slope or position
  double step = 0;  ///< ray coordinates between neighbours
  bool guardLow = false;
  bool guardHigh = false;

  double Position(double ray, double depth) const
  {
    return this->parallel ? ray + this->shear * depth : this->eye + ray * depth;
  }

  double Ray(double position, double depth) const
  {
    return this->parallel ? position - this->shear * depth : (position - this->eye) / depth;
  }

  double Coordinate(int ray) const { return this->first + ray * this->step; }

  double Slope(int ray) const { return this->parallel ? this->shear : this->Coordinate(ray); }

  /// Chooses the rays that see the box between two depths.
  void Fit(double nearDepth, double farDepth, double rayDensity)
  {
    const double last = this->nodes - 1;
    double low;
    double high;
    if (this->parallel)
    {
      low = std::min(-this->shear * nearDepth, -this->shear * farDepth);
      high = last + std::max(-this->shear * nearDepth, -this->shear * farDepth);
    }
    else
    {
      // Slopes to the box's faces: extreme at the near or at the far depth.
      const auto slope = [&](double distance, bool lowest)
      {
        const double atFar = distance / farDepth;
        if (nearDepth <= 0)
        {
          const double infinity = std::numeric_limits<double>::infinity();
          const double atNear = distance < 0 ? -infinity : (distance > 0 ? infinity : 0.0);
          return lowest ? std::min(atNear, atFar) : std::max(atNear, atFar);
        }
        const double atNear = distance / nearDepth;
        return lowest ? std::min(atNear, atFar) : std::max(atNear, atFar);
      };
      low = slope(-this->eye, true);
      high = slope(last - this->eye, false);
      this->guardLow = low < -1;
      this->guardHigh = high > 1;
      low = std::max(low, -1.0);
      high = std::min(high, 1.0);
    }
    if (!(high > low))
    {
      this->count = 0;
      return;
    }
    const double scale = this->parallel ? 1.0 : farDepth;
    const double wanted = std::ceil((high - low) * scale * rayDensity - 1e-9);
    const int cells = static_cast<int>(std::min(std::max(wanted, 2.0), 1e6));
    this->step = (high - low) / cells;
    this->first = low + 0.5 * this->step - (this->guardLow ? this->step : 0.0);
    this->count = cells + (this->guardLow ? 1 : 0) + (this->guardHigh ? 1 : 0);
  }

  /// Voxel column and weight of every ray at `depth`; on the border where it is outside the box.
  LinearMap RayMap(double depth) const
  {
    LinearMap map;
    map.index.resize(std::size_t(this->count));
    map.weight.resize(std::size_t(this->count));
    const double last = this->nodes - 1;
    for (int ray = 0; ray < this->count; ++ray)
    {
      const double position = this->Position(this->Coordinate(ray), depth);
      const double inside = std::min(std::max(position, 0.0), last);
      const int node = std::min(static_cast<int>(inside), this->nodes - 2);
      map.index[std::size_t(ray)] = node;
      map.weight[std::size_t(ray)] = static_cast<float>(inside - node);
    }
    return map;
  }

  /// Floor of the voxel column of every ray at `depth`, also outside the box.
  std::vector<int> RayNodes(double depth) const
  {
    std::vector<int> floors(std::size_t(this->count));
    const double last = this->nodes - 1;
    for (int ray = 0; ray < this->count; ++ray)
    {
      const double position = this->Position(this->Coordinate(ray), depth);
      floors[std::size_t(ray)] =
        static_cast<int>(std::floor(std::min(std::max(position, -3.0), last + 3.0)));
    }
    return floors;
  }

  /// Ray column and weight of every voxel on the slice at `depth`, a positive depth. Voxels beyond
  /// the outermost rays take the value of these.
  LinearMap VoxelMap(double depth) const
  {
    LinearMap map;
    map.index.resize(std::size_t(this->nodes));
    map.weight.resize(std::size_t(this->nodes));
    for (int node = 0; node < this->nodes; ++node)
    {
      const double position = (this->Ray(node, depth) - this->first) / this->step;
      const double inside = std::min(std::max(position, 0.0), double(this->count - 1));
      const int ray = std::max(0, std::min(static_cast<int>(inside), this->count - 2));
      map.index[std::size_t(node)] = ray;
      map.weight[std::size_t(node)] = static_cast<float>(inside - ray);
    }
    return map;
  }

  /// Depths at which a ray enters and leaves the slab of the box, relative to `base`.
  void Clip(int ray, double base, float& entry, float& exit) const
  {
    constexpr double never = 1e30;
    const double last = this->nodes - 1;
    const double slope = this->Slope(ray);
    const double start = this->parallel ? this->Coordinate(ray) : this->eye;
    double low = -never;
    double high = never;
    if (slope != 0)
    {
      const double atZero = (0 - start) / slope;
      const double atLast = (last - start) / slope;
      low = std::min(atZero, atLast) - base;
      high = std::max(atZero, atLast) - base;
    }
    else if (start < 0 || start > last)
    {
      low = never;
      high = -never;
    }
    entry = static_cast<float>(std::min(std::max(low, -never), never));
    exit = static_cast<float>(std::min(std::max(high, -never), never));
  }

  /// Voxels at `depth` whose distance from the eye is at most (closed) or below (open) the depth.
  Interval Owned(double depth, bool closed) const
  {
    if (this->parallel)
    {
      return { 0, this->nodes };
    }
    const auto owns = [&](int node)
    {
      const double distance = std::abs(node - this->eye);
      return closed ? distance <= depth : distance < depth;
    };
    const double last = this->nodes - 1;
    int begin = static_cast<int>(std::min(std::max(this->eye - depth - 1, 0.0), last + 1));
    int end = static_cast<int>(std::min(std::max(this->eye + depth + 2, 0.0), last + 1));
    while (begin < end && !owns(begin))
    {
      ++begin;
    }
    while (end > begin && !owns(end - 1))
    {
      --end;
    }
    return { begin, end };
  }
};

/// Rays that voxels in `voxels` are interpolated from, or that touch these voxels anywhere in the
/// layers on both sides of a slice, where no ray moves by more than one voxel. `nodes`: floor of
/// the rays' positions on the slice, ascending.
Interval RaysThatTouch(const Interval& voxels, const std::vector<int>& nodes)
{
  if (voxels.Empty())
  {
    return {};
  }
  const auto begin = std::lower_bound(nodes.begin(), nodes.end(), voxels.begin - 2);
  const auto end = std::upper_bound(nodes.begin(), nodes.end(), voxels.end);
  const int first = static_cast<int>(begin - nodes.begin()) - 1;
  const int last = static_cast<int>(end - nodes.begin()) + 1;
  return { std::max(0, first), std::min(static_cast<int>(nodes.size()), last) };
}

/// Finds what the rays of a pyramid have to visit, see Pyramid::Station.
class Visibility
{
public:
  Visibility(Pyramid& pyramid, const Occupancy& occupancy)
    : Target(pyramid)
    , Source(occupancy)
    , Rows(std::size_t(pyramid.rows))
  {
  }

  std::vector<std::vector<int>> columnNodes; ///< per station: floor of the rays' positions
  std::vector<std::vector<int>> rowNodes;

  void Plan()
  {
    const std::size_t count = this->Target.stations.size();
    std::vector<std::vector<Interval>> filled(count, std::vector<Interval>(this->Rows));
    std::vector<std::vector<Interval>> needed(count, std::vector<Interval>(this->Rows));
    ParallelFor(static_cast<Index>(count),
      [&](Index station)
      {
        this->FindOccupied(
          std::size_t(station), filled[std::size_t(station)], needed[std::size_t(station)]);
      });
    const Interval all{ 0, this->Target.columns };
    if (!this->Source.Skips())
    {
      for (std::vector<Interval>& rows : needed)
      {
        std::fill(rows.begin(), rows.end(), all);
      }
    }
    else
    {
      FollowToFront(needed);
      for (std::vector<Interval>& rows : needed)
      {
        rows = this->Widened(rows);
      }
      this->FollowToEntry(needed);
    }
    for (std::size_t s = 0; s < count; ++s)
    {
      Station& station = this->Target.stations[s];
      station.work.resize(this->Rows);
      for (std::size_t row = 0; row < this->Rows; ++row)
      {
        const Interval touched =
          s + 1 < count ? Hull(filled[s][row], filled[s + 1][row]) : filled[s][row];
        station.work[row] = Intersection(needed[s][row], touched);
      }
    }
  }

private:
  void FindOccupied(
    std::size_t s, std::vector<Interval>& filled, std::vector<Interval>& important) const
  {
    const Station& station = this->Target.stations[s];
    if (station.slice < 0)
    {
      // All rays start in the eye's cell; whatever it holds, the piece is short.
      std::fill(filled.begin(), filled.end(), Interval{ 0, this->Target.columns });
      return;
    }
    const std::vector<int>& nodes = this->rowNodes[s];
    const int rowCount = this->Target.rows;
    const int lastVoxel = this->Target.nodesV - 1;
    for (int row = 0; row < rowCount; ++row)
    {
      const int low = row > 0 ? nodes[std::size_t(row - 1)] - 1 : 0;
      const int high = row + 1 < rowCount ? nodes[std::size_t(row + 1)] + 2 : lastVoxel;
      Interval filledVoxels;
      Interval importantVoxels;
      for (int v = std::max(low, 0); v <= std::min(high, lastVoxel); ++v)
      {
        const Occupancy::Spans& spans = this->RowOfVoxels(v, station.slice);
        filledVoxels = Hull(filledVoxels, spans.filled);
        importantVoxels = Hull(importantVoxels, spans.important);
      }
      filled[std::size_t(row)] = RaysThatTouch(filledVoxels, this->columnNodes[s]);
      important[std::size_t(row)] = RaysThatTouch(importantVoxels, this->columnNodes[s]);
    }
  }

  const Occupancy::Spans& RowOfVoxels(int v, int w) const
  {
    return this->Target.axisV < this->Target.axisW ? this->Source.Row(this->Target.axisU, v, w)
                                                   : this->Source.Row(this->Target.axisU, w, v);
  }

  /// What is important on a slice is at stake on all slices in front of it.
  static void FollowToFront(std::vector<std::vector<Interval>>& needed)
  {
    for (std::size_t s = needed.size(); s-- > 1;)
    {
      for (std::size_t row = 0; row < needed[s].size(); ++row)
      {
        needed[s - 1][row] = Hull(needed[s - 1][row], needed[s][row]);
      }
    }
  }

  /// A ray that is needed before it has entered the box is needed until it has: its optical depth
  /// there is counted from the entry (Rows.h).
  void FollowToEntry(std::vector<std::vector<Interval>>& needed) const
  {
    for (std::size_t s = 0; s + 1 < needed.size(); ++s)
    {
      const float depth = this->Target.stations[s + 1].relativeDepth;
      for (std::size_t row = 0; row < this->Rows; ++row)
      {
        const Interval columns = needed[s][row];
        const auto outside = [&](int column)
        {
          return this->Target.columnEntry[std::size_t(column)] > depth ||
            this->Target.rowEntry[row] > depth;
        };
        for (int column = columns.begin; column < columns.end; ++column)
        {
          if (outside(column))
          {
            needed[s + 1][row] = Hull(needed[s + 1][row], { column, column + 1 });
          }
        }
      }
    }
  }

  /// One ray more on every side: voxels there read these rays, too.
  std::vector<Interval> Widened(const std::vector<Interval>& rows) const
  {
    std::vector<Interval> wider(rows.size());
    for (std::size_t row = 0; row < rows.size(); ++row)
    {
      Interval hull = rows[row];
      hull = row > 0 ? Hull(hull, rows[row - 1]) : hull;
      hull = row + 1 < rows.size() ? Hull(hull, rows[row + 1]) : hull;
      if (!hull.Empty())
      {
        hull = { std::max(hull.begin - 1, 0), std::min(hull.end + 1, this->Target.columns) };
      }
      wider[row] = hull;
    }
    return wider;
  }

  Pyramid& Target;
  const Occupancy& Source;
  std::size_t Rows;
};

/// Which rays of a pyramid the picture shows.
std::vector<float> FindInView(const Pyramid& pyramid, const Eye& eye, const Lateral& u,
  const Lateral& v, double sign, double originW)
{
  std::vector<float> inView;
  if (eye.frustum.empty())
  {
    return inView;
  }
  inView.resize(std::size_t(pyramid.RayCount()));
  for (int row = 0; row < pyramid.rows; ++row)
  {
    for (int column = 0; column < pyramid.columns; ++column)
    {
      Vec3 ray(0.0);
      ray[pyramid.axisU] = u.Coordinate(column);
      ray[pyramid.axisV] = v.Coordinate(row);
      ray[pyramid.axisW] = eye.parallel ? originW : sign;
      bool seen = true;
      for (const Eye::Plane& plane : eye.frustum)
      {
        seen = seen && glm::dot(plane.normal, ray) + plane.offset >= 0;
      }
      inView[std::size_t(row) * pyramid.columns + column] = seen ? 1.0f : 0.0f;
    }
  }
  return inView;
}

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

/// Columns that are inside the box in u all the way between two depths. They are neighbours, as
/// the rays' order along u never changes.
Interval InsideColumns(const Pyramid& pyramid, float front, float back)
{
  Interval inside;
  for (int column = 0; column < pyramid.columns; ++column)
  {
    const auto i = std::size_t(column);
    if (pyramid.columnEntry[i] <= front && pyramid.columnExit[i] >= back)
    {
      inside = Hull(inside, { column, column + 1 });
    }
  }
  return inside;
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

/// The pyramid about the eye that opens along +axis or -axis; without rays if it misses the grid.
Pyramid MakePyramid(const Grid& grid, const Occupancy& occupancy, const Eye& eye, int axisW,
  double sign, double rayDensity)
{
  Pyramid pyramid;
  ChooseAxes(pyramid, grid, axisW);
  const int nodesW = grid.nodes[axisW];

  // Depth of a node k: sign (k - e) for a point eye, counted from the first slice if parallel.
  const double eyeW = eye.parallel ? (sign > 0 ? 0.0 : nodesW - 1.0) : eye.origin[axisW];
  const auto depthOf = [&](int slice) { return sign * (slice - eyeW); };
  const int firstSlice = sign > 0 ? 0 : nodesW - 1;
  const int lastSlice = sign > 0 ? nodesW - 1 : 0;
  const double farDepth = depthOf(lastSlice);
  if (!(farDepth > 0))
  {
    return pyramid;
  }
  const double nearDepth = std::max(0.0, depthOf(firstSlice));

  Lateral u;
  Lateral v;
  for (Lateral* lateral : { &u, &v })
  {
    const int axis = lateral == &u ? pyramid.axisU : pyramid.axisV;
    lateral->parallel = eye.parallel;
    lateral->eye = eye.origin[axis];
    lateral->shear = eye.parallel ? eye.direction[axis] / std::abs(eye.direction[axisW]) : 0.0;
    lateral->nodes = grid.nodes[axis];
    lateral->Fit(nearDepth, farDepth, rayDensity);
  }
  if (u.count == 0 || v.count == 0)
  {
    return pyramid;
  }
  pyramid.columns = u.count;
  pyramid.rows = v.count;

  double base = 0;
  bool first = true;
  for (int slice = firstSlice; sign > 0 ? slice <= lastSlice : slice >= lastSlice;
       slice += sign > 0 ? 1 : -1)
  {
    const double depth = depthOf(slice);
    if (!eye.parallel && !(depth > 0))
    {
      continue;
    }
    if (first)
    {
      base = depth;
      first = false;
      if (!eye.parallel && slice != firstSlice)
      {
        Station nearStation; // the grid reaches to the eye's plane or behind it
        nearStation.depth = 0;
        nearStation.relativeDepth = static_cast<float>(-base);
        nearStation.scale = 0;
        pyramid.stations.push_back(nearStation);
      }
    }
    Station station;
    station.slice = slice;
    station.depth = depth;
    station.relativeDepth = static_cast<float>(depth - base);
    station.scale = eye.parallel ? 1.0f : static_cast<float>(depth / farDepth);
    pyramid.stations.push_back(station);
  }

  pyramid.columnEntry.resize(std::size_t(u.count));
  pyramid.columnExit.resize(std::size_t(u.count));
  pyramid.columnSlope.resize(std::size_t(u.count));
  pyramid.columnShare.assign(std::size_t(u.count), 1.0f);
  for (int i = 0; i < u.count; ++i)
  {
    const auto column = std::size_t(i);
    u.Clip(i, base, pyramid.columnEntry[column], pyramid.columnExit[column]);
    pyramid.columnSlope[column] = u.Slope(i);
  }
  pyramid.rowEntry.resize(std::size_t(v.count));
  pyramid.rowExit.resize(std::size_t(v.count));
  pyramid.rowSlope.resize(std::size_t(v.count));
  pyramid.rowShare.assign(std::size_t(v.count), 1.0f);
  for (int j = 0; j < v.count; ++j)
  {
    const auto row = std::size_t(j);
    v.Clip(j, base, pyramid.rowEntry[row], pyramid.rowExit[row]);
    pyramid.rowSlope[row] = v.Slope(j);
  }
  pyramid.columnShare.front() = u.guardLow ? 0.0f : 1.0f;
  pyramid.columnShare.back() = u.guardHigh ? 0.0f : 1.0f;
  pyramid.rowShare.front() = v.guardLow ? 0.0f : 1.0f;
  pyramid.rowShare.back() = v.guardHigh ? 0.0f : 1.0f;
  pyramid.cellMeasure =
    grid.CellVolume() * u.step * v.step * (eye.parallel ? 1.0 : farDepth * farDepth);

  // Which voxels on the boundary of two pyramids belong to which: the last axis wins.
  const bool closedU = pyramid.axisU < axisW;
  const bool closedV = pyramid.axisV < axisW;
  Visibility visibility(pyramid, occupancy);
  visibility.columnNodes.resize(pyramid.stations.size());
  visibility.rowNodes.resize(pyramid.stations.size());
  ParallelFor(static_cast<Index>(pyramid.stations.size()),
    [&](Index index)
    {
      const auto s = std::size_t(index);
      Station& station = pyramid.stations[s];
      if (s + 1 < pyramid.stations.size())
      {
        PlacePlanes(station, pyramid.stations[s + 1], sign, u, v);
      }
      if (station.slice < 0)
      {
        return;
      }
      visibility.columnNodes[s] = u.RayNodes(station.depth);
      visibility.rowNodes[s] = v.RayNodes(station.depth);
      station.voxelColumns = u.VoxelMap(station.depth);
      station.voxelRows = v.VoxelMap(station.depth);
      station.ownedColumns = u.Owned(station.depth, closedU);
      station.ownedRows = v.Owned(station.depth, closedV);
    });
  visibility.Plan();
  for (std::size_t s = 0; s + 1 < pyramid.stations.size(); ++s)
  {
    pyramid.stations[s].insideColumns = InsideColumns(
      pyramid, pyramid.stations[s].relativeDepth, pyramid.stations[s + 1].relativeDepth);
  }
  pyramid.inView = FindInView(pyramid, eye, u, v, sign, eyeW);
  return pyramid;
}
}

std::vector<Pyramid> PlanSweep(
  const Grid& grid, const Occupancy& occupancy, const Eye& eye, double rayDensity)
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
      Pyramid pyramid = MakePyramid(grid, occupancy, eye, axis, sign, rayDensity);
      if (pyramid.RayCount() > 0)
      {
        pyramids.push_back(std::move(pyramid));
      }
    }
  }
  return pyramids;
}
}
