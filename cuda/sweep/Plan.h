// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_Plan_h
#define limpid_sweep_Plan_h

#include "scene/Grid.h"
#include "scene/RaySource.h"
#include "sweep/Lateral.h"
#include "sweep/Occupancy.h"

#include <array>
#include <vector>

namespace limpid
{
/// A plane through a Gauss point of a layer, on which all rays of a frustum are sampled: between
/// two slices of voxels.
struct Plane
{
  int nodes[2] = { 0, 0 }; ///< node indices along the depth axis
  float fraction = 0;      ///< weight of the second slice [0, 1]
  LinearMap rayColumns;    ///< ray column -> voxel column
  LinearMap rayRows;       ///< ray row -> voxel row
};

/// A slice of voxels, or the eye itself, and the layer behind it up to the next slice.
struct Slice
{
  int node = -1;           ///< node index along the depth axis; -1: the eye itself
  double depth = 0;        ///< distance from the eye along the depth axis [index]
  float relativeDepth = 0; ///< depth less the depth of the first slice [index]
  float scale = 1;         ///< depth / far depth: width of a ray; 1 if parallel

  LinearMap voxelColumns;         ///< voxel column -> ray column
  LinearMap voxelRows;            ///< voxel row -> ray row
  std::vector<int> firstVoxels;   ///< per ray column: the first voxel that reads it first, or later
  std::vector<float> columnSides; ///< per voxel column: SideWeight, for means across the rays
  std::vector<float> rowSides;    ///< per voxel row
  Range<int> ownedColumns;        ///< voxels of this slice that belong to this frustum
  Range<int> ownedRows;
  Range<int> touchedColumns; ///< voxels of this slice that rays read, and the owned ones
  Range<int> touchedRows;
  std::vector<float> columnEntry; ///< per voxel column: relative depth where its rays enter in u
  std::vector<float> rowEntry;    ///< per voxel row: ... in v

  // The layer behind; the last slice has none.
  std::array<Plane, 2> planes;
  Range<int> insideColumns;     ///< columns of rays that stay inside the box in u
  std::vector<Range<int>> work; ///< per row of rays: columns that have to be visited
};

/// The rays of a frustum along a lateral axis, one value per column or row.
struct RayAxis
{
  std::vector<float> entry;  ///< relative depth at which the ray enters the box in this axis
  std::vector<float> exit;   ///< ... and leaves it
  std::vector<double> slope; ///< lateral step per unit of depth [index]
  std::vector<float> share;  ///< width at the far depth [index]; 0: a guard, for interpolation only

  int Count() const { return static_cast<int>(this->entry.size()); }
};

/**
 * One family of rays and the slices it crosses.
 *
 * Ray (a, b) meets the slice at depth D in (u, v) = offset + (a, b) D (point eye: slopes) or
 * (a, b) + shear D (parallel eye). Space about a point eye is split into up to six frusta, one
 * per face direction, in which no slope exceeds one voxel per slice; each voxel belongs to exactly
 * one. All lengths are in index space, where anisotropic voxels are cubes.
 */
struct FaceFrustum
{
  int axisU = 0; ///< grid axis of the columns
  int axisV = 1; ///< grid axis of the rows
  int axisW = 2; ///< grid axis of the depth
  int nodesU = 0;
  int nodesV = 0;

  int columns = 0;           ///< rays along u
  int rows = 0;              ///< rays along v
  std::vector<Slice> slices; ///< front to back

  Lateral lateralU; ///< where the columns are
  Lateral lateralV; ///< where the rows are
  RayAxis columnAxis;
  RayAxis rowAxis;
  Range<int> frontColumns; ///< columns that enter the box in its front, not later through a side
  Range<int> frontRows;
  /// World volume that a unit of ray integral stands for:
  /// S = cellMeasure sum_ij share_ij / length_ij integral g mu T scale^2 dt.
  double cellMeasure = 0;
  Vec3 spacing{ 1.0 }; ///< world length of an index step along u, v, w

  std::vector<float> inView; ///< per ray 1 or 0; empty: all are

  int RayCount() const { return this->columns * this->rows; }

  /// Relative depth where rays begin that do not enter through a side.
  float FrontDepth() const { return this->slices.front().relativeDepth; }

  int LastSlice() const { return static_cast<int>(this->slices.size()) - 1; }

  /// The first slice that is a slice of voxels.
  int FirstNodeSlice() const { return this->slices.front().node < 0 ? 1 : 0; }

  /// Voxel columns of row `v` on a slice whose transmittance and importance behind can matter:
  /// those that read a ray in `work`, be it through a neighbour (AverageSeen).
  Range<int> VoxelColumns(const Slice& slice, int v) const;

  /// World length of ray (i, j) per unit of depth.
  float RayLength(int column, int row) const;

  /// The same of all rays of a row. `lengths`: `columns` values.
  void FindRayLengths(int row, float* lengths) const;
};

/// Rays, guards apart, that are in the slab of the box along one axis by the time they come to a
/// relative depth. They are neighbours.
Range<int> RaysEnteredBy(const RayAxis& axis, float depth);

/// The spans of all voxel rows on a slice of a frustum.
struct SpanRows
{
  const Occupancy::Spans* first;
  Index stride;

  const Occupancy::Spans& operator[](int v) const { return this->first[v * this->stride]; }
};

SpanRows SpansOf(const FaceFrustum& frustum, const Occupancy& occupancy, int node);

/// The spans of voxel row `v` on a slice of a frustum.
inline const Occupancy::Spans& SpansOf(
  const FaceFrustum& frustum, const Occupancy& occupancy, int node, int v)
{
  return SpansOf(frustum, occupancy, node)[v];
}

/// The frusta that cover a grid as seen from an eye; none if the grid has no volume. `depthAxes`:
/// which grid axes may be the depth axis of one; the others are left out.
std::vector<FaceFrustum> PlanSweep(const Grid& grid, const Occupancy& occupancy,
  const RaySource& eye, double rayDensity, Placement placement = Placement::ForIntegrals,
  const std::array<bool, 3>& depthAxes = { { true, true, true } });
}

#endif
