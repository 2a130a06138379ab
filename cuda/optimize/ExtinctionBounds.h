// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_ExtinctionBounds_h
#define limpid_optimize_ExtinctionBounds_h

#include "energy/MostExtinction.h"
#include "optimize/Problem.h"

namespace limpid
{
/**
 * The bounds of a voxel's extinction:
 *
 *    pi g mu-bar <= mu <= mu-bar + epsilon (majorant - mu-bar).
 *
 * With pi = 0 and epsilon = 1 this is the constraint of Eq. (25). A larger pi keeps important
 * structures from being removed to show what lies behind them. A smaller epsilon keeps structures
 * from becoming denser than in the data (Documentation/Deviations.md, D16 and D22). The base
 * extinction mu-bar is always allowed.
 */
template <class Real>
struct ExtinctionBounds
{
  Real protect;  ///< pi [0, 1]
  Real emphasis; ///< epsilon [0, 1]
  Real majorant; ///< [1/length]

  /// `importance`: g [0, 1]; `base`: mu-bar of the voxel [1/length].
  LIMPID_HD LIMPID_INLINE Real Clamp(Real wanted, Real importance, Real base) const
  {
    const Real least = this->protect * importance * base;
    const Real atLeast = wanted > least ? wanted : least;
    const Real most = this->Most(base);
    return atLeast < most ? atLeast : most;
  }

  /// Clamp, and 0 at an empty voxel.
  LIMPID_HD LIMPID_INLINE Real Within(Real wanted, Real importance, Real base) const
  {
    const bool empty = !(base > 0) && !(importance > 0);
    return empty ? Real(0) : this->Clamp(wanted, importance, base);
  }

  LIMPID_HD LIMPID_INLINE Real Most(Real base) const
  {
    return MostExtinction<Real>{ this->emphasis, this->majorant }(base);
  }
};

/// Returns the upper bound of the extinction for a ceiling.
inline MostExtinction<float> MostOf(const Problem& problem)
{
  return { static_cast<float>(problem.settings.emphasis), problem.majorant };
}

inline ExtinctionBounds<float> BoundsOf(const Settings& settings, float majorant)
{
  return { static_cast<float>(settings.protectImportance), static_cast<float>(settings.emphasis),
    majorant };
}

inline ExtinctionBounds<float> BoundsOf(const Problem& problem)
{
  return BoundsOf(problem.settings, problem.majorant);
}
}

#endif
