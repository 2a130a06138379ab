// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_math_Angle_h
#define limpid_math_Angle_h

#include "math/Vec.h"

#include <cmath>

namespace limpid
{
/// Returns the angle between two directions of any length [radians]; accurate for small angles,
/// too.
inline double AngleBetween(const Vec3& one, const Vec3& other)
{
  return std::atan2(glm::length(glm::cross(one, other)), glm::dot(one, other));
}
}

#endif
