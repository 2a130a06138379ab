// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "viewpoint/FittedCamera.h"

#include "math/Number.h"
#include "math/Require.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace limpid
{
namespace
{
constexpr double margin = 0.95; // of the way to the picture's edge

/// How far points reach across a picture, from one side to the other: tangents of angles
/// (perspective), or lengths (parallel).
struct Reach
{
  double left = std::numeric_limits<double>::infinity();
  double right = -left;
  double bottom = left;
  double top = -left;

  /// The largest reach from the picture's middle, in units of half the picture's height.
  double FromMiddle(double aspect) const
  {
    return std::max({ -this->left / aspect, this->right / aspect, -this->bottom, this->top });
  }

  /// Half of what is between both sides, likewise.
  double Span(double aspect) const
  {
    return 0.5 * std::max((this->right - this->left) / aspect, this->top - this->bottom);
  }
};

Vec3 RightOf(const Camera& camera)
{
  return glm::normalize(glm::cross(camera.focalPoint - camera.position, camera.viewUp));
}

/// Nothing where a corner is beside or behind a perspective camera.
std::optional<Reach> ReachOf(const Camera& camera, const std::vector<Vec3>& corners)
{
  const Vec3 forward = glm::normalize(camera.focalPoint - camera.position);
  const Vec3 right = RightOf(camera);
  const Vec3 up = glm::cross(right, forward);
  Reach reach;
  for (const Vec3& corner : corners)
  {
    const Vec3 offset = corner - camera.position;
    const double depth = camera.parallel ? 1.0 : glm::dot(offset, forward);
    if (!(depth > 0))
    {
      return {};
    }
    const double x = glm::dot(offset, right) / depth;
    const double y = glm::dot(offset, up) / depth;
    reach.left = std::min(reach.left, x);
    reach.right = std::max(reach.right, x);
    reach.bottom = std::min(reach.bottom, y);
    reach.top = std::max(reach.top, y);
  }
  return reach;
}

/// The tangent in the middle between the angles of two.
double MiddleOf(double one, double other)
{
  return std::tan(0.5 * (std::atan(one) + std::atan(other)));
}

/// Fits perspective cameras in one direction.
class Fit
{
public:
  Fit(const Orbit& orbit, const std::vector<Vec3>& corners, const Vec3& direction, Aim aim)
    : From(orbit)
    , Corners(corners)
    , Direction(direction)
    , Aimed(aim)
    , Up(orbit.up)
    , HalfHeight(margin * std::tan(0.5 * orbit.viewAngle * pi / 180.0))
  {
  }

  /// Close to a pole, a camera cannot turn aside and stay upright: it then keeps what is upwards in
  /// the picture of the camera that looks at the centre.
  Camera Best()
  {
    constexpr double much = 0.9; // of the way to the edges
    const Camera upright = this->Nearest();
    if (ReachOf(upright, this->Corners)->Span(this->From.aspect) >= much * this->HalfHeight)
    {
      return upright;
    }
    this->Up = ViewUpOf(this->Direction, this->From.up);
    return this->Nearest();
  }

private:
  Camera Nearest() const
  {
    double radius = 0;
    for (const Vec3& corner : this->Corners)
    {
      radius = std::max(radius, glm::distance(corner, this->From.centre));
    }
    // From there, the sphere round all corners is in the picture.
    const double narrow = this->HalfHeight * std::min(1.0, this->From.aspect);
    double enough = radius / std::sin(std::atan(narrow));
    double tooClose = 0;
    Camera best = this->Ahead(enough);
    constexpr int halvings = 40;
    for (int i = 0; i < halvings; ++i)
    {
      const double distance = 0.5 * (tooClose + enough);
      const std::optional<Camera> camera = this->Showing(distance, best);
      best = camera ? *camera : best;
      (camera ? enough : tooClose) = distance;
    }
    return best;
  }

  /// The camera that looks at the centre.
  Camera Ahead(double distance) const
  {
    Orbit orbit = this->From;
    orbit.distance = distance;
    return orbit.At(this->Direction);
  }

  /// A camera at a distance that shows all corners, if there is one. `near`: a similar one.
  std::optional<Camera> Showing(double distance, const Camera& near) const
  {
    Camera camera = this->Ahead(distance);
    if (this->Aimed == Aim::Box)
    {
      this->TurnTo(near.focalPoint - near.position, camera);
    }
    std::optional<Reach> reach = ReachOf(camera, this->Corners);
    constexpr int mostTurns = 30;
    for (int i = 0; i < mostTurns && reach && this->Aimed == Aim::Box; ++i)
    {
      const double x = MiddleOf(reach->left, reach->right);
      const double y = MiddleOf(reach->bottom, reach->top);
      if (std::abs(x) + std::abs(y) < 1e-6 * this->HalfHeight)
      {
        break;
      }
      const Vec3 forward = glm::normalize(camera.focalPoint - camera.position);
      this->TurnTo(forward + x * RightOf(camera) + y * camera.viewUp, camera);
      reach = ReachOf(camera, this->Corners);
    }
    const bool shows = reach && reach->FromMiddle(this->From.aspect) <= this->HalfHeight;
    return shows ? std::optional<Camera>(camera) : std::nullopt;
  }

  /// Lets a camera look along a direction, at the point there that is next to the centre.
  void TurnTo(const Vec3& direction, Camera& camera) const
  {
    const Vec3 forward = glm::normalize(direction);
    camera.focalPoint =
      camera.position + glm::dot(this->From.centre - camera.position, forward) * forward;
    camera.viewUp = ViewUpOf(-forward, this->Up);
  }

  const Orbit& From;
  const std::vector<Vec3>& Corners;
  const Vec3 Direction;
  const Aim Aimed;
  Vec3 Up;
  const double HalfHeight; ///< of what is to be filled, as a tangent
};
}

Camera FittedCamera(
  const Orbit& orbit, const std::vector<Vec3>& corners, const Vec3& direction, Aim aim)
{
  LIMPID_REQUIRE(
    !corners.empty(), "There are no corners (the camera is fitted to them). Give those of a box.");
  LIMPID_REQUIRE(orbit.aspect > 0 && std::isfinite(orbit.aspect),
    "The picture's aspect ratio is "
      << orbit.aspect << " (the picture would have no area). Set a ratio above zero.");
  if (!orbit.parallel)
  {
    return Fit(orbit, corners, direction, aim).Best();
  }
  Camera camera = orbit.At(direction);
  camera.parallelScale = ReachOf(camera, corners)->FromMiddle(orbit.aspect) / margin;
  return camera;
}

Orbit FittedOrbit(
  const Orbit& orbit, const std::vector<Vec3>& corners, const std::vector<Vec3>& directions)
{
  Orbit fitted = orbit;
  fitted.distance = orbit.parallel ? orbit.distance : 0;
  fitted.parallelScale = orbit.parallel ? 0 : orbit.parallelScale;
  for (const Vec3& direction : directions)
  {
    const Camera camera = FittedCamera(orbit, corners, direction, Aim::Centre);
    const double distance = glm::distance(camera.position, orbit.centre);
    fitted.distance = std::max(fitted.distance, distance);
    fitted.parallelScale = std::max(fitted.parallelScale, camera.parallelScale);
  }
  return fitted;
}
}
