// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ShaderRays.h"

#include "render/Ray.h"
#include "scene/GridMatrix.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
ClipPlane::ClipPlane(const glm::dmat4& clipToIndex, double clipDepth)
  : depth(clipDepth)
{
  const glm::dvec4 point = clipToIndex * glm::dvec4(0, 0, clipDepth, 1);
  this->weight = point.w;
  this->middle = Vec3(point) / point.w;
  this->right = Vec3(clipToIndex[0]) / point.w;
  this->up = Vec3(clipToIndex[1]) / point.w;
}

ShaderRays::ShaderRays(const Grid& grid, const View& view)
{
  const glm::dmat4 worldToIndex = WorldToIndex(grid);
  const glm::dmat4 clipToIndex = worldToIndex * view.clipToWorld;
  const glm::dmat4 indexToClip = glm::inverse(clipToIndex);
  Range<double> depths{ 1, -1 };
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vec3 last(grid.nodes - 1);
    const glm::dvec4 place = indexToClip *
      glm::dvec4((corner & 1) * last.x, (corner >> 1 & 1) * last.y, (corner >> 2) * last.z, 1);
    const bool isBehindEye = !(place.w > 0);
    depths.begin = std::min(depths.begin, isBehindEye ? -1.0 : place.z / place.w);
    depths.end = std::max(depths.end, isBehindEye ? -1.0 : place.z / place.w);
  }
  depths = { std::max(depths.begin, -1.0), std::min(depths.end, 1.0) };
  this->front = ClipPlane(clipToIndex, depths.begin);
  this->back = ClipPlane(clipToIndex, depths.end);
  const double across = std::abs(clipToIndex[0].w) + std::abs(clipToIndex[1].w);
  this->isPlain = across <= 1e-9 * std::min(this->front.weight, this->back.weight);
  this->seesBox = depths.end > depths.begin;
  const glm::dmat4 indexToWorld = glm::inverse(worldToIndex);
  for (const glm::dvec4& plane : view.planes)
  {
    const glm::dvec4 there = plane * indexToWorld;
    this->planes.push_back({ { float(there.x), float(there.y), float(there.z), float(there.w) } });
  }
}
}
