// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What of a plan depends on the rays alone. All functions fill tables of the frustum.

#ifndef limpid_sweep_RayGeometry_h
#define limpid_sweep_RayGeometry_h

#include "sweep/PlanSweep.h"

namespace limpid
{
/// World length of all rays per unit of depth.
void FindRayLengths(PlannedFrustum& frustum);

/// Columns, guards apart, that are inside the box in u all the way between two relative depths.
/// They are neighbours, as the rays' order along u never changes.
Range<int> InsideColumns(const FaceFrustum& frustum, float front, float back);

/// Which rays of a frustum the picture shows. `w`: of all rays' directions (point source) or of one
/// point each (parallel source) along the depth axis.
void FindInView(PlannedFrustum& frustum, const RaySource& source, double w);
}

#endif
