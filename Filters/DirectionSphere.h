// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Directions spread over the unit sphere, and a triangulation of them.

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
  LatitudeLongitude ///< rings about the y axis; each pole is a single direction
};

/// A closed triangulation of the unit sphere. Triangles are counterclockwise as seen from outside.
struct DirectionSphere
{
  std::vector<Vec3> directions; ///< unit vectors, all different
  vtkSmartPointer<vtkCellArray> triangles;

  /// Returns the mean angle between neighbouring directions [radians].
  double Spacing() const;
};

/// Returns the sphere whose number of directions is as close to `count` as the sampling allows.
DirectionSphere MakeDirectionSphere(Sampling sampling, int count);
}

#endif
