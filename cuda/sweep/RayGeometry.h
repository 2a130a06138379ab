// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The parts of a plan that depend on the rays only. All functions fill tables of the frustum.

#ifndef limpid_sweep_RayGeometry_h
#define limpid_sweep_RayGeometry_h

#include "sweep/PlanOutline.h"

namespace limpid
{
/// Computes the world length of every ray per unit of depth.
void FindRayLengths(PlannedFrustum& frustum);

/// Returns the columns, without guards, that are inside the box in u between two relative depths.
/// They are contiguous, as the order of rays along u never changes. `among`: columns that may be.
Range<int> InsideColumns(
  const FaceFrustum& frustum, const Range<int>& among, float front, float back);

/// Finds which rays of a frustum are inside the view.
void FindInView(PlannedFrustum& frustum);
}

#endif
