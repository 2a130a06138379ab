// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The plan of a sweep, stored as numbers and flat tables.

#ifndef limpid_sweep_FaceFrustum_h
#define limpid_sweep_FaceFrustum_h

#include "backend/WideLoad.h"
#include "math/Range.h"
#include "math/Vec.h"
#include "sweep/FlatTables.h"
#include "sweep/HalfLayer.h"

#include <cmath>

namespace limpid
{
/// A plane on which samples lie (a slice of voxels, or the plane of a point source), together with
/// the layer between it and the next slice. The last slice has no layer.
struct Slice
{
  int node = -1;           ///< node index along the depth axis; -1: the source itself
  double depth = 0;        ///< distance from the source along the depth axis [index]
  float scale = 1;         ///< depth / far depth: width of a ray; 1 if parallel
  Range<int> ownedColumns; ///< voxels of this slice that this frustum owns
  Range<int> ownedRows;
  Range<int> rayColumns; ///< columns of rays that the plan describes here, see RayWindows
  Range<int> rayRows;
  Range<int> nearColumns; ///< those that meet the box in the layer, or that its voxels interpolate
  Range<int> nearRows;
  Range<int> touchedColumns; ///< voxels of this slice that rays read or that are owned
  Range<int> touchedRows;

  Layer layer;                   ///< layer.front is the depth relative to the first slice
  int nodes[2] = { 0, 0 };       ///< node indices of the two slices that the layer interpolates
  float fractions[2] = { 0, 0 }; ///< weights of the second slice at the two Gauss points [0, 1]
  Range<int> insideColumns;      ///< columns of rays that stay inside the box in u
  Range<int> outsideColumns;     ///< columns of rays that enter the box in u behind the slice
  float hatGain = 1;             ///< FaceFrustum::columnHatGain along the depth axis

  /// Depth relative to the first slice [index].
  LIMPID_HD LIMPID_INLINE float RelativeDepth() const { return this->layer.front; }

  /// Weight of the second slice at the position `share` of the layer's thickness.
  template <class Number>
  LIMPID_HD LIMPID_INLINE Number FractionAt(const Number& share) const
  {
    constexpr float first = float(gaussPoints[0]);
    constexpr float inverse = float(1.0 / (gaussPoints[1] - gaussPoints[0]));
    return this->fractions[0] +
      (share - first) * inverse * (this->fractions[1] - this->fractions[0]);
  }
};

/// Position of a ray along one lateral axis: `start + slope d` at the relative depth d [index].
struct RayLine
{
  double start;
  double slope;

  LIMPID_HD LIMPID_INLINE double At(double relativeDepth) const
  {
    return this->start + this->slope * relativeDepth;
  }
};

/// Returns the rays closer than one node to a voxel along one axis, and up to two more. Rays
/// outside the box count as lying on its border. `index`: map from voxels to rays.
LIMPID_HD LIMPID_INLINE Range<int> RaysAbout(
  const RayLine* lines, int rays, const int* index, int nodes, int voxel, float relativeDepth)
{
  const bool first = voxel == 0;
  const bool last = voxel + 1 == nodes;
  Range<int> about{ index[first ? 0 : voxel - 1], index[last ? voxel : voxel + 1] + 2 };
  about.end = about.end < rays ? about.end : rays;
  while (first && about.begin > 0 && lines[about.begin - 1].At(relativeDepth) > -1)
  {
    --about.begin;
  }
  while (last && about.end < rays && lines[about.end].At(relativeDepth) < nodes)
  {
    ++about.end;
  }
  return about;
}

/// Clamps a position to a box of `nodes` nodes [index].
LIMPID_HD LIMPID_INLINE double InBox(double position, int nodes)
{
  const double last = nodes - 1;
  const double inside = position > 0 ? position : 0.0;
  return inside < last ? inside : last;
}

/// Evaluates a voxel's hat function at a position, which is first clamped to the box.
LIMPID_HD LIMPID_INLINE float HatAt(double position, int voxel, int nodes)
{
  const double inside = InBox(position, nodes);
  return AtLeast(1.0f - Magnitude(static_cast<float>(inside - voxel)), 0.0f);
}

/// Rows of rays are followed through the slices in blocks of so many.
constexpr int rowsPerBlock = 64;

/// Two neighbouring nodes along an axis and the interpolation weight between them.
struct NodePair
{
  int first;
  float weight; ///< weight of the second node [0, 1]
};

/// Returns the nodes next to a position, which is first clamped to a box of `nodes` nodes [index].
LIMPID_HD LIMPID_INLINE NodePair NodesAt(double position, int nodes)
{
  const double inside = InBox(position, nodes);
  const int floor = static_cast<int>(inside);
  const int first = floor < nodes - 2 ? floor : nodes - 2;
  return { first, static_cast<float>(inside - first) };
}

/**
 * A family of rays and the slices that it crosses.
 *
 * Ray (a, b) meets the slice at depth D in (u, v) = offset + (a, b) D (point source: slopes) or
 * (a, b) + shear D (parallel source). Space around a point source is split into up to six frusta,
 * one per face direction. Inside a frustum no slope exceeds one voxel per slice, and each voxel
 * belongs to exactly one frustum. All lengths are in index space, where anisotropic voxels are
 * cubes.
 *
 * One guard ray on either side serves interpolation only.
 *
 * In a long box most rays are beside the box on most slices. Then the plan of a slice describes
 * only the rays near the box (Slice::rayColumns, rayRows); and if few of all pairs of a column and
 * a row ever meet the box, only these have values (`banded`).
 */
struct FaceFrustum : FlatTables
{
  int axisU = 0; ///< grid axis of the columns
  int axisV = 1; ///< grid axis of the rows
  int axisW = 2; ///< grid axis of the depth
  int nodesU = 0;
  int nodesV = 0;
  Index strideU = 0; ///< strides of fields along u, v and w [values]
  Index strideV = 0;
  Index strideW = 0;

  int rayCount = 0;        ///< number of rays with values
  bool banded = false;     ///< whether some pairs of a column and a row have no values
  int columns = 0;         ///< rays along u
  int rows = 0;            ///< rays along v
  int lastSlice = -1;      ///< index of the last slice; slices are counted front to back
  int firstNodeSlice = 0;  ///< the first slice that holds voxels
  float frontDepth = 0;    ///< relative depth where rays start that do not enter through a side
  Range<int> frontColumns; ///< columns that enter the box through its front face, not a side
  Range<int> frontRows;
  /// World volume per unit of ray integral:
  /// S = cellMeasure sum_ij share_ij / length_ij integral g mu T scale^2 dt.
  double cellMeasure = 0;
  bool seesAll = true; ///< whether all rays are inside the view

  Table<Slice> slices;
  Table<Range<int>> rowColumns;  ///< [row]: columns of rays that have values
  Table<Range<int>> rowLayers;   ///< [row]: slices behind which rays of the row may be visited
  Table<Range<int>> blockLayers; ///< [block of rows]: hull of their rowLayers
  Table<int> rowStarts;          ///< [row]: index of the ray in column 0; empty unless banded
  MapTable planeColumns;        ///< [2 slice + half][column of Slice::rayColumns]: see PlaneColumns
  MapTable planeRows;           ///< [2 slice + half][row of Slice::rayRows]: see PlaneRows
  Table<Range<int>> activeRays; ///< [slice][row of Slice::rayRows]: see ActiveRays
  Table<RayLine> columnLines;   ///< [column]: positions of the rays in u
  Table<RayLine> rowLines;      ///< [row]: positions in v
  Table<float> columnEntry;     ///< [column]: relative depth where rays enter the box in u
  Table<float> columnExit;      ///< [column]: relative depth where rays leave the box in u
  Table<float> rowEntry;        ///< [row]: relative depth where rays enter the box in v
  Table<float> rowExit;         ///< [row]: relative depth where rays leave the box in v
  Table<float> columnShare;     ///< [column]: width at the far depth [index]; 0 for guard rays
  Table<float> rowShare;        ///< [row]
  Table<float> length;          ///< [ray]: world length per unit of depth [length]
  Table<float> inView;          ///< [ray]: 1 inside the view, else 0; empty if all rays are in view
  MapTable voxelColumns;        ///< [slice][voxel column]: ray column
  MapTable voxelRows;           ///< [slice][voxel row]: ray row
  Table<float> columnSides;     ///< [slice][voxel column]: SideWeight, for means across rays
  Table<float> rowSides;        ///< [slice][voxel row]
  /// [slice][voxel column]: reciprocal of the part of the voxel's hat function that lies inside
  /// the box and is covered by rays. It normalises sums over rays (VoxelRow::FindEffect).
  Table<float> columnHatGain;
  Table<float> rowHatGain;        ///< [slice][voxel row]
  Table<float> voxelColumnEntry;  ///< [slice][voxel column]: relative depth where its rays enter
  Table<float> voxelRowEntry;     ///< [slice][voxel row]
  Table<int> firstVoxels;         ///< [slice][column of Slice::rayColumns]: see FirstVoxels
  Table<Range<int>> activeVoxels; ///< [slice][voxel row]: columns that a ray can matter to
  Table<Range<int>> filledVoxels; ///< [slice][voxel row]: columns that may change

  bool HasVoxels() const { return this->voxelRows.index.rowLength > 0; } ///< see Readers

  LIMPID_HD LIMPID_INLINE const Slice& SliceAt(int s) const { return this->Row(this->slices)[s]; }
  int SliceCount() const { return this->lastSlice + 1; }
  Index RayCount() const { return this->rayCount; }

  LIMPID_HD LIMPID_INLINE int RayAt(int column, int row) const
  {
    return (this->banded ? this->Row(this->rowStarts)[row] : row * this->columns) + column;
  }

  /// Columns of rays of a row that have values.
  LIMPID_HD LIMPID_INLINE const Range<int>& ColumnsOf(int row) const
  {
    return this->Row(this->rowColumns)[row];
  }

  /// Slices behind which rays of a row may be visited.
  LIMPID_HD LIMPID_INLINE const Range<int>& LayersOf(int row) const
  {
    return this->Row(this->rowLayers)[row];
  }

  /// Slices behind which any ray of a block of `rowsPerBlock` rows may be visited.
  LIMPID_HD LIMPID_INLINE const Range<int>& LayersOfBlock(Index block) const
  {
    return this->Row(this->blockLayers)[block];
  }

  /// Rows of rays that may be visited in the layers behind any of these slices.
  Range<int> RowsNear(const Range<int>& some) const
  {
    Range<int> hull;
    for (int s = some.begin; s < some.end; ++s)
    {
      hull = Hull(hull, this->SliceAt(s).nearRows);
    }
    return hull;
  }

  /// Returns the number of rays with values in front of a row.
  Index RaysBefore(int row) const
  {
    return row < this->rows ? this->RayAt(this->ColumnsOf(row).begin, row) : this->rayCount;
  }

  /// Values of `table`, which has one per ray, by column.
  LIMPID_HD LIMPID_INLINE const float* OfRow(const Table<float>& table, int row) const
  {
    return this->Row(table) + this->RayAt(0, row);
  }

  /// Map from the columns in Slice::rayColumns to voxels at a Gauss point; `plane`:
  /// 2 slice + half.
  LIMPID_HD LIMPID_INLINE LinearMap PlaneColumns(int plane) const
  {
    return From(this->Row(this->planeColumns, plane), this->SliceAt(plane / 2).rayColumns.begin);
  }

  LIMPID_HD LIMPID_INLINE LinearMap PlaneRows(int plane) const
  {
    return From(this->Row(this->planeRows, plane), this->SliceAt(plane / 2).rayRows.begin);
  }

  /// For the columns in Slice::rayColumns and one more: the first voxel whose first ray is not
  /// before it.
  LIMPID_HD LIMPID_INLINE const int* FirstVoxels(int s) const
  {
    return this->Row(this->firstVoxels, s) - this->SliceAt(s).rayColumns.begin;
  }

  /// Returns FirstVoxels of any column; beyond those described, that of the nearest one.
  LIMPID_HD LIMPID_INLINE int FirstVoxel(int s, int column) const
  {
    const Range<int>& described = this->SliceAt(s).rayColumns;
    const int notBefore = column > described.begin ? column : described.begin;
    return this->FirstVoxels(s)[notBefore < described.end ? notBefore : described.end];
  }

  /// Whether a voxel close to the sides of the box may read the density of a ray: beside a ray that
  /// enters through a side it interpolates up to three rays that enter in front.
  LIMPID_HD LIMPID_INLINE bool IsNearSides(int column, int row) const
  {
    constexpr int reach = 3;
    return column < this->frontColumns.begin + reach || column >= this->frontColumns.end - reach ||
      row < this->frontRows.begin + reach || row >= this->frontRows.end - reach;
  }

  LIMPID_HD LIMPID_INLINE Index VoxelAt(int node, int u, int v) const
  {
    return this->strideW * node + this->strideV * v + this->strideU * u;
  }

  /// Columns to visit in the layer behind the slice.
  LIMPID_HD LIMPID_INLINE Range<int> ActiveRays(int s, int row) const
  {
    const Range<int>& described = this->SliceAt(s).rayRows;
    return described.Contains(row)
      ? LoadAtOnce(this->Row(this->activeRays, s)[row - described.begin])
      : Range<int>{};
  }

  /// Whether any ray of a row is visited in any of some layers.
  bool HasActive(const Range<int>& layers, int row) const
  {
    bool any = false;
    for (int s = layers.begin; s < layers.end; ++s)
    {
      any = any || !this->ActiveRays(s, row).Empty();
    }
    return any;
  }

  LIMPID_HD LIMPID_INLINE Range<int> ActiveVoxels(int s, int v) const
  {
    return LoadAtOnce(this->Row(this->activeVoxels, s)[v]);
  }

  LIMPID_HD LIMPID_INLINE Range<int> FilledVoxels(int s, int v) const
  {
    return LoadAtOnce(this->Row(this->filledVoxels, s)[v]);
  }

  /// Returns the columns of rays that slice `s` describes around voxel column `u` and its
  /// neighbours, see RaysAbout.
  LIMPID_HD LIMPID_INLINE Range<int> ColumnsAbout(int s, int u) const
  {
    return Intersection(this->AllColumnsAbout(s, u), this->SliceAt(s).rayColumns);
  }

  LIMPID_HD LIMPID_INLINE Range<int> RowsAbout(int s, int v) const
  {
    return Intersection(this->AllRowsAbout(s, v), this->SliceAt(s).rayRows);
  }

  LIMPID_HD LIMPID_INLINE Range<int> AllColumnsAbout(int s, int u) const
  {
    return RaysAbout(this->Row(this->columnLines), this->columns,
      this->Row(this->voxelColumns, s).index, this->nodesU, u, this->SliceAt(s).RelativeDepth());
  }

  LIMPID_HD LIMPID_INLINE Range<int> AllRowsAbout(int s, int v) const
  {
    return RaysAbout(this->Row(this->rowLines), this->rows, this->Row(this->voxelRows, s).index,
      this->nodesV, v, this->SliceAt(s).RelativeDepth());
  }

  /// Returns where a ray crosses faces of cells within a layer, in ascending order, as fractions
  /// of the layer's thickness; 1 stands for no crossing. A ray moves by at most one node per
  /// layer, so it crosses at most one face along either axis.
  LIMPID_HD LIMPID_INLINE Range<float> FacesCrossed(const Layer& layer, int column, int row) const
  {
    const auto face = [&layer](const RayLine& line)
    {
      const double front = line.At(layer.front);
      const double moved = line.slope * layer.thickness;
      const double back = front + moved;
      const double between = std::floor(front > back ? front : back);
      const bool crosses = between > (front < back ? front : back);
      return crosses ? static_cast<float>((between - front) / moved) : 1.0f;
    };
    const float u = face(this->Row(this->columnLines)[column]);
    const float v = face(this->Row(this->rowLines)[row]);
    return u < v ? Range<float>{ u, v } : Range<float>{ v, u };
  }

  /// Relative depths between which a row of rays is inside the box in v.
  LIMPID_HD LIMPID_INLINE Range<float> StayOfRow(int row) const
  {
    return { this->Row(this->rowEntry)[row], this->Row(this->rowExit)[row] };
  }

  LIMPID_HD LIMPID_INLINE Range<float> StayOfColumn(int column) const
  {
    return { this->Row(this->columnEntry)[column], this->Row(this->columnExit)[column] };
  }
};
}

#endif
