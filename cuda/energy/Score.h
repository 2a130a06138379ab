// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_Score_h
#define limpid_energy_Score_h

#include "sweep/SumRays.h"

#include <algorithm>
#include <vector>

namespace limpid
{
/**
 * What a camera sees of importance g through an extinction mu.
 *
 * The fractions are shares of the important matter that the data has, the integral of g mu-bar with
 * the base extinction mu-bar. What was removed counts as not seen; what is thicker than the base
 * attenuates, but does not show the same matter twice (Documentation/Method.md, section on what is
 * visible).
 */
struct Score
{
  double visibility = 0; ///< S of Eq. (32) [length^2]
  double fraction = 0;   ///< whose light reaches the eye: integral of g min(mu, mu-bar) T [0, 1]
  double sacrificed = 0; ///< that was removed: 1 less the integral of g min(mu, mu-bar) [0, 1]
  double important = 0;  ///< what the fractions are of, the integral of g mu-bar [length^2]
};

/**
 * What no extinction within its bounds can exceed (Documentation/Method.md, section on the
 * ceiling): as if every ray of the camera, and every ray of the light, had an extinction of its
 * own.
 */
struct Ceiling
{
  double visibility = 0;      ///< of Score::visibility [length^2]
  double fraction = 0;        ///< of Score::fraction [0, 1]
  double lightVisibility = 0; ///< of Score::visibility as seen from the light [length^2]
};

/// `most`: what a source sees at most; `kept`: whether Seen::kept was counted. Without the light.
inline Ceiling CeilingOf(const Seen& most, Kept kept)
{
  const Visible& fraction = kept == Kept::Counted ? most.kept : most.all;
  const double important = most.all.unattenuated;
  return { most.all.visible, important > 0 ? std::min(fraction.visible / important, 1.0) : 0.0, 0 };
}

/// The mean of what several cameras see at most; there is one at least.
inline Ceiling MeanOf(const std::vector<Ceiling>& ceilings)
{
  Ceiling mean;
  for (const Ceiling& ceiling : ceilings)
  {
    mean.visibility += ceiling.visibility;
    mean.fraction += ceiling.fraction;
  }
  const auto count = static_cast<double>(ceilings.size());
  return { mean.visibility / count, mean.fraction / count, 0 };
}

/// `important`: the integral of g mu-bar [length^2]; 0: there is nothing to be seen.
inline Score ScoreOf(const Seen& seen, double important)
{
  Score score;
  score.visibility = seen.all.visible;
  score.important = important;
  if (important > 0)
  {
    // Of thin media these differ by rounding only.
    score.fraction = std::min(seen.kept.visible / important, 1.0);
    score.sacrificed = std::clamp(1 - seen.kept.unattenuated / important, 0.0, 1.0);
  }
  return score;
}

/// The mean of what several cameras see; there is one at least.
inline Score MeanOf(const std::vector<Score>& scores)
{
  Score mean;
  for (const Score& score : scores)
  {
    mean.visibility += score.visibility;
    mean.fraction += score.fraction;
    mean.sacrificed += score.sacrificed;
    mean.important += score.important;
  }
  const auto count = static_cast<double>(scores.size());
  return { mean.visibility / count, mean.fraction / count, mean.sacrificed / count,
    mean.important / count };
}

/// Of the important matter of `all`, the share that is in front of opaque geometry, of which
/// `inFront` is a score.
inline double ShareInFront(const Score& inFront, const Score& all)
{
  return all.important > 0 ? inFront.important / all.important : 0.0;
}

/// What is seen in front of opaque geometry, as shares of all that the data have.
inline Score OfAll(const Score& inFront, const Score& all)
{
  return { inFront.visibility, inFront.fraction * ShareInFront(inFront, all), all.sacrificed,
    all.important };
}

/// Of the base extinction itself.
inline Score ScoreOfBase(const Visible& base)
{
  return ScoreOf({ base, base }, base.unattenuated);
}
}

#endif
