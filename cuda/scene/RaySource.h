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
  double viewAngle = 30.0;    ///< vertical opening, perspective only [degrees]
  bool parallel = false;      ///< parallel instead of perspective projection
  double parallelScale = 1.0; ///< half the height of the picture, parallel only [length]
  double aspect = 1.0;        ///< width by height of the picture

  /// Corners of the picture in any plane in front of the camera, in cyclic order; empty: from view
  /// angle, parallel scale and aspect. For pictures that are off the axis or seen through a
  /// transformation that bends right angles.
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
  Vec3 focalPoint{ 0.0 }; ///< directional: the light goes from position towards this point
};

bool operator==(const Light& one, const Light& other);

/**
 * Where a family of rays comes from, in the index space of a grid: the camera or the light.
 *
 * Rays of a point eye start at `origin`; rays of a parallel eye all run along `direction`.
 */
struct RaySource
{
  bool parallel = false;
  Vec3 origin{ 0.0 };    ///< point eye: its position [index]
  Vec3 direction{ 0.0 }; ///< parallel eye: direction of travel [index], any length but zero

  /// A ray is in view if every plane's value is not negative: dot(normal, ray) + offset, where
  /// `ray` is the ray's direction (point eye) or any of its points (parallel eye) [index].
  struct Plane
  {
    Vec3 normal{ 0.0 };
    double offset = 0;
  };
  std::vector<Plane> viewPlanes; ///< empty: every ray is in view
};

/// The eye of a camera. `restrictToView` adds the frustum. Throws limpid::Error when the camera
/// has no view direction.
RaySource SourceOfCamera(const Camera& camera, const Grid& grid, bool restrictToView);

/// The eye of a light. Throws limpid::Error when a directional light has no direction.
RaySource SourceOfLight(const Light& light, const Grid& grid);
}

#endif
