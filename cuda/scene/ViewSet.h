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
  Single,     ///< the camera alone
  StereoPair, ///< the two eyes of a viewer
  Orbit       ///< all round
};

/// Which cameras an extinction is for, beside the one that is there.
struct ViewSet
{
  ViewKind kind = ViewKind::Single;
  int count = 8;       ///< cameras of an orbit [1, 360]
  double eyeAngle = 2; ///< between eyes, as seen from the focal point [degrees]

  /// Throws limpid::Error on a value that cannot be worked with.
  void Require() const;
};

/// Where an orbit begins.
enum class OrbitStart
{
  AtCamera,
  Fixed ///< in a direction that all cameras of the same orbit have in common
};

/**
 * The cameras of a set, one at least, that look at the focal point of a camera as it does.
 *
 * Eyes are left and right of it about its focal point. An orbit is about the axis of the world that
 * is upwards in the camera's picture (UprightAxis), through its focal point, as high above that and
 * as far away as the camera; its cameras are equally spaced.
 */
std::vector<Camera> CamerasOf(const ViewSet& views, const Camera& camera, OrbitStart start);
}

#endif
