// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Ranked_h
#define limpid_optimize_Ranked_h

#include "optimize/Problem.h"
#include "scene/NodeValues.h"
#include "sweep/RankRegions.h"

#include <functional>

namespace limpid
{
class SourceSweeps;

/// The fields of a problem that ranks share, where they come from and where they are: arrays of all
/// nodes that have values where TermsOnRanks brings them.
struct FieldsOfRanks
{
  std::shared_ptr<const Communicator> ranks;
  std::vector<Region> pieces; ///< the nodes whose values ranks have at first
  std::vector<Region> wanted; ///< those whose results they get

  /// A field's values in this rank's piece, and an array for what this rank needs.
  struct Field
  {
    FieldView piece;
    NodeValues values;
  };
  Field base;           ///< [1/length]
  Field importance;     ///< [0, 1]
  Field nodeImportance; ///< [0, 1]
};

/// Throws JointError on all ranks unless they have the same view and settings: what they exchange
/// follows from these.
void RequireAlike(const Communicator& ranks, const Grid& grid, const Camera& camera,
  const Light& light, const Settings& settings);

/// Transmittance from a source through an extinction of this rank's piece, see TransmittanceSweep,
/// into another array of it.
void FindTransmittanceOnRanks(const Problem& problem, const RaySource& source, double rayDensity,
  const float* extinction, float* transmittance);

/// The rays of a source through the scene of ranks, for scores.
std::unique_ptr<SourceSweeps> SweepsFromOnRanks(const Problem& problem, const RaySource& source);

/// A minimiser of a problem whose scene is shared by ranks (Problem::piece). It works in the order
/// of OrderFor, and its results are those of this rank's piece, in the problem's order. `make`:
/// makes one of a problem with FieldsOfRanks, which stays alive.
std::unique_ptr<Minimizer> MakeRanked(
  const Problem& problem, const std::function<std::unique_ptr<Minimizer>(const Problem&)>& make);
}

#endif
