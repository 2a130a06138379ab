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
Interval InsideColumns(const Pyramid& pyramid, float front, float back);

/// Which rays of a pyramid the picture shows, see Pyramid::inView. `w`: of all rays' directions
/// (point eye) or of one point each (parallel eye) along the depth axis.
std::vector<float> FindInView(const Pyramid& pyramid, const Eye& eye, double w);
}

#endif
