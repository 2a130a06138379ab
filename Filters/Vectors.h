// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_Vectors_h
#define limpid_Vectors_h

#include "math/Vec.h"

namespace limpid
{
/// Converts a point or a direction of VTK.
inline Vec3 ToVec3(const double* vector)
{
  return { vector[0], vector[1], vector[2] };
}
}

#endif
