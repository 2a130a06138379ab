// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_scene_GridCorners_h
#define limpid_scene_GridCorners_h

#include "scene/Grid.h"

#include <vector>

namespace limpid
{
/// Returns the eight corners of the box of a grid's nodes [length].
inline std::vector<Vec3> CornersOf(const Grid& grid)
{
  const Vec3 last = Vec3(grid.nodes) - 1.0;
  std::vector<Vec3> corners;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vec3 side(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
    corners.push_back(grid.PointToWorld(side * last));
  }
  return corners;
}
}

#endif
