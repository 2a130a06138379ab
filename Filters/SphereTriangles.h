// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_SphereTriangles_h
#define limpid_SphereTriangles_h

#include "vtkType.h"

#include "math/Vec.h"

#include <array>
#include <vector>

namespace limpid
{
/**
 * Computes the convex hull of points on the unit sphere, which is their Delaunay triangulation.
 * Triangles are counterclockwise as seen from outside.
 *
 * `points`: at least four, all different, not all in one plane, sorted by descending y coordinate.
 * (vtkDelaunay3D leaves holes between points on a sphere.)
 */
std::vector<std::array<vtkIdType, 3>> TriangulateSphere(const std::vector<Vec3>& points);
}

#endif
