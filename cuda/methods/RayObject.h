// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_methods_RayObject_h
#define limpid_methods_RayObject_h

#include "math/Macros.h"

namespace limpid
{
/**
 * The object on a ray at which Viola et al. [VKG04] start to draw: cylindrical maximum importance
 * projection as in Section 4.3 of [HG24]. Objects are the intervals of the ray with importance
 * above 0.5. Everything in front of the one with the highest importance is clipped. Of several
 * equal ones the first is taken. Without objects nothing is clipped.
 */
struct RayObject
{
  static constexpr float threshold = 0.5f;    ///< level set that bounds an object
  static constexpr float everything = -1e30f; ///< begin if nothing is clipped

  float begin = everything;  ///< begin of the most important object, in the unit of `at`
  float most = 0;            ///< its importance [0, 1]; 0 if there is none yet
  float opened = everything; ///< begin of the object that contains the last sample
  float lastAt = everything;
  float lastImportance = 0;

  /// Adds the next sample, front to back. `at`: its position. Importance is linear between
  /// samples.
  LIMPID_HD LIMPID_INLINE void Meet(float at, float importance)
  {
    const bool inside = importance > threshold;
    if (inside && !(this->lastImportance > threshold))
    {
      // If there is no sample before it, the object extends to the begin of the ray.
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
