// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_DistributedMinimizer_h
#define limpid_optimize_DistributedMinimizer_h

#include "optimize/Problem.h"

#include <functional>

namespace limpid
{
class SourceSweeps;

/// Throws JointError on all ranks unless all have the same view and settings, which determine what
/// they exchange.
void RequireAlike(const Communicator& ranks, const Grid& grid, const Camera& camera,
  const Light& light, const Settings& settings, double nearness);

/// Computes the transmittance from a source through an extinction of this rank's subdomain, see
/// TransmittanceSweep. `grid`: of the whole scene.
void FindTransmittanceOnRanks(const Grid& grid, const ScenePiece& piece, const RaySource& source,
  double rayDensity, const float* extinction, float* transmittance);

/// Applies RefineTransmittance in place to this rank's subdomain; bit-identical to one process.
void RefineTransmittanceOnRanks(const Grid& grid, const ScenePiece& piece, const RaySource& source,
  const float* extinction, float* transmittance);

/// Makes the rays of a source through a distributed scene, for scores.
std::unique_ptr<SourceSweeps> SweepsFromOnRanks(const Problem& problem, const RaySource& source);

/// Makes a minimiser of a distributed problem (Problem::piece). It works in the order of OrderFor;
/// its results are those of this rank's subdomain, in the problem's order. `start`: of that
/// subdomain, on all ranks or none. `make`: makes a minimiser of a problem with DistributedFields,
/// which outlives it.
std::unique_ptr<Minimizer> MakeDistributed(const Problem& problem, const StartingExtinction& start,
  const std::function<std::unique_ptr<Minimizer>(const Problem&, StartingExtinction&&)>& make);
}

#endif
