// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "DrawingOrder.h"

#include "Vectors.h"
#include "ViewGeometry.h"

#include "vtkAbstractVolumeMapper.h"
#include "vtkCamera.h"
#include "vtkImageData.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace limpid
{
namespace
{
struct Span
{
  double low;
  double high;
};

// Returns the range of a box along a direction.
Span SpanOf(const Box& box, const Vec3& direction)
{
  const double start = glm::dot(box.corner, direction);
  Span span{ start, start };
  for (const Vec3& edge : box.edges)
  {
    const double reach = glm::dot(edge, direction);
    span.low += std::min(reach, 0.0);
    span.high += std::max(reach, 0.0);
  }
  return span;
}

// Returns directions of which at least one separates two disjoint boxes: the normals of their
// faces, and the cross products of an edge of each.
std::vector<Vec3> CandidateDirections(const Box& first, const Box& second)
{
  std::vector<Vec3> directions;
  const auto add = [&directions](const Vec3& a, const Vec3& b)
  {
    const Vec3 normal = glm::cross(a, b);
    const double length = glm::length(normal);
    if (length > 1e-9 * glm::length(a) * glm::length(b))
    {
      directions.push_back(normal / length);
    }
  };
  for (const Box* box : { &first, &second })
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      add(box->edges[axis], box->edges[(axis + 1) % 3]);
    }
  }
  for (const Vec3& a : first.edges)
  {
    for (const Vec3& b : second.edges)
    {
      add(a, b);
    }
  }
  return directions;
}

// Returns the position of the eye relative to the gap between two spans: -1 below, 0 inside, 1
// above.
int SideOfEye(vtkCamera* camera, const Vec3& direction, double low, double high)
{
  if (camera->GetParallelProjection())
  {
    const double toEye = -glm::dot(ToVec3(camera->GetDirectionOfProjection()), direction);
    return toEye > 0 ? 1 : (toEye < 0 ? -1 : 0);
  }
  const double eye = glm::dot(ToVec3(camera->GetPosition()), direction);
  return eye >= high ? 1 : (eye <= low ? -1 : 0);
}
}

Box BoxOfBounds(const double* bounds)
{
  Box box;
  box.corner = Vec3(bounds[0], bounds[2], bounds[4]);
  for (int axis = 0; axis < 3; ++axis)
  {
    box.edges[std::size_t(axis)][axis] = bounds[2 * axis + 1] - bounds[2 * axis];
  }
  return box;
}

Box BoxOf(vtkVolume* volume)
{
  auto* image = volume->GetMapper()
    ? vtkImageData::SafeDownCast(volume->GetMapper()->GetDataObjectInput())
    : nullptr;
  if (!image)
  {
    return BoxOfBounds(volume->GetBounds());
  }
  const glm::dmat4 toWorld = DataToWorld(volume);
  const int* extent = image->GetExtent();
  const auto at = [&](int i, int j, int k)
  {
    double point[3];
    image->TransformIndexToPhysicalPoint(extent[i], extent[2 + j], extent[4 + k], point);
    return TransformPoint(toWorld, ToVec3(point));
  };
  Box box;
  box.corner = at(0, 0, 0);
  box.edges = { { at(1, 0, 0) - box.corner, at(0, 1, 0) - box.corner, at(0, 0, 1) - box.corner } };
  return box;
}

Order OrderOf(const Box& first, const Box& second, vtkRenderer* renderer)
{
  bool apart = false;
  for (const Vec3& direction : CandidateDirections(first, second))
  {
    const Span a = SpanOf(first, direction);
    const Span b = SpanOf(second, direction);
    const double rounding = 1e-6 * std::min(a.high - a.low, b.high - b.low);
    const bool firstBelow = a.high <= b.low + rounding;
    const bool secondBelow = b.high <= a.low + rounding;
    if (!firstBelow && !secondBelow)
    {
      continue;
    }
    apart = true;
    const double low = firstBelow ? a.high : b.high;
    const double high = firstBelow ? b.low : a.low;
    const int side = SideOfEye(renderer->GetActiveCamera(), direction, low, high);
    if (side != 0)
    {
      // The box on the side of the eye hides the other.
      return (side > 0) == firstBelow ? Order::FirstFirst : Order::SecondFirst;
    }
  }
  return apart ? Order::Any : Order::Overlapping;
}
}
