// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "PickedStructure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace limpid
{
namespace
{
constexpr double LeastOpacity = 1.0 / 256; // of a structure that is seen

// Returns the part of a segment, in [0, 1] along it, whose nearest node is in the grid; empty if
// the second number is not above the first.
std::array<double, 2> PartInside(const Grid& grid, const Vec3& begin, const Vec3& end)
{
  std::array<double, 2> part{ { 0, 1 } };
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = -0.5 - begin[axis];
    const double high = grid.nodes[axis] - 0.5 - begin[axis];
    const double step = end[axis] - begin[axis];
    if (step == 0)
    {
      part[1] = low < 0 && high > 0 ? part[1] : 0;
      continue;
    }
    part[0] = std::max(part[0], std::min(low / step, high / step));
    part[1] = std::min(part[1], std::max(low / step, high / step));
  }
  return part;
}
}

StructureRow PickedStructure(const Grid& grid, const StructureRow* rows, const float* extinction,
  const Vec3& begin, const Vec3& end)
{
  const Vec3 first = grid.PointToIndex(begin);
  const Vec3 last = grid.PointToIndex(end);
  const std::array<double, 2> inside = PartInside(grid, first, last);
  const double nodes = glm::length(last - first) * (inside[1] - inside[0]);
  if (!(nodes > 0))
  {
    return 0;
  }
  const int samples = static_cast<int>(std::ceil(2 * nodes));
  const double step = (inside[1] - inside[0]) / samples;
  const double length = glm::length(end - begin) * step;
  double transmittance = 1;
  std::map<StructureRow, double> seen; // opacity
  for (int i = 0; i < samples; ++i)
  {
    const Vec3 place = glm::mix(first, last, inside[0] + (i + 0.5) * step);
    Index node = 0;
    for (int axis = 2; axis >= 0; --axis)
    {
      const Index at = std::lround(place[axis]);
      node = node * grid.nodes[axis] + std::clamp<Index>(at, 0, grid.nodes[axis] - 1);
    }
    const double passed = std::exp(-double(extinction[node]) * length);
    seen[rows[node]] += transmittance * (1 - passed);
    transmittance *= passed;
  }
  seen.erase(0);
  const auto most = std::max_element(seen.begin(), seen.end(),
    [](const auto& one, const auto& other) { return one.second < other.second; });
  return most != seen.end() && most->second > LeastOpacity ? most->first : StructureRow(0);
}
}
