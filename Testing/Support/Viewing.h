// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Cameras as matrices from clip to world coordinates, made without a matrix inversion.

#ifndef limpid_testing_Viewing_h
#define limpid_testing_Viewing_h

#include "math/Vec.h"

#include <cmath>

namespace limpid
{
/// Where the camera is, and its orthonormal axes.
struct Frustum
{
  Vec3 eye;
  Vec3 right;
  Vec3 up;
  Vec3 forward;
};

inline Frustum LookAt(const Vec3& eye, const Vec3& at, const Vec3& viewUp)
{
  const Vec3 forward = glm::normalize(at - eye);
  const Vec3 right = glm::normalize(glm::cross(forward, viewUp));
  return { eye, right, glm::cross(right, forward), forward };
}

/// `angle`: vertical opening [degrees]. A clip position (x, y, z, 1) belongs to the view depth d
/// with 1 / d linear in z, and to eye + d (forward + x tan right + y tan up).
inline glm::dmat4 Perspective(
  const Frustum& camera, double angle, double aspect, double nearest, double farthest)
{
  const double tangent = std::tan(0.5 * angle * std::acos(-1.0) / 180);
  const double slope = -0.5 * (farthest - nearest) / (farthest * nearest);
  const double middle = 0.5 * (farthest + nearest) / (farthest * nearest);
  return glm::dmat4(glm::dvec4(aspect * tangent * camera.right, 0.0),
    glm::dvec4(tangent * camera.up, 0.0), slope * glm::dvec4(camera.eye, 1.0),
    glm::dvec4(camera.forward + middle * camera.eye, middle));
}

/// `scale`: half the height of the picture [length]. `shear`: how far a ray moves right per depth.
inline glm::dmat4 Parallel(const Frustum& camera, double scale, double aspect, double nearest,
  double farthest, double shear = 0)
{
  const Vec3 way = camera.forward + shear * camera.right;
  return glm::dmat4(glm::dvec4(aspect * scale * camera.right, 0.0),
    glm::dvec4(scale * camera.up, 0.0), glm::dvec4(0.5 * (farthest - nearest) * way, 0.0),
    glm::dvec4(camera.eye + 0.5 * (farthest + nearest) * way, 1.0));
}

/// Clip z of a view depth in a perspective view.
inline double ClipDepth(double depth, double nearest, double farthest)
{
  return (farthest + nearest) / (farthest - nearest) -
    2 * farthest * nearest / ((farthest - nearest) * depth);
}
}

#endif
