// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_scene_UprightAxis_h
#define limpid_scene_UprightAxis_h

#include "scene/RaySource.h"

namespace limpid
{
/**
 * The axis of the world, of unit length, that is upwards in the picture of a camera. The camera's
 * own view-up does not tell: seen from 50 degrees above the horizon, it is nearer to an axis that
 * points away. Here it is the axis that is least rolled about the axis of view. Where there are
 * two, since the camera looks along the plane of both, it is the one that the camera is above
 * rather than below.
 */
Vec3 UprightAxis(const Camera& camera);
}

#endif
