// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_PlanSweep_h
#define limpid_sweep_PlanSweep_h

#include "scene/Grid.h"
#include "scene/Occupancy.h"
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

/// A frustum that owns its tables, with data that only the planning needs.
struct PlannedFrustum : OwnedTables<FaceFrustum>
{
  Lateral lateralU;    ///< positions of the columns of rays
  Lateral lateralV;    ///< positions of the rows of rays
  Vec3 spacing{ 1.0 }; ///< world length of an index step along u, v, w
};

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

/// Returns the frusta that cover a grid as seen from a source; none if the grid has no volume.
std::vector<PlannedFrustum> PlanSweep(const Grid& grid, const Occupancy& occupancy,
  const RaySource& source, const PlanSettings& settings);

/// Returns the rays along an axis that have entered the box at a relative depth. They are
/// contiguous. `entries`: entry depths; `among`: rays without guards.
Range<int> RaysEnteredBy(const float* entries, const Range<int>& among, float depth);

/// Computes, for each of some sources of a map and one past the last, the first target whose first
/// source is this one or a later one.
void FindFirstTargets(const int* index, int targets, const Range<int>& sources, int* first);

/// The spans of all rows of voxels on one slice of a frustum.
struct SpanRows
{
  const Occupancy::Spans* first;
  Index stride;

  const Occupancy::Spans& operator[](int v) const { return this->first[v * this->stride]; }
};

/// `node`: node index of the slice along the depth axis.
SpanRows SpansOf(const FaceFrustum& frustum, const Occupancy& occupancy, int node);
}

#endif
