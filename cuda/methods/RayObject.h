// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_methods_RayObject_h
#define limpid_methods_RayObject_h

#include "math/Macros.h"

namespace limpid
{
/**
 * The object on a ray from which Viola et al. [VKG04] begin to draw, their cylindrical maximum
 * importance projection as [HG24] has it in Section 4.3: objects are the stretches of the ray with
 * importance above 0.5, and what is in front of the one with the highest importance is clipped. Of
 * several that are equal it is the foremost. Where no object is, nothing is clipped.
 */
struct RayObject
{
  static constexpr float threshold = 0.5f;    ///< level set that bounds an object
  static constexpr float everything = -1e30f; ///< begin, where nothing is clipped

  float begin = everything;  ///< where the most important object begins, in the unit of `at`
  float most = 0;            ///< its importance, 0: there is none so far [0, 1]
  float opened = everything; ///< where the object begins that the last sample is in
  float lastAt = everything;
  float lastImportance = 0;

  /// The next sample, front to back. `at`: where it is; between samples importance is linear.
  LIMPID_HD LIMPID_INLINE void Meet(float at, float importance)
  {
    const bool inside = importance > threshold;
    if (inside && !(this->lastImportance > threshold))
    {
      // Without a sample in front, the object reaches to where the ray begins.
      const float share = (threshold - this->lastImportance) / (importance - this->lastImportance);
      this->opened =
        this->lastAt == everything ? everything : this->lastAt + share * (at - this->lastAt);
    }
    if (inside && importance > this->most)
    {
      this->most = importance;
      this->begin = this->opened;
    }
    this->lastAt = at;
    this->lastImportance = importance;
  }
};
}

#endif
