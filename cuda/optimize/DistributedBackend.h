// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_DistributedBackend_h
#define limpid_optimize_DistributedBackend_h

#include "distributed/ScenePiece.h"
#include "optimize/SolverBackend.h"

#include <memory>

namespace limpid
{
/// Throws JointError on all ranks unless all have the same view and settings, which determine what
/// they exchange.
void RequireAlike(const Communicator& ranks, const Grid& grid, const Camera& camera,
  const Light& light, const Settings& settings, double nearness);

/**
 * Makes the backend of a scene that ranks share. Fields of its problems, starting extinctions and
 * results are those of this rank's subdomain. Its minimisers are those of `processor` for the
 * problem in the order of OrderFor, with DistributedFields. It has no previews and no methods
 * without iterations.
 */
std::unique_ptr<SolverBackend> MakeDistributedBackend(
  std::unique_ptr<SolverBackend> processor, std::shared_ptr<const ScenePiece> piece);
}

#endif
