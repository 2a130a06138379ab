// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Opaque geometry in front of a part of the volume, as a picture of its depth.

#ifndef limpid_scene_OpaqueGeometry_h
#define limpid_scene_OpaqueGeometry_h

#include "scene/Grid.h"

#include <vector>

namespace limpid
{
/**
 * Where the rays of a camera end. They see nothing of what lies behind: to them, an importance is
 * what of it lies in front.
 */
struct OpaqueGeometry
{
  int width = 0;  ///< pixels
  int height = 0; ///< pixels, first row at the bottom

  /// From clip coordinates of the picture to world coordinates, see View.
  glm::dmat4 clipToWorld{ 1.0 };

  /// Clip z in [-1, 1] of what is opaque, of each pixel; 1: there is nothing.
  std::vector<float> depth;

  /// An importance at the nodes of a grid, so that between them it is that in front; all of it
  /// beside the picture.
  std::vector<float> InFront(const Grid& grid, const float* importance) const;

  bool operator==(const OpaqueGeometry& other) const
  {
    return this->width == other.width && this->height == other.height &&
      this->clipToWorld == other.clipToWorld && this->depth == other.depth;
  }
};
}

#endif
