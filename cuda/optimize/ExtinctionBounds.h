// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_ExtinctionBounds_h
#define limpid_optimize_ExtinctionBounds_h

#include "optimize/Problem.h"

namespace limpid
{
/**
 * What the extinction of a voxel may be:
 *
 *   pi g mu-bar <= mu <= majorant.
 *
 * The majorant is the constraint of Eq. (25). The lower bound keeps important matter from being
 * removed to show what lies behind it (Documentation/Deviations.md, D16); with pi = 0 it is
 * that of Eq. (25), too. It never exceeds the base extinction mu-bar, which is always allowed.
 */
template <class Real>
struct ExtinctionBounds
{
  Real protect;  ///< pi [0, 1]
  Real majorant; ///< [1/length]

  /// `importance` g [0, 1] and `base` mu-bar [1/length] of the voxel.
  LIMPID_HD LIMPID_INLINE Real Clamp(Real wanted, Real importance, Real base) const
  {
    const Real least = this->protect * importance * base;
    const Real atLeast = wanted > least ? wanted : least;
    return atLeast < this->majorant ? atLeast : this->majorant;
  }
};

inline ExtinctionBounds<float> BoundsOf(const Problem& problem)
{
  return { static_cast<float>(problem.settings.protectImportance), problem.majorant };
}
}

#endif
