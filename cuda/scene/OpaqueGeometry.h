// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Opaque geometry in front of parts of the volume, as a picture of its depth.

#ifndef limpid_scene_OpaqueGeometry_h
#define limpid_scene_OpaqueGeometry_h

#include "scene/Grid.h"

#include <vector>

namespace limpid
{
/**
 * The depths where the rays of a camera end. What is behind is not visible, so for these rays an
 * importance is reduced to its part in front.
 */
struct OpaqueGeometry
{
  int width = 0;  ///< width of the picture [pixels]
  int height = 0; ///< height of the picture [pixels], bottom row first

  /// The matrix from clip coordinates of the picture to world coordinates, see View.
  glm::dmat4 clipToWorld{ 1.0 };

  /// Clip z of the geometry at each pixel, in [-1, 1]; 1: there is none.
  std::vector<float> depth;

  /// Returns an importance at the nodes of a grid such that its interpolation is the part in front.
  /// Outside of the picture, all of it is kept.
  std::vector<float> InFront(const Grid& grid, const float* importance) const;

  bool operator==(const OpaqueGeometry& other) const
  {
    return this->width == other.width && this->height == other.height &&
      this->clipToWorld == other.clipToWorld && this->depth == other.depth;
  }
};
}

#endif
