// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/DirectionMesh.h"

#include <algorithm>
#include <limits>

namespace limpid
{
double DirectionMesh::At(const std::vector<double>& values, const Vec3& direction) const
{
  double inside = -std::numeric_limits<double>::infinity();
  double value = 0;
  for (const std::array<int, 3>& triangle : this->triangles)
  {
    const Vec3& a = this->directions[std::size_t(triangle[0])];
    const Vec3& b = this->directions[std::size_t(triangle[1])];
    const Vec3& c = this->directions[std::size_t(triangle[2])];
    const Vec3 shares(glm::dot(direction, glm::cross(b, c)), glm::dot(direction, glm::cross(c, a)),
      glm::dot(direction, glm::cross(a, b)));
    const double sum = shares.x + shares.y + shares.z;
    const double least = std::min({ shares.x, shares.y, shares.z }) / sum;
    if (sum > 0 && least > inside)
    {
      inside = least;
      const Vec3 weights = glm::max(shares / sum, Vec3(0.0));
      value = (weights.x * values[std::size_t(triangle[0])] +
                weights.y * values[std::size_t(triangle[1])] +
                weights.z * values[std::size_t(triangle[2])]) /
        (weights.x + weights.y + weights.z);
    }
  }
  return value;
}

std::vector<std::vector<int>> DirectionMesh::Neighbours() const
{
  std::vector<std::vector<int>> neighbours(this->directions.size());
  for (const std::array<int, 3>& triangle : this->triangles)
  {
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      std::vector<int>& ofCorner = neighbours[std::size_t(triangle[corner])];
      ofCorner.push_back(triangle[(corner + 1) % 3]);
      ofCorner.push_back(triangle[(corner + 2) % 3]);
    }
  }
  for (std::vector<int>& ofOne : neighbours)
  {
    std::sort(ofOne.begin(), ofOne.end());
    ofOne.erase(std::unique(ofOne.begin(), ofOne.end()), ofOne.end());
  }
  return neighbours;
}
}
