// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_scene_RaySource_h
#define limpid_scene_RaySource_h

#include "math/Vec.h"

#include <array>
#include <vector>

namespace limpid
{
struct Grid;

/// A camera by VTK's conventions, in world coordinates.
struct Camera
{
  Vec3 position{ 0.0, 0.0, 1.0 };
  Vec3 focalPoint{ 0.0 };
  Vec3 viewUp{ 0.0, 1.0, 0.0 };
  double viewAngle = 30.0;    ///< vertical view angle, perspective only [degrees]
  bool parallel = false;      ///< parallel instead of perspective projection
  double parallelScale = 1.0; ///< half the height of the picture, parallel only [length]
  double aspect = 1.0;        ///< width over height of the picture

  /// Corners of the picture in any plane in front of the camera, in cyclic order; empty: they
  /// follow from view angle, parallel scale and aspect. For off-axis pictures and for
  /// transformations that do not preserve right angles.
  std::vector<Vec3> corners;
};

bool operator==(const Camera& one, const Camera& other);

enum class LightType
{
  Point,
  Directional
};

/// The light that the extinction is optimised for, in world coordinates.
struct Light
{
  LightType type = LightType::Point;
  Vec3 position{ 0.0, 0.0, 1.0 };
  Vec3 focalPoint{ 0.0 }; ///< directional: the light travels from position towards this point
};

bool operator==(const Light& one, const Light& other);

/**
 * The origin of a family of rays in the index space of a grid: the camera or the light.
 *
 * Rays of a point eye start at `origin`; all rays of a parallel eye have the direction `direction`.
 */
struct RaySource
{
  bool parallel = false;
  Vec3 origin{ 0.0 };    ///< point eye: its position [index]
  Vec3 direction{ 0.0 }; ///< parallel eye: direction of the rays [index], of any length but zero

  /// A condition on rays. A ray is in view if all planes have dot(normal, ray) + offset >= 0, where
  /// `ray` is the ray's direction (point eye) or any of its points (parallel eye) [index].
  struct Plane
  {
    Vec3 normal{ 0.0 };
    double offset = 0;
  };
  std::vector<Plane> viewPlanes; ///< empty: every ray is in view
};

/// Returns the eye of a camera. `restrictToView`: add the planes of its frustum. Throws
/// limpid::Error if the camera has no view direction.
RaySource SourceOfCamera(const Camera& camera, const Grid& grid, bool restrictToView);

/// Returns the eye of a light. Throws limpid::Error if a directional light has no direction.
RaySource SourceOfLight(const Light& light, const Grid& grid);

/// Returns an upper bound of the length of a ray in the box of a grid between two slices of nodes
/// along the axis on which it advances most [length].
double LongestLayer(const RaySource& source, const Grid& grid);
}

#endif
