// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "scene/RaySource.h"

#include "math/Number.h"
#include "math/Require.h"
#include "scene/Grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace limpid
{
namespace
{
bool IsFinite(const Vec3& v)
{
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

struct Text
{
  const Vec3& v;
};

std::ostream& operator<<(std::ostream& stream, const Text& text)
{
  return stream << '(' << text.v.x << ", " << text.v.y << ", " << text.v.z << ')';
}

/// Bound of the relative rounding errors of conversions to index space.
constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();

/// Converts a position to index space. If only rounding separates it from a plane of nodes, it is
/// moved onto that plane: the side of a face that an eye is on decides whether it sees along the
/// face.
Vec3 IndexOf(const Vec3& position, const Grid& grid)
{
  Vec3 index = grid.PointToIndex(position);
  const double size = glm::length(position) + glm::length(grid.origin);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double node = std::round(index[axis]);
    const bool beside = std::abs(index[axis] - node) * grid.spacing[axis] <= rounding * size;
    index[axis] = beside ? node : index[axis];
  }
  return index;
}

/// Returns the unit vector from `from` to `to`.
Vec3 DirectionOf(const char* what, const Vec3& from, const Vec3& to)
{
  LIMPID_REQUIRE(IsFinite(from) && IsFinite(to),
    "The position " << Text{ from } << " or focal point " << Text{ to } << " of the " << what
                    << " is not finite (rays cannot be constructed). Set finite coordinates.");
  const Vec3 difference = to - from;
  const double length = glm::length(difference);
  LIMPID_REQUIRE(length > 0,
    "The " << what << " is at its own focal point " << Text{ to }
           << " (its direction is undefined). Move one of the two.");
  return difference / length;
}

/// Returns this direction in index space; parallel to a plane of nodes if only rounding tilts it.
Vec3 IndexDirectionOf(const char* what, const Vec3& from, const Vec3& to, const Grid& grid)
{
  Vec3 index = grid.DirectionToIndex(DirectionOf(what, from, to));
  const double size = (glm::length(from) + glm::length(to)) / glm::length(to - from);
  for (int axis = 0; axis < 3; ++axis)
  {
    const bool leaves = std::abs(index[axis]) * grid.spacing[axis] > rounding * (1 + size);
    index[axis] = leaves ? index[axis] : 0.0;
  }
  return index;
}

/// Converts a world plane through `point` with inward `normal` to a condition on rays in index
/// space.
RaySource::Plane PlaneOf(const Grid& grid, const Vec3& normal, const Vec3& point, bool parallel)
{
  // n . (x - p) with x = origin + D S i has the index-space normal S D^T n.
  RaySource::Plane plane;
  plane.normal = (glm::transpose(grid.direction) * normal) * grid.spacing;
  plane.offset = parallel ? glm::dot(normal, grid.origin - point) : 0.0;
  return plane;
}

/// Adds the planes of a picture with a given opening.
void AddOpening(RaySource& eye, const Camera& camera, const Grid& grid, const Vec3& forward)
{
  Vec3 right = glm::cross(forward, camera.viewUp);
  if (!(glm::length(right) > 1e-12 * glm::length(camera.viewUp)))
  {
    // If view-up is parallel to the view direction, any upright direction is used, as in VTK.
    right = glm::cross(forward, std::abs(forward.x) < 0.9 ? Vec3(1, 0, 0) : Vec3(0, 1, 0));
  }
  right = glm::normalize(right);
  const Vec3 up = glm::cross(right, forward);
  const double halfHeight =
    camera.parallel ? camera.parallelScale : std::tan(0.5 * camera.viewAngle * pi / 180.0);
  const double halfWidth = halfHeight * camera.aspect;
  for (const double side : { -1.0, 1.0 })
  {
    if (camera.parallel)
    {
      eye.viewPlanes.push_back(
        PlaneOf(grid, -side * right, camera.position + side * halfWidth * right, true));
      eye.viewPlanes.push_back(
        PlaneOf(grid, -side * up, camera.position + side * halfHeight * up, true));
    }
    else
    {
      eye.viewPlanes.push_back(
        PlaneOf(grid, halfWidth * forward - side * right, camera.position, false));
      eye.viewPlanes.push_back(
        PlaneOf(grid, halfHeight * forward - side * up, camera.position, false));
    }
  }
}

void RequireOpening(const Camera& camera)
{
  LIMPID_REQUIRE(camera.parallel || (camera.viewAngle > 0 && camera.viewAngle < 180),
    "The camera's view angle is " << camera.viewAngle
                                  << " degrees (the perspective projection is undefined). Set an "
                                     "angle above 0 and below 180 degrees.");
  LIMPID_REQUIRE(!camera.parallel || camera.parallelScale > 0,
    "The camera's parallel scale is "
      << camera.parallelScale << " (the picture would have no height). Set a scale above zero.");
  LIMPID_REQUIRE(camera.aspect > 0,
    "The picture's aspect ratio is "
      << camera.aspect << " (the picture would have no width). Set a ratio above zero.");
}

/// Adds the planes through neighbouring corners of a picture and along the rays there.
void AddCorners(RaySource& eye, const Camera& camera, const Grid& grid, const Vec3& forward)
{
  const std::vector<Vec3>& corners = camera.corners;
  const Vec3 middle = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
  for (std::size_t i = 0; i < 4; ++i)
  {
    const Vec3& corner = corners[i];
    const Vec3 along = camera.parallel ? forward : corner - camera.position;
    Vec3 normal = glm::cross(along, corners[(i + 1) % 4] - corner);
    // The picture is on the inner side, for either orientation of the corners.
    const double inside = glm::dot(normal, middle - corner);
    const double size = glm::length(normal);
    LIMPID_REQUIRE(std::abs(inside) > 1e-12 * size * glm::length(middle - corner),
      "The picture's corners " << Text{ corners[0] } << ", " << Text{ corners[1] } << ", "
                               << Text{ corners[2] } << ", " << Text{ corners[3] }
                               << " span no area as seen from the camera (the view would contain "
                                  "no rays). Set corners that do.");
    normal *= (inside > 0 ? 1 : -1) / size;
    eye.viewPlanes.push_back(PlaneOf(grid, normal, corner, camera.parallel));
  }
}

void RequireCorners(const Camera& camera)
{
  LIMPID_REQUIRE(camera.corners.size() == 4,
    "The picture has " << camera.corners.size()
                       << " corners (the view is bounded by four planes). Give four or none.");
  for (const Vec3& corner : camera.corners)
  {
    LIMPID_REQUIRE(IsFinite(corner),
      "The corner " << Text{ corner }
                    << " of the picture is not finite (the planes that bound the view are "
                       "undefined). Set finite coordinates.");
  }
}
}

bool operator==(const Camera& one, const Camera& other)
{
  const auto values = [](const Camera& camera)
  {
    return std::tie(camera.position, camera.focalPoint, camera.viewUp, camera.viewAngle,
      camera.parallel, camera.parallelScale, camera.aspect, camera.corners);
  };
  return values(one) == values(other);
}

bool operator==(const Light& one, const Light& other)
{
  const auto values = [](const Light& light)
  { return std::tie(light.type, light.position, light.focalPoint); };
  return values(one) == values(other);
}

RaySource SourceOfCamera(const Camera& camera, const Grid& grid, bool restrictToView)
{
  const Vec3 forward = DirectionOf("camera", camera.position, camera.focalPoint);
  const bool hasCorners = !camera.corners.empty();
  hasCorners ? RequireCorners(camera) : RequireOpening(camera);
  RaySource eye;
  eye.parallel = camera.parallel;
  eye.origin = IndexOf(camera.position, grid);
  eye.direction = IndexDirectionOf("camera", camera.position, camera.focalPoint, grid);
  if (restrictToView)
  {
    hasCorners ? AddCorners(eye, camera, grid, forward) : AddOpening(eye, camera, grid, forward);
  }
  return eye;
}

RaySource SourceOfLight(const Light& light, const Grid& grid)
{
  RaySource eye;
  eye.parallel = light.type == LightType::Directional;
  if (eye.parallel)
  {
    eye.direction = IndexDirectionOf("light", light.position, light.focalPoint, grid);
  }
  else
  {
    LIMPID_REQUIRE(IsFinite(light.position),
      "The light's position "
        << Text{ light.position }
        << " is not finite (rays cannot be constructed). Set finite coordinates.");
  }
  eye.origin = IndexOf(light.position, grid);
  return eye;
}

double LongestLayer(const RaySource& source, const Grid& grid)
{
  // How far rays to points of the box advance along each axis.
  Vec3 least(0.0);
  Vec3 most(0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double first = source.parallel ? source.direction[axis] : -source.origin[axis];
    const double last = source.parallel ? first : first + (grid.nodes[axis] - 1);
    most[axis] = std::max(std::abs(first), std::abs(last));
    least[axis] = first * last > 0 ? std::min(std::abs(first), std::abs(last)) : 0.0;
  }
  const double depth = std::max({ least.x, least.y, least.z }); // along the depth axis, at least
  const Vec3 slopes = glm::min(most / std::max(depth, 1e-300), Vec3(1.0));
  const auto lengthOf = [&](int depthAxis)
  {
    Vec3 step = slopes * grid.spacing;
    step[depthAxis] = grid.spacing[depthAxis];
    return most[depthAxis] < depth ? 0.0 : glm::length(step);
  };
  return std::max({ lengthOf(0), lengthOf(1), lengthOf(2) });
}
}
