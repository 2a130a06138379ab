// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_RaySources_h
#define limpid_testing_RaySources_h

#include "scene/RaySource.h"

namespace limpid
{
/// `origin`: [index].
inline RaySource PointAt(const Vec3& origin)
{
  RaySource source;
  source.origin = origin;
  return source;
}

/// `direction`: of travel [index].
inline RaySource Parallel(const Vec3& direction)
{
  RaySource source;
  source.parallel = true;
  source.direction = direction;
  return source;
}
}

#endif
