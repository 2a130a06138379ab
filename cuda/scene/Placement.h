// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Where camera and light stand when nobody has placed them.

#ifndef limpid_scene_Placement_h
#define limpid_scene_Placement_h

namespace limpid
{
struct Camera;
struct Grid;
struct Light;

/// Whether a camera still has the position and the focal point of a new one.
bool IsUnplaced(const Camera& camera);

/// Whether a light still has the position of a new one.
bool IsUnplaced(const Light& light);

/// Puts the camera where VTK's renderers put a new one when they reset it: on the z axis through
/// the centre of the data, at the distance from which the sphere around the data fills the view
/// angle.
void PlaceCamera(const Grid& grid, Camera& camera);

/// Puts the light where the key light of ParaView's light kit shines from: 50 degrees above and 10
/// degrees to the right of the camera, as far from the focal point as the camera.
void PlaceLight(const Camera& camera, Light& light);
}

#endif
