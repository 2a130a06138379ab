// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_ResilientVoxel_h
#define limpid_optimize_ResilientVoxel_h

#include "backend/Simd.h"
#include "optimize/ExtinctionBounds.h"
#include "optimize/Pulls.h"

namespace limpid
{
/**
 * One step of resilient propagation [RB93] at every voxel, projected to the bounds. Each voxel has
 * its own step length, which grows while the derivative of the energy keeps its sign and shrinks
 * when the sign changes. The magnitude of the derivative does not matter, so voxels that receive
 * little light move like all others.
 *
 * Steps that smooth end at the minimum of the quadratic terms at the latest, with the visibility
 * terms taken as linear: smoothing has a few steps, in which what hides nothing would only follow
 * the first step lengths.
 *
 * The state of a voxel is one number: its step length with the sign of its last derivative.
 */
struct ResilientVoxel
{
  static constexpr const char* label = "resilient steps";

  const float* gradient;      ///< derivative of the visibility terms
  const float* base;          ///< mu-bar [1/length]
  const float* importance;    ///< [0, 1]
  float* state;               ///< step length with the sign of the last derivative [1/length]
  float* extinction;          ///< [1/length]
  PullsAtVoxels<float> pulls; ///< the regularisation of Eq. (26) and all others
  bool smooths;               ///< whether `gradient` and `pulls` include the pull of smoothing
  float longest;              ///< maximum step [1/length]
  float floor;                ///< smaller derivatives are rounding errors
  ExtinctionBounds<float> bounds;

  LIMPID_HD LIMPID_INLINE void operator()(Index voxel) const
  {
    constexpr float growth = 1.2f;
    constexpr float shrinkage = 0.5f;
    const float now = this->extinction[voxel];
    const float original = this->base[voxel];
    const float seen =
      Magnitude(this->gradient[voxel]) > this->floor ? this->gradient[voxel] : 0.0f;
    const float slope = this->pulls.AddedTo(seen, now, original, voxel);
    const float last = this->state[voxel];
    const float least = this->bounds.protect * this->importance[voxel] * original;
    const float range = this->bounds.Most(original) - least;
    const float before = AtMost(Magnitude(last), 0.5f * range);
    const float product = slope * last;
    const float grown = AtMost(growth * before, this->longest);
    const float length = product > 0.0f ? grown : product < 0.0f ? shrinkage * before : before;
    const float taken =
      this->smooths ? AtMost(length, Magnitude(slope) / this->pulls.Weight()) : length;
    const float step = slope > 0.0f ? taken : slope < 0.0f ? -taken : 0.0f;
    this->state[voxel] = slope < 0.0f ? -length : length;
    this->extinction[voxel] = this->bounds.Clamp(now - step, this->importance[voxel], original);
  }
};
}

#endif
