// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Ranked_h
#define limpid_optimize_Ranked_h

#include "optimize/Problem.h"

#include <functional>

namespace limpid
{
class SourceSweeps;

/// Throws JointError on all ranks unless they have the same view and settings: what they exchange
/// follows from these.
void RequireAlike(const Communicator& ranks, const Grid& grid, const Camera& camera,
  const Light& light, const Settings& settings, double nearness);

/// Transmittance from a source through an extinction of this rank's piece, see TransmittanceSweep,
/// into another array of it. `grid`: of all pieces.
void FindTransmittanceOnRanks(const Grid& grid, const ScenePiece& piece, const RaySource& source,
  double rayDensity, const float* extinction, float* transmittance);

/// RefineTransmittance in place, of fields of this rank's piece: with the bits that one rank finds.
void RefineTransmittanceOnRanks(const Grid& grid, const ScenePiece& piece, const RaySource& source,
  const float* extinction, float* transmittance);

/// The rays of a source through the scene of ranks, for scores.
std::unique_ptr<SourceSweeps> SweepsFromOnRanks(const Problem& problem, const RaySource& source);

/// A minimiser of a problem whose scene is shared by ranks (Problem::piece). It works in the order
/// of OrderFor, and its results are those of this rank's piece, in the problem's order. `start`: of
/// that piece, on all ranks or none. `make`: makes one of a problem with FieldsOfRanks, which stays
/// alive.
std::unique_ptr<Minimizer> MakeRanked(const Problem& problem, const StartingExtinction& start,
  const std::function<std::unique_ptr<Minimizer>(const Problem&, StartingExtinction&&)>& make);
}

#endif
