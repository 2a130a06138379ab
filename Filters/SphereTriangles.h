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
 * The convex hull of points on the unit sphere, which is their Delaunay triangulation: triangles
 * counterclockwise as seen from outside.
 *
 * At least four points, no two the same, sorted from the largest second coordinate to the smallest;
 * not all of them in a plane. (vtkDelaunay3D leaves holes between points on a sphere.)
 */
std::vector<std::array<vtkIdType, 3>> TriangulateSphere(const std::vector<Vec3>& points);
}

#endif
