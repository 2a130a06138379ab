// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_RayGeometry_h
#define limpid_sweep_RayGeometry_h

#include "sweep/Plan.h"

#include <vector>

namespace limpid
{
/// Columns, guards apart, that are inside the box in u all the way between two relative depths.
/// They are neighbours, as the rays' order along u never changes.
Range<int> InsideColumns(const FaceFrustum& frustum, float front, float back);

/// Which rays of a frustum the picture shows, see FaceFrustum::inView. `w`: of all rays' directions
/// (point eye) or of one point each (parallel eye) along the depth axis.
std::vector<float> FindInView(const FaceFrustum& frustum, const RaySource& eye, double w);
}

#endif
