// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_scene_UprightAxis_h
#define limpid_scene_UprightAxis_h

#include "scene/RaySource.h"

namespace limpid
{
/**
 * Returns the world axis, as a unit vector, that points upwards in a camera's picture. The camera's
 * own view-up is not sufficient: seen from 50 degrees above the horizon, it is closer to an axis
 * that points away from the camera. This is the axis that is least rolled about the view direction.
 * If there are two, since the camera looks along their plane, it is the one that the camera is
 * above rather than below.
 */
Vec3 UprightAxis(const Camera& camera);
}

#endif
