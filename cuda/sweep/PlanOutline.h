// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The part of a plan that has one value per ray of an axis, per slice or per row. The host makes
// it; it determines all else (FillPlan.h, PlanOnDevice.h).

#ifndef limpid_sweep_PlanOutline_h
#define limpid_sweep_PlanOutline_h

#include "scene/Grid.h"
#include "scene/RaySource.h"
#include "sweep/FaceFrustum.h"
#include "sweep/Lateral.h"

#include <array>
#include <vector>

namespace limpid
{
/// Smallest depth of a slice of voxels [index]. A closer slice holds no voxel but the one at a
/// point source, and rays have no width there.
constexpr double nearestSlice = 1e-6;

/// The readers of a plan.
enum class Readers
{
  Rays, ///< tables for voxels are omitted
  RaysAndVoxels
};

/// Settings of the planning of a sweep.
struct PlanSettings
{
  double rayDensity = 1; ///< rays per voxel and axis on the farthest slice
  RayPlacement placement = RayPlacement::ForIntegrals;
  Readers readers = Readers::RaysAndVoxels;
  std::array<bool, 3> depthAxes{ { true, true, true } }; ///< frusta along other axes are omitted
};

/// A frustum that owns its tables, with data that only the planning needs.
struct PlannedFrustum : OwnedTables<FaceFrustum>
{
  Lateral lateralU;                   ///< positions of the columns of rays
  Lateral lateralV;                   ///< positions of the rows of rays
  Vec3 spacing{ 1.0 };                ///< world length of an index step along u, v, w
  Table<double> columnCoordinates;    ///< [column]: see Lateral
  Table<double> rowCoordinates;       ///< [row]
  Table<RaySource::Plane> viewPlanes; ///< RaySource::viewPlanes
  double viewDepth = 1; ///< component along the depth axis of all ray directions (point source), or
                        ///< of one point on each ray (parallel source), for the planes of the view
  std::size_t outlineBytes = 0; ///< of the tables that OutlineSweep fills; they are the first

  double BaseDepth() const { return this->SliceAt(this->firstNodeSlice).depth; }
};

/// Returns the frusta that cover a grid as seen from a source; none if the grid has no volume. All
/// tables have memory, but only those of the outline are filled, and the others are 0. They are
/// those of slices, of rays along one axis and of rows of rays.
std::vector<PlannedFrustum> OutlineSweep(
  const Grid& grid, const RaySource& source, const PlanSettings& settings);

/// Returns the rays along an axis that have entered the box at a relative depth. They are
/// contiguous. `entries`: entry depths; `among`: rays without guards.
Range<int> RaysEnteredBy(const float* entries, const Range<int>& among, float depth);
}

#endif
