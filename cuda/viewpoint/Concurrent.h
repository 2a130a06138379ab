// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_viewpoint_Concurrent_h
#define limpid_viewpoint_Concurrent_h

#include "optimize/Solver.h"
#include "viewpoint/Search.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace limpid
{
/// What tells which way the camera is to go, Section 3.4.
enum class Guide
{
  Proxy,      ///< majorant times importance, whatever hides it: stable
  Extinction, ///< the extinction that has been optimised so far
  Attainable  ///< the ceiling: what an extinction of its own could show from each view at most
};

/// Cameras on one sphere, each with the extinction that is best for it.
struct ConcurrentResult
{
  std::unique_ptr<Solver> solver; ///< at the last camera; null: stopped before the first was done
  Camera camera;                  ///< the last one
  std::vector<Vec3> path;         ///< positions of the cameras that were taken, the first included

  /// Of the optimised extinction at the camera that it began with; not there: the ceiling of that
  /// camera is below what was found, and no run was needed to know it.
  std::optional<Score> startScore;

  /// The highest ceiling of the fraction among all views that were looked from, and how many these
  /// were; 0 for the other guides.
  double highestCeiling = 0;
  Index views = 0;

  /// What was proved, in a sentence; empty for the other guides.
  std::string Proof() const;
};

/**
 * Optimises extinction and viewpoint together: the camera moves on the sphere round its focal
 * point, and a move is kept if the extinction that is then optimised for the new camera lets more
 * be seen. The result is never below that of the first camera.
 *
 * With Guide::Attainable the camera goes where the ceiling is highest, as far as views from all
 * sides and climbs from the best of them tell, and the extinction is optimised once, there.
 *
 * Throws limpid::Error when the scene or the settings cannot be worked with. `progress` as for
 * Solver::Run; when it stops the work, what has been reached is returned.
 */
ConcurrentResult OptimizeConcurrently(const SceneFields& scene, const Camera& camera,
  const Light& light, const Settings& settings, Guide guide, const Progress& progress);
}

#endif
