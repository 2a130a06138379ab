// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "scene/OpaqueGeometry.h"

#include "backend/Backend.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
/// Returns the share of a node in front of a plane at this distance [nodes], negative if the plane
/// is in front of the node. The interpolation of the column of nodes has the extent of what is in
/// front of the plane and, unless a share would be negative, its centre: both agree for functions
/// that vary linearly.
float ShareInFront(double distance)
{
  constexpr double rounding = 2e-3; // of depths; for a plane on a node, its neighbours agree
  const bool onNode = std::abs(distance - std::round(distance)) < rounding;
  const double nodes = onNode ? std::round(distance) : distance;
  if (nodes >= 1 || nodes <= -1)
  {
    return nodes > 0 ? 1.0f : 0.0f;
  }
  const double lastInFront = nodes < 0 ? nodes + 1 : nodes; // from node to plane
  const double next = std::max(0.0, 0.5 * lastInFront * lastInFront - 1.0 / 6);
  return static_cast<float>(nodes < 0 ? next : 0.5 + lastInFront - next);
}

/// Computes the share of a node that is in front of the geometry.
class NodeInFront
{
public:
  NodeInFront(const OpaqueGeometry& geometry, const Grid& grid)
    : Geometry(geometry)
    , Nodes(grid)
    , WorldToClip(glm::inverse(geometry.clipToWorld))
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const glm::dvec4 step =
        this->WorldToClip * glm::dvec4(grid.direction[axis] * grid.spacing[axis], 0);
      this->Reach += glm::dvec2(step.x * step.x, step.y * step.y);
    }
    this->Reach = glm::sqrt(this->Reach);
  }

  /// Returns the mean over the part of the picture that is closer to this node than to others:
  /// edges of the geometry run between nodes.
  float operator()(const Vec3& index) const
  {
    const Vec3 node = this->Nodes.PointToWorld(index);
    const glm::dvec4 clip = this->WorldToClip * glm::dvec4(node, 1);
    if (!(clip.w > 0))
    {
      return 1;
    }
    const Vec3 place = Vec3(clip) / clip.w;
    const glm::dvec2 step = this->Reach / clip.w / double(across);
    float sum = 0;
    for (int part = 0; part < across * across; ++part)
    {
      const double right = part % across - 0.5 * (across - 1);
      const double up = part / across - 0.5 * (across - 1);
      sum += this->At(node, place, { place.x + right * step.x, place.y + up * step.y });
    }
    return sum / (across * across);
  }

private:
  static constexpr int across = 3; ///< number of samples along each axis

  /// `place`: position of the node; `beside`: the same or close to it, where the depth is looked
  /// up. Both in clip coordinates.
  float At(const Vec3& node, const Vec3& place, const glm::dvec2& beside) const
  {
    const double column = (beside.x + 1) * 0.5 * this->Geometry.width;
    const double row = (beside.y + 1) * 0.5 * this->Geometry.height;
    const bool inPicture =
      column >= 0 && column < this->Geometry.width && row >= 0 && row < this->Geometry.height;
    if (!inPicture)
    {
      return 1;
    }
    const auto pixel = std::size_t(row) * std::size_t(this->Geometry.width) + std::size_t(column);
    const double end = this->Geometry.depth[pixel];
    return end < 1 ? ShareInFront(this->NodesTo(node, { place.x, place.y, end }, end > place.z))
                   : 1.0f;
  }

  /// Returns the distance from a node to a point in clip coordinates on its ray; negative if the
  /// point is in front [nodes].
  double NodesTo(const Vec3& node, const Vec3& clip, bool behind) const
  {
    const glm::dvec4 point = this->Geometry.clipToWorld * glm::dvec4(clip, 1);
    const double nodes = glm::length(this->Nodes.DirectionToIndex(Vec3(point) / point.w - node));
    return behind ? nodes : -nodes;
  }

  const OpaqueGeometry& Geometry;
  const Grid& Nodes;
  glm::dmat4 WorldToClip;
  glm::dvec2 Reach{ 0.0 }; ///< width and height of a node, before the division by w
};
}

std::vector<float> OpaqueGeometry::InFront(const Grid& grid, const float* importance) const
{
  const NodeInFront inFront(*this, grid);
  std::vector<float> found(static_cast<std::size_t>(grid.NodeCount()));
  constexpr Index rowsPerTask = 16;
  ParallelFor(Index(grid.nodes.y) * grid.nodes.z, rowsPerTask,
    [&](Index row)
    {
      const auto j = static_cast<int>(row % grid.nodes.y);
      const auto k = static_cast<int>(row / grid.nodes.y);
      for (int i = 0; i < grid.nodes.x; ++i)
      {
        const auto node = static_cast<std::size_t>(row * grid.nodes.x + i);
        const float all = importance[node];
        found[node] = all > 0 ? all * inFront({ i, j, k }) : 0.0f;
      }
    });
  return found;
}
}
