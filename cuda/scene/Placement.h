// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Automatic placement of camera and light.

#ifndef limpid_scene_Placement_h
#define limpid_scene_Placement_h

namespace limpid
{
struct Camera;
struct Grid;
struct Light;

/// Returns whether a camera still has the position and the focal point of a new one.
bool IsUnplaced(const Camera& camera);

/// Returns whether a light still has the position of a new one.
bool IsUnplaced(const Light& light);

/// Places the camera where VTK's renderers place a new one when they reset it: on the z axis
/// through the centre of the data, at the distance where the bounding sphere of the data fills the
/// view angle.
void PlaceCamera(const Grid& grid, Camera& camera);

/// Places the light like the key light of ParaView's light kit: 50 degrees above and 10 degrees to
/// the right of the camera, at the camera's distance from the focal point.
void PlaceLight(const Camera& camera, Light& light);
}

#endif
