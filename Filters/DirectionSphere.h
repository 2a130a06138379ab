// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Directions spread over the unit sphere, and the triangles between them.

#ifndef limpid_DirectionSphere_h
#define limpid_DirectionSphere_h

#include "vtkCellArray.h"
#include "vtkSmartPointer.h"

#include "math/Vec.h"

#include <vector>

namespace limpid
{
enum class Sampling
{
  Icosphere,        ///< a subdivided icosahedron: 12, 42, 162, 642 ... directions
  Fibonacci,        ///< a spiral from pole to pole: any number of directions
  LatitudeLongitude ///< rings about the second axis, whose poles are single directions
};

/// A closed triangulation of the unit sphere, its triangles counterclockwise as seen from outside.
struct DirectionSphere
{
  std::vector<Vec3> directions; ///< of unit length, no two the same
  vtkSmartPointer<vtkCellArray> triangles;

  /// Mean angle between neighbouring directions [radians].
  double Spacing() const;
};

/// As close to `count` directions as the sampling can come.
DirectionSphere MakeDirectionSphere(Sampling sampling, int count);
}

#endif
