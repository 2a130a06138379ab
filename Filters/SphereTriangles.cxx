// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SphereTriangles.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace limpid
{
namespace
{
using Triangle = std::array<vtkIdType, 3>;
using Edge = std::array<vtkIdType, 2>;

struct Face
{
  Triangle corners;
  Vec3 normal;   ///< unit vector, outward
  double offset; ///< of the plane: dot(normal, corner)
  double lowest; ///< y coordinate of the lowest point of the sphere outside of the plane
};

Face MakeFace(const std::vector<Vec3>& points, const Triangle& corners)
{
  const Vec3& a = points[std::size_t(corners[0])];
  const Vec3& b = points[std::size_t(corners[1])];
  const Vec3& c = points[std::size_t(corners[2])];
  Face face;
  face.corners = corners;
  face.normal = glm::normalize(glm::cross(b - a, c - a));
  face.offset = glm::dot(face.normal, a);
  const double opening = std::acos(std::min(std::max(face.offset, -1.0), 1.0));
  const double toBottom = std::acos(std::min(std::max(-face.normal.y, -1.0), 1.0));
  face.lowest = toBottom > opening ? -std::cos(toBottom - opening) : -1.0;
  return face;
}

// Returns the faces of the first tetrahedron, oriented outward.
std::vector<Face> FirstFaces(const std::vector<Vec3>& points)
{
  std::array<vtkIdType, 4> ids{ { 0, 1, 2, 3 } };
  const Vec3 inward = points[3] - points[0];
  if (glm::dot(glm::cross(points[1] - points[0], points[2] - points[0]), inward) > 0)
  {
    std::swap(ids[1], ids[2]);
  }
  return { MakeFace(points, { { ids[0], ids[1], ids[2] } }),
    MakeFace(points, { { ids[0], ids[2], ids[3] } }),
    MakeFace(points, { { ids[2], ids[1], ids[3] } }),
    MakeFace(points, { { ids[1], ids[0], ids[3] } }) };
}

// Returns the edges that only one of the triangles has, in the direction they have there.
std::vector<Edge> RimOf(const std::vector<Triangle>& triangles)
{
  std::vector<Edge> edges;
  for (const Triangle& corners : triangles)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      edges.push_back({ { corners[i], corners[(i + 1) % 3] } });
    }
  }
  const auto key = [](const Edge& edge) { return std::minmax(edge[0], edge[1]); };
  std::sort(edges.begin(), edges.end(),
    [&key](const Edge& one, const Edge& other) { return key(one) < key(other); });
  std::vector<Edge> rim;
  for (std::size_t i = 0; i < edges.size();)
  {
    const bool isInside = i + 1 < edges.size() && key(edges[i]) == key(edges[i + 1]);
    if (!isInside)
    {
      rim.push_back(edges[i]);
    }
    i += isInside ? 2 : 1;
  }
  return rim;
}
}

std::vector<Triangle> TriangulateSphere(const std::vector<Vec3>& points)
{
  constexpr double rounding = 1e-9; // of heights; far above rounding errors, far below the spacing
  std::vector<Triangle> finished;
  std::vector<Face> open = FirstFaces(points); // faces that a later point may be in front of
  for (std::size_t id = 4; id < points.size(); ++id)
  {
    const Vec3& point = points[id];
    std::vector<Triangle> visible;
    std::size_t kept = 0;
    for (const Face& face : open)
    {
      if (glm::dot(face.normal, point) > face.offset)
      {
        visible.push_back(face.corners);
      }
      else if (face.lowest > point.y + rounding)
      {
        finished.push_back(face.corners);
      }
      else
      {
        open[kept++] = face;
      }
    }
    open.resize(kept);
    for (const Edge& edge : RimOf(visible))
    {
      open.push_back(MakeFace(points, { { edge[0], edge[1], static_cast<vtkIdType>(id) } }));
    }
  }
  for (const Face& face : open)
  {
    finished.push_back(face.corners);
  }
  return finished;
}
}
