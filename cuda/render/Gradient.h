// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The gradient of a field at a node, the same for all backends.

#ifndef limpid_render_Gradient_h
#define limpid_render_Gradient_h

#include "backend/Simd.h"
#include "math/Vec.h"
#include "render/RayLight.h"

#include <cmath>

namespace limpid
{
/// The neighbours of a node along an axis, between which the difference is taken.
struct Neighbours
{
  int before;
  int after;

  LIMPID_HD LIMPID_INLINE Neighbours(int at, int count)
    : before(at > 0 ? at - 1 : 0)
    , after(at + 1 < count ? at + 1 : count - 1)
  {
  }

  /// One over their distance [1/nodes].
  LIMPID_HD LIMPID_INLINE float Share() const
  {
    return this->after > this->before ? 1.0f / float(this->after - this->before) : 0.0f;
  }
};

struct GradientVector
{
  float values[3];

  LIMPID_HD LIMPID_INLINE float SquaredLength() const
  {
    return this->values[0] * this->values[0] + this->values[1] * this->values[1] +
      this->values[2] * this->values[2];
  }
};

/// World gradient [1/length] from differences per node along the axes of a grid.
LIMPID_HD LIMPID_INLINE GradientVector GradientOf(
  const Vec3& steps, const Mat3& toWorld, const Vec3& spacing)
{
  const Vec3 gradient = toWorld * (steps / spacing);
  return { { float(gradient.x), float(gradient.y), float(gradient.z) } };
}

/// What packed gradients are multiplied with. `largest`: square of the largest length.
LIMPID_HD LIMPID_INLINE float GradientUnit(float largest)
{
  const float most = std::sqrt(largest);
  return most > 0 ? packedOne / most : 0.0f;
}
}

#endif
