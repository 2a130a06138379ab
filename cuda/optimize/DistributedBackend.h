// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_DistributedBackend_h
#define limpid_optimize_DistributedBackend_h

#include "optimize/PreparedScene.h"
#include "optimize/SolverBackend.h"

#include <memory>
#include <string>

namespace limpid
{
/// Returns the first setting that is not supported in distributed runs, such as "the method
/// Viola2004"; empty if all are.
std::string NotOnRanks(const Settings& settings);

/// Returns settings adapted to a scene: distributed runs use processors. Throws limpid::Error if
/// settings are not supported for it.
Settings AdaptedTo(const PreparedScene& scene, Settings settings);

/// Throws JointError in all processes that share a scene unless all have the same view and
/// settings, which determine what they exchange.
void RequireAlike(const PreparedScene& scene, const Camera& camera, const Light& light,
  const Settings& settings, double nearness);

/**
 * Returns the backend for a scene: `here` if this process has all of it. Otherwise, fields of its
 * problems, starting extinctions and results are those of this process's subdomain. Its minimisers
 * are those of `here` for the problem in the order of OrderFor, with DistributedFields. It has no
 * previews and no methods without iterations.
 */
std::unique_ptr<SolverBackend> BackendFor(
  const PreparedScene& scene, std::unique_ptr<SolverBackend> here);
}

#endif
