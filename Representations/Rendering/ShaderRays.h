// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The rays of a view in the form that a shader computes them from, in single precision.

#ifndef limpid_ShaderRays_h
#define limpid_ShaderRays_h

#include "math/Vec.h"

#include <array>
#include <vector>

namespace limpid
{
struct Grid;
struct View;

/// A plane of clip coordinates: its points, by their place in the picture in [-1, 1].
struct ClipPlane
{
  double depth = 0;  ///< clip z
  double weight = 1; ///< the fourth homogeneous coordinate of its points, in front of which it is 1
  Vec3 middle{ 0 };  ///< [index]
  Vec3 right{ 0 };   ///< from the middle to the right border
  Vec3 up{ 0 };

  ClipPlane() = default;
  ClipPlane(const glm::dmat4& clipToIndex, double clipDepth);
};

/**
 * See RayMaker. Rays go from a plane in front of the box to one behind it, both as near as
 * possible, so that single precision suffices wherever the camera and its clipping range are.
 */
struct ShaderRays
{
  ClipPlane front;
  ClipPlane back;
  std::vector<std::array<float, 4>> planes; ///< see View::planes [index]
  bool seesBox = false; ///< whether any part of the box is within the clipping range
  bool isPlain = false; ///< whether the depth of a point depends on clip z alone, as in any usual
                        ///< projection; others are not supported

  ShaderRays(const Grid& grid, const View& view);
};
}

#endif
