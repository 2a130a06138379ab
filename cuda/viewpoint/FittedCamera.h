// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Cameras in given directions whose pictures show the whole of a box.

#ifndef limpid_viewpoint_FittedCamera_h
#define limpid_viewpoint_FittedCamera_h

#include "scene/RaySource.h"
#include "viewpoint/Search.h"

#include <vector>

namespace limpid
{
/// What is in the middle of a fitted picture.
enum class Aim
{
  Centre, ///< the centre of the orbit, wherever the box is
  Box     ///< the box: the camera turns a little away from the centre, and stays upright
};

/**
 * The upright camera in a direction of unit length from the orbit's centre whose picture shows all
 * corners of a box and as little beside them as possible: they reach 95 % of the way from the
 * picture's middle to an edge. For that the camera moves along the direction (perspective), or
 * its parallel scale changes (parallel projection). View angle and aspect are those of the orbit.
 * The focal point is where the camera's axis is next to the centre. Throws limpid::Error unless
 * there are corners and the picture has an area.
 */
Camera FittedCamera(
  const Orbit& orbit, const std::vector<Vec3>& corners, const Vec3& direction, Aim aim);

/// An orbit whose cameras in all of these directions show all corners, at one distance and one
/// parallel scale: the largest that any of them needs.
Orbit FittedOrbit(
  const Orbit& orbit, const std::vector<Vec3>& corners, const std::vector<Vec3>& directions);
}

#endif
