// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled for each device that copies, see CompiledDevice.h.

#include "sweep/PlanOnDevice.h"

#include "backend/CompiledDevice.h"
#include "sweep/ColumnSpans.h"
#include "sweep/RayFormulas.h"
#include "sweep/SliceReaders.h"
#include "sweep/VoxelSpans.h"

#include <memory>
#include <vector>

namespace limpid
{
namespace
{
using FrustumInMaking = WritableTables<FaceFrustum>;

constexpr const char* label = "plan";
constexpr const char* what = "the plan of a sweep";

/// The spans of an occupancy in the memory of a device.
template <class AnyDevice>
struct OccupancyOn
{
  OccupancyOn(const std::shared_ptr<AnyDevice>& device, const Occupancy& occupancy)
    : where(device)
  {
    for (const int axis : { 0, 1 })
    {
      const std::vector<Occupancy::Spans>& spans = occupancy.AllAlong(axis);
      this->Memory[axis] = { device, spans, what };
      this->along[axis] = occupancy.Along(axis);
      this->along[axis].spans = this->Memory[axis].Data();
    }
  }

  std::shared_ptr<AnyDevice> where;
  Occupancy::Rows along[2]; ///< per axis

private:
  DeviceArray<AnyDevice, Occupancy::Spans> Memory[2];
};

/// Returns the first of some numbers, or the end, for which a condition that stays true is true.
template <class Condition>
LIMPID_HD LIMPID_INLINE int FirstOf(const Range<int>& numbers, const Condition& isTrue)
{
  Range<int> left = numbers;
  while (!left.Empty())
  {
    const int middle = left.begin + (left.end - left.begin) / 2;
    if (isTrue(middle))
    {
      left.end = middle;
    }
    else
    {
      left.begin = middle + 1;
    }
  }
  return left.begin;
}

/// The tables of one lateral axis.
struct AxisInMaking
{
  FrustumInMaking frustum;
  RayAxis rays;
  bool ofColumns;
  double base; ///< depth of the first slice of voxels
  MapTable planes;
  MapTable voxels;
  Table<float> sides;
  Table<float> hatGain;
  Table<float> entries;
  Table<RayLine> lines;
  Table<float> shares;

  LIMPID_HD LIMPID_INLINE Range<int> DescribedOn(int s) const
  {
    const Slice& slice = this->frustum.SliceAt(s);
    return this->ofColumns ? slice.rayColumns : slice.rayRows;
  }
};

AxisInMaking ColumnsOf(const PlannedFrustum& outline, const FrustumInMaking& tables)
{
  return { tables, outline.lateralU.Axis(tables.Row(outline.columnCoordinates)), true,
    outline.BaseDepth(), outline.planeColumns, outline.voxelColumns, outline.columnSides,
    outline.columnHatGain, outline.voxelColumnEntry, outline.columnLines, outline.columnShare };
}

AxisInMaking RowsOf(const PlannedFrustum& outline, const FrustumInMaking& tables)
{
  return { tables, outline.lateralV.Axis(tables.Row(outline.rowCoordinates)), false,
    outline.BaseDepth(), outline.planeRows, outline.voxelRows, outline.rowSides, outline.rowHatGain,
    outline.voxelRowEntry, outline.rowLines, outline.rowShare };
}

/// Makes FaceFrustum::planeColumns or planeRows.
struct MadePlaneMaps
{
  AxisInMaking axis;

  LIMPID_HD void operator()(int number, int plane) const
  {
    const int s = plane / 2;
    const Range<int> described = this->axis.DescribedOn(s);
    if (number >= described.Length())
    {
      return;
    }
    const double front = this->axis.frustum.SliceAt(s).depth;
    constexpr double first = gaussPoints[0]; // CUDA reads no array of the host
    constexpr double second = gaussPoints[1];
    const double depth =
      front + (plane % 2 == 0 ? first : second) * (this->axis.frustum.SliceAt(s + 1).depth - front);
    const NodePair nodes = this->axis.rays.NodesOf(described.begin + number, depth);
    this->axis.frustum.Room(this->axis.planes.index, plane)[number] = nodes.first;
    this->axis.frustum.Room(this->axis.planes.weight, plane)[number] = nodes.weight;
  }
};

/// Makes the map from voxels to rays, and what depends on a voxel's own rays.
struct MadeVoxelMaps
{
  AxisInMaking axis;

  LIMPID_HD void operator()(int voxel, int s) const
  {
    const Slice& slice = this->axis.frustum.SliceAt(s);
    if (slice.node < 0)
    {
      return;
    }
    const RayAxis& rays = this->axis.rays;
    const double wanted = rays.CoordinateThrough(voxel, slice.depth);
    const int ray = this->RayBefore(wanted, s);
    this->axis.frustum.Room(this->axis.voxels.index, s)[voxel] = ray;
    this->axis.frustum.Room(this->axis.voxels.weight, s)[voxel] =
      RayAxis::WeightBetween(rays.coordinates[ray], rays.coordinates[ray + 1], wanted);
    this->axis.frustum.Room(this->axis.sides, s)[voxel] =
      rays.SideOf(this->axis.frustum.Row(this->axis.voxels, s), voxel, slice.depth);
    this->axis.frustum.Room(this->axis.entries, s)[voxel] =
      rays.StayAt(wanted, this->axis.base).begin;
  }

private:
  /// Returns the last ray, but one, that is not behind a coordinate.
  LIMPID_HD LIMPID_INLINE int RayBefore(double wanted, int s) const
  {
    const Range<int> others{ this->axis.DescribedOn(s).begin + 1, this->axis.rays.count - 1 };
    return FirstOf(others, [&](int ray) { return this->axis.rays.coordinates[ray] > wanted; }) - 1;
  }
};

/// Makes FaceFrustum::columnHatGain or rowHatGain, of the maps to rays.
struct MadeHatGains
{
  AxisInMaking axis;

  LIMPID_HD void operator()(int voxel, int s) const
  {
    const FrustumInMaking& frustum = this->axis.frustum;
    const Slice& slice = frustum.SliceAt(s);
    if (slice.node < 0)
    {
      return;
    }
    const auto about = [&](int k)
    { return this->axis.ofColumns ? frustum.AllColumnsAbout(s, k) : frustum.AllRowsAbout(s, k); };
    frustum.Room(this->axis.hatGain, s)[voxel] =
      this->axis.rays.HatGainOf(voxel, slice, this->axis.rays.CoveredAt(slice.depth), about,
        frustum.Row(this->axis.lines), frustum.Row(this->axis.shares));
  }
};

/// Makes FaceFrustum::firstVoxels, or the same for rows: see FindFirstTargets.
struct MadeFirstVoxels
{
  AxisInMaking axis;
  int* first;
  int rowLength;

  LIMPID_HD void operator()(int number, int s) const
  {
    const Range<int> described = this->axis.DescribedOn(s);
    if (this->axis.frustum.SliceAt(s).node < 0 || number > described.Length())
    {
      return;
    }
    const int* index = this->axis.frustum.Row(this->axis.voxels, s).index;
    this->first[Index(s) * this->rowLength + number] =
      FirstOf(Range<int>{ 0, this->axis.rays.nodes },
        [&](int voxel) { return index[voxel] >= described.begin + number; });
  }
};

/// Makes FaceFrustum::length and inView.
struct MadeRays
{
  FrustumInMaking frustum;
  RayAxis columns;
  RayAxis rows;
  Vec3 spacing;
  Table<RaySource::Plane> planes; ///< of the view
  double viewDepth;

  LIMPID_HD void operator()(int column, int row) const
  {
    const int ray = this->frustum.RayAt(column, row);
    this->frustum.Room(this->frustum.length)[ray] =
      RowLength(this->spacing, this->rows.Slope(row)).Of(this->columns.Slope(column));
    if (!this->frustum.seesAll)
    {
      this->frustum.Room(this->frustum.inView)[ray] = this->IsInView(column, row) ? 1.0f : 0.0f;
    }
  }

private:
  LIMPID_HD LIMPID_INLINE bool IsInView(int column, int row) const
  {
    bool isIn = true;
    for (int plane = 0; plane < this->planes.rowLength; ++plane)
    {
      isIn = isIn &&
        RowPlane(this->frustum.Row(this->planes)[plane], this->frustum, this->rows.coordinates[row],
          this->viewDepth)
          .HasInFront(this->columns.coordinates[column]);
    }
    return isIn;
  }
};

/// Finds the columns of rays that touch a row of voxels.
struct MadeReaches
{
  FaceFrustum frustum;
  RayAxis columns;
  Occupancy::Rows occupied;
  Reach* reaches; ///< [slice][voxel row]

  LIMPID_HD void operator()(int v, int s) const
  {
    const Slice& slice = this->frustum.SliceAt(s);
    // Rays in the plane of an eye are interpolated from the slice behind it.
    const SpanRows rows =
      SpansOf(this->frustum, this->occupied, slice.node < 0 ? slice.nodes[0] : slice.node);
    const Range<int> filled = this->ColumnsAround(rows[v].filled, slice);
    const Range<int> important = this->ColumnsAround(rows[v].important, slice);
    this->reaches[Index(s) * this->frustum.nodesV + v] = { { filled.begin, -filled.end,
      important.begin, -important.end } };
  }

private:
  /// Returns the columns of the rays around a span of voxels. Their floors lie between two voxels
  /// before the span and one behind it; one ray is added on either side.
  LIMPID_HD LIMPID_INLINE Range<int> ColumnsAround(
    const Range<int>& voxels, const Slice& slice) const
  {
    return voxels.Empty() ? Range<int>{ noColumn, -noColumn }
                          : Intersection(Range<int>{ this->ColumnsUpTo(voxels.begin - 3, slice) - 1,
                                           this->ColumnsUpTo(voxels.end, slice) + 1 },
                              slice.rayColumns);
  }

  /// Returns the end of the columns that the slice describes and whose floors are not behind a
  /// voxel.
  LIMPID_HD LIMPID_INLINE int ColumnsUpTo(int voxel, const Slice& slice) const
  {
    return FirstOf(slice.rayColumns,
      [&](int column) { return this->columns.FloorOf(column, slice.depth) > voxel; });
  }
};

/// Finds the columns of rays of a row that touch any row of voxels around it, see
/// OccupiedRays::FindOnSlice.
struct MadeTouchingRays
{
  FaceFrustum frustum;
  RayAxis rows;
  const Reach* reaches; ///< [slice][voxel row]
  TouchingRays touching;

  LIMPID_HD void operator()(int number, int s) const
  {
    const Slice& slice = this->frustum.SliceAt(s);
    if (number >= slice.rayRows.Length())
    {
      return;
    }
    const int row = slice.rayRows.begin + number;
    const Range<int> voxels = RowsTouchedBy(
      row, this->frustum.rows, [&](int ray) { return this->rows.FloorOf(ray, slice.depth); },
      this->frustum.nodesV - 1);
    Reach hull = outOfReach;
    for (int v = voxels.begin > 0 ? voxels.begin : 0; v < voxels.end && v < this->frustum.nodesV;
         ++v)
    {
      hull.Include(this->reaches[Index(s) * this->frustum.nodesV + v]);
    }
    this->touching.Filled(this->frustum, s).Put(row, { hull.least[0], -hull.least[1] });
    this->touching.Important(this->frustum, s).Put(row, { hull.least[2], -hull.least[3] });
  }
};

/// The tables of the rays that are visited; the steps are those of ActiveSpans.cxx.
struct ActiveInMaking
{
  FrustumInMaking frustum;
  TouchingRays touching;
  const int* firstRows; ///< [slice][row of Slice::rayRows]; null: no voxels read the rays
  bool skips;

  LIMPID_HD LIMPID_INLINE const Range<int>& LayersOf(int row) const
  {
    return this->frustum.LayersOfBlock(row / rowsPerBlock);
  }

  LIMPID_HD LIMPID_INLINE bool IsDescribed(int s, int row) const
  {
    return this->frustum.SliceAt(s).rayRows.Contains(row);
  }

  LIMPID_HD LIMPID_INLINE Range<int>& At(int s, int row) const
  {
    return this->frustum.Room(
      this->frustum.activeRays, s)[row - this->frustum.SliceAt(s).rayRows.begin];
  }
};

/// Extends the important span of a row of rays on each slice by those of all slices behind it.
struct FollowedToFront
{
  ActiveInMaking made;

  LIMPID_HD void operator()(Index index) const
  {
    const int row = static_cast<int>(index);
    const FaceFrustum& frustum = this->made.frustum;
    const Range<int>& layers = this->made.LayersOf(row);
    for (int s = layers.end - 2; s >= layers.begin; --s)
    {
      if (this->made.IsDescribed(s, row) && this->made.IsDescribed(s + 1, row))
      {
        const ColumnSpans here = this->made.touching.Important(frustum, s);
        here.Put(row, Hull(here.At(row), this->made.touching.Important(frustum, s + 1).At(row)));
      }
    }
  }
};

/// Finds the columns of a row that are needed behind a slice, and those read together with them.
struct NeededRays
{
  ActiveInMaking made;

  LIMPID_HD void operator()(int number, int s) const
  {
    const FaceFrustum& frustum = this->made.frustum;
    const Slice& slice = frustum.SliceAt(s);
    const int row = slice.rayRows.begin + number;
    if (!slice.rayRows.Contains(row) || !this->made.LayersOf(row).Contains(s))
    {
      return;
    }
    if (!this->made.skips)
    {
      this->made.At(s, row) = slice.rayColumns;
      return;
    }
    const ColumnSpans needed = this->made.touching.Important(frustum, s);
    Range<int> active = needed.At(row);
    if (this->made.firstRows && slice.node >= 0)
    {
      const int* first = this->made.firstRows + Index(s) * (frustum.activeRays.rowLength + 1);
      active = Hull(active, SliceReaders(frustum, s, first, needed).ReadWithNeeded(row));
    }
    this->made.At(s, row) = active;
  }
};

/// Finds the active columns of a row of rays on all slices, of NeededRays.
struct ActiveRow
{
  ActiveInMaking made;

  LIMPID_HD void operator()(Index index) const
  {
    const int row = static_cast<int>(index);
    if (this->made.skips)
    {
      this->FollowToFront(row);
    }
    this->FollowToBack(row);
  }

private:
  /// Rays that are active on a slice stay active on all slices in front of it.
  LIMPID_HD LIMPID_INLINE void FollowToFront(int row) const
  {
    const Range<int>& layers = this->made.LayersOf(row);
    for (int s = layers.end - 2; s >= layers.begin; --s)
    {
      if (this->made.IsDescribed(s, row) && this->made.IsDescribed(s + 1, row))
      {
        Range<int>& active = this->made.At(s, row);
        active = Hull(active, this->made.At(s + 1, row));
      }
    }
  }

  /// Keeps rays that are needed in front of the box active until they enter it. Restricts the
  /// active columns to those that touch anything in the layer.
  LIMPID_HD LIMPID_INLINE void FollowToBack(int row) const
  {
    const FaceFrustum& frustum = this->made.frustum;
    const Range<int>& layers = this->made.LayersOf(row);
    Range<int> carried;
    for (int s = layers.begin; s < layers.end; ++s)
    {
      if (!this->made.IsDescribed(s, row))
      {
        continue;
      }
      const int next = s < frustum.lastSlice ? s + 1 : s;
      const Slice& behind = frustum.SliceAt(next);
      Range<int>& active = this->made.At(s, row);
      const Range<int> needed = Hull(active, carried);
      const bool isOutside = frustum.Row(frustum.rowEntry)[row] > behind.RelativeDepth();
      carried = isOutside ? needed : Intersection(needed, behind.outsideColumns);
      active = this->Cut(needed, s, this->made.IsDescribed(next, row) ? next : s, row);
    }
  }

  LIMPID_HD LIMPID_INLINE Range<int> Cut(const Range<int>& active, int s, int next, int row) const
  {
    const FaceFrustum& frustum = this->made.frustum;
    const Slice& slice = frustum.SliceAt(s);
    if (!slice.nearRows.Contains(row))
    {
      return {};
    }
    const Range<int> touching = Hull(this->made.touching.Filled(frustum, s).At(row),
      this->made.touching.Filled(frustum, next).At(row));
    const Range<int> cut = Intersection(Intersection(active, slice.nearColumns), touching);
    return cut.Empty() ? Range<int>{} : WholeRegisters(cut, slice.rayColumns);
  }
};

/// Makes FaceFrustum::filledVoxels and activeVoxels.
struct MadeVoxelSpans
{
  FrustumInMaking frustum;
  Occupancy::Rows occupied;

  LIMPID_HD void operator()(int v, int s) const
  {
    const Slice& slice = this->frustum.SliceAt(s);
    if (slice.node < 0 || !slice.ownedRows.Contains(v))
    {
      return;
    }
    const Range<int> filled =
      FilledColumnsOf(slice, SpansOf(this->frustum, this->occupied, slice.node), v);
    this->frustum.Room(this->frustum.filledVoxels, s)[v] = filled;
    this->frustum.Room(this->frustum.activeVoxels, s)[v] =
      ActiveColumnsOf(this->frustum, s, v, filled);
  }
};

/// Fills the plan of one frustum.
template <class AnyDevice>
class PlanFiller
{
public:
  PlanFiller(const std::shared_ptr<AnyDevice>& device, const PlannedFrustum& outline,
    const FrustumInMaking& tables, const Occupancy& occupancy)
    : Device(device)
    , Outline(outline)
    , Tables(tables)
    , Columns(ColumnsOf(outline, tables))
    , Rows(RowsOf(outline, tables))
    , Occupied(occupancy.OnDevice().template On<OccupancyOn<AnyDevice>>(device, occupancy))
    , Skips(occupancy.Skips())
  {
  }

  void Fill()
  {
    this->Place(this->Columns, this->Tables.planeColumns.index.rowLength);
    this->Place(this->Rows, this->Tables.planeRows.index.rowLength);
    this->Device->ForEach(label, { this->Tables.columns, this->Tables.rows },
      MadeRays{ this->Tables, this->Columns.rays, this->Rows.rays, this->Outline.spacing,
        this->Outline.viewPlanes, this->Outline.viewDepth });
    this->FindActive();
    if (this->Tables.HasVoxels())
    {
      this->Device->ForEach(label, { this->Tables.nodesV, this->Tables.SliceCount() },
        MadeVoxelSpans{ this->Tables, this->Along() });
    }
  }

private:
  const Occupancy::Rows& Along() const { return this->Occupied->along[this->Tables.axisU]; }

  /// Makes the maps between the rays and the voxels of an axis. `rays`: largest number on a slice.
  void Place(const AxisInMaking& axis, int rays)
  {
    const int slices = this->Tables.SliceCount();
    this->Device->ForEach(label, { rays, 2 * (slices - 1) }, MadePlaneMaps{ axis });
    if (this->Tables.HasVoxels())
    {
      this->Device->ForEach(label, { axis.rays.nodes, slices }, MadeVoxelMaps{ axis });
      this->Device->ForEach(label, { axis.rays.nodes, slices }, MadeHatGains{ axis });
    }
  }

  void FindActive()
  {
    const int slices = this->Tables.SliceCount();
    const int rows = this->Tables.activeRays.rowLength;
    DeviceArray<AnyDevice, Reach> reaches =
      this->template Make<Reach>(Index(slices) * this->Tables.nodesV);
    DeviceArray<AnyDevice, int> spans =
      this->template Make<int>(TouchingRays::CountFor(this->Tables));
    DeviceArray<AnyDevice, int> firstRows;
    if (this->Tables.HasVoxels())
    {
      const int columns = this->Tables.firstVoxels.rowLength;
      this->Device->ForEach(label, { columns, slices },
        MadeFirstVoxels{ this->Columns, this->Tables.Room(this->Tables.firstVoxels), columns });
      firstRows = this->template Make<int>(Index(slices) * (rows + 1));
      this->Device->ForEach(
        label, { rows + 1, slices }, MadeFirstVoxels{ this->Rows, firstRows.Data(), rows + 1 });
    }
    const TouchingRays touching{ spans.Data(), rows };
    this->Device->ForEach(label, { this->Tables.nodesV, slices },
      MadeReaches{ this->Tables, this->Columns.rays, this->Along(), reaches.Data() });
    this->Device->ForEach(label, { rows, slices },
      MadeTouchingRays{ this->Tables, this->Rows.rays, reaches.Data(), touching });
    const ActiveInMaking made{ this->Tables, touching, firstRows.Data(), this->Skips };
    this->Device->ForIndices(label, this->Tables.rows, FollowedToFront{ made });
    this->Device->ForEach(label, { rows, slices }, NeededRays{ made });
    this->Device->ForIndices(label, this->Tables.rows, ActiveRow{ made });
  }

  template <class Value>
  DeviceArray<AnyDevice, Value> Make(Index count) const
  {
    return { this->Device, static_cast<std::size_t>(count), what };
  }

  std::shared_ptr<AnyDevice> Device;
  const PlannedFrustum& Outline;
  FrustumInMaking Tables;
  AxisInMaking Columns;
  AxisInMaking Rows;
  std::shared_ptr<OccupancyOn<AnyDevice>> Occupied;
  bool Skips;
};
}

template <class AnyDevice>
void FillPlanOnDevice(const std::shared_ptr<AnyDevice>& device, const PlannedFrustum& outline,
  const unsigned char* tables, const Occupancy& occupancy)
{
  FrustumInMaking there(outline);
  there.tables = tables;
  PlanFiller<AnyDevice>(device, outline, there, occupancy).Fill();
}

template void FillPlanOnDevice(const std::shared_ptr<CompiledDevice>&, const PlannedFrustum&,
  const unsigned char*, const Occupancy&);
}
