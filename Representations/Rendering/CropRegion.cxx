// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "CropRegion.h"

#include <tuple>

namespace limpid
{
bool CropRegion::Contains(const Grid& grid, const Vec3& index, double reach) const
{
  const Vec3 point = grid.PointToWorld(index);
  for (const glm::dvec4& plane : this->planes)
  {
    const Vec3 perEdge = glm::abs(Vec3(plane) * grid.direction) * grid.spacing;
    const double outward = reach * (perEdge.x + perEdge.y + perEdge.z);
    if (!(glm::dot(plane, glm::dvec4(point, 1.0)) >= -outward))
    {
      return false;
    }
  }
  if (!this->hasRegions)
  {
    return true;
  }
  int region = 0;
  int stride = 1;
  for (int axis = 0; axis < 3; ++axis, stride *= 3)
  {
    const double low = this->limits[2 * std::size_t(axis)];
    const double high = this->limits[2 * std::size_t(axis) + 1];
    region += stride * (point[axis] < low ? 0 : (point[axis] > high ? 2 : 1));
  }
  return (this->regions & (1 << region)) != 0;
}

bool CropRegion::operator==(const CropRegion& other) const
{
  return std::tie(this->planes, this->hasRegions, this->limits, this->regions) ==
    std::tie(other.planes, other.hasRegions, other.limits, other.regions);
}
}
