// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_scene_ViewSet_h
#define limpid_scene_ViewSet_h

#include "scene/RaySource.h"

#include <vector>

namespace limpid
{
enum class ViewKind
{
  Single,     ///< the camera only
  StereoPair, ///< the two eyes of a viewer
  Orbit       ///< cameras all around
};

/// The cameras that an extinction is optimised for, given one camera.
struct ViewSet
{
  ViewKind kind = ViewKind::Single;
  int count = 8;       ///< number of cameras of an orbit [1, 360]
  double eyeAngle = 2; ///< angle between the eyes, seen from the focal point [degrees]

  /// Throws limpid::Error if a value is invalid.
  void Require() const;
};

/// The first direction of an orbit.
enum class OrbitStart
{
  AtCamera,
  Fixed ///< a fixed direction, common to all cameras of the same orbit
};

/**
 * Returns the cameras of a set, at least one. They have the focal point of the given camera.
 *
 * Eyes are to the left and right of the camera, rotated about its focal point. An orbit is around
 * the world axis that points upwards in the camera's picture (UprightAxis), through its focal
 * point, at the camera's height and distance; its cameras are equally spaced.
 */
std::vector<Camera> CamerasOf(const ViewSet& views, const Camera& camera, OrbitStart start);
}

#endif
