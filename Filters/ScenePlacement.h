// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Where camera and light stand when nobody has placed them.

#ifndef limpid_ScenePlacement_h
#define limpid_ScenePlacement_h

#include "vtkLimpidFiltersModule.h" // for export macro

#include "math/Vec.h"

namespace limpid
{
struct Camera;
struct Grid;
struct Light;

/// A point or a direction as VTK has it.
inline Vec3 ToVec3(const double* vector)
{
  return { vector[0], vector[1], vector[2] };
}

/// Whether a camera still has the position and focal point of a new vtkCamera.
VTKLIMPIDFILTERS_EXPORT bool IsUnplaced(const Camera& camera);

/// Whether a light still has the position of a new vtkLight.
VTKLIMPIDFILTERS_EXPORT bool IsUnplaced(const Light& light);

/// Puts the camera where vtkRenderer::ResetCamera puts a new one: on the z axis through the centre
/// of the data, at the distance from which the sphere around the data fills the view angle.
VTKLIMPIDFILTERS_EXPORT void PlaceCamera(const Grid& grid, Camera& camera);

/// Puts the light where the key light of ParaView's light kit shines from: 50 degrees above and 10
/// degrees to the right of the camera, as far from the focal point as the camera.
VTKLIMPIDFILTERS_EXPORT void PlaceLight(const Camera& camera, Light& light);
}

#endif
