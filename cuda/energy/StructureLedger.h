// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_StructureLedger_h
#define limpid_energy_StructureLedger_h

#include "scene/Grid.h"
#include "scene/RaySource.h"
#include "scene/Structures.h"

#include <memory>
#include <vector>

namespace limpid
{
struct ScenePiece;

/// What a camera sees of a structure, as shares of what the data have of it: the integral of its
/// membership times the base extinction. Visible, removed and hidden add up to 1.
struct StructureShares
{
  double important = 0;   ///< that integral; 0: the structure has nothing to see [length^2]
  double visible = 0;     ///< as Score::fraction [0, 1]
  double baseVisible = 0; ///< through the base extinction [0, 1]
  double removed = 0;     ///< as Score::sacrificed [0, 1]
  double attainable = 0; ///< ceiling of `visible` from this camera, whatever else is removed [0, 1]

  /// Share that is hidden by each structure, by its row; 0: by anything else. What is lost at a
  /// point is divided by their optical depths in front of it. Empty for more structures than
  /// mostHiders.
  std::vector<double> hiddenBy;
};

constexpr std::size_t mostHiders = 256;

/**
 * The rays of a camera that count what it sees of each structure (Documentation/Method.md, section
 * on structures). They have the samples of a score, so that shares of structures, weighted by
 * their importance, add up to that score but for rounding. All sums are exact: results do not
 * depend on the numbers of threads and processes.
 */
class StructureLedger
{
public:
  /// How a camera is scored.
  struct Sampling
  {
    double rayDensity = 1; ///< see PlanSettings
    bool fine = false;     ///< see VisibilityTerm
  };

  /// Fields have the values of the nodes of a piece, which the caller keeps. `rows`: row of the
  /// structure of each node; `base`: base extinction [1/length]. Collective, like all members.
  StructureLedger(const Grid& grid, std::shared_ptr<const ScenePiece> piece,
    const Structures& structures, const StructureRow* rows, const float* base);
  ~StructureLedger();

  /// Returns the shares of all structures, in the order of their rows. `extinction`: see the
  /// constructor; `least`: lower bound of the extinction, of which a ceiling has that of its own
  /// structure; null, on all processes, stands for 0 [1/length].
  std::vector<StructureShares> SharesFrom(const RaySource& camera, const Sampling& sampling,
    const float* extinction, const float* least) const;

private:
  struct Internals;
  std::unique_ptr<Internals> State;
};
}

#endif
