// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_PlanSweep_h
#define limpid_sweep_PlanSweep_h

#include "scene/Grid.h"
#include "scene/RaySource.h"
#include "sweep/FaceFrustum.h"
#include "sweep/Lateral.h"
#include "sweep/Occupancy.h"

#include <array>
#include <vector>

namespace limpid
{
class Communicator;

/// A slice closer to a point source holds no voxel but the source's own, and rays have no width
/// there [index].
constexpr double nearestSlice = 1e-6;

/// A frustum that owns its tables, and what only its making needs.
struct PlannedFrustum : OwnedTables<FaceFrustum>
{
  Lateral lateralU;    ///< where the columns are
  Lateral lateralV;    ///< where the rows are
  Vec3 spacing{ 1.0 }; ///< world length of an index step along u, v, w
};

/// Who will read a plan.
enum class Readers
{
  Rays, ///< tables of voxels are left out
  RaysAndVoxels
};

/// How a sweep is planned.
struct PlanSettings
{
  double rayDensity = 1; ///< rays per voxel and axis on the farthest slice
  Placement placement = Placement::ForIntegrals;
  const Communicator* ranks = nullptr; ///< that share the sweep, on processors; null: there is one
  Readers readers = Readers::RaysAndVoxels;
  std::array<bool, 3> depthAxes{ { true, true, true } }; ///< others are left out
};

/// The frusta that cover a grid as seen from a source of rays; none if the grid has no volume.
std::vector<PlannedFrustum> PlanSweep(const Grid& grid, const Occupancy& occupancy,
  const RaySource& source, const PlanSettings& settings);

/// Rays along an axis, guards apart, that are in the slab of the box by the time they come to a
/// relative depth. They are neighbours. `entries`: of `count` rays.
Range<int> RaysEnteredBy(const float* entries, int count, float depth);

/// Per source of a map, and one more: the first target that reads the source first, or a later one.
void FindFirstTargets(const int* index, int targets, int sources, int* first);

/// The spans of all voxel rows on a slice of a frustum.
struct SpanRows
{
  const Occupancy::Spans* first;
  Index stride;

  const Occupancy::Spans& operator[](int v) const { return this->first[v * this->stride]; }
};

/// `node`: of the slice, along the depth axis.
SpanRows SpansOf(const FaceFrustum& frustum, const Occupancy& occupancy, int node);
}

#endif
