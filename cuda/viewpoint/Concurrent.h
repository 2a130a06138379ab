// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_viewpoint_Concurrent_h
#define limpid_viewpoint_Concurrent_h

#include "optimize/Solver.h"
#include "viewpoint/Search.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace limpid
{
/// What tells which way the camera is to go, Section 3.4.
enum class Guide
{
  Proxy,     ///< majorant times importance, whatever hides it: stable
  Extinction ///< the extinction that has been optimised so far
};

/// Cameras on one sphere, each with the extinction that is best for it.
struct ConcurrentResult
{
  std::unique_ptr<Solver> solver; ///< at the last camera; null: stopped before the first was done
  Camera camera;                  ///< the last one
  Score startScore;               ///< of the optimised extinction at the camera that it began with
  std::vector<Vec3> path;         ///< positions of the cameras that were taken, the first included
};

/**
 * Optimises extinction and viewpoint together: the camera moves on the sphere round its focal
 * point, and a move is kept if the extinction that is then optimised for the new camera lets more
 * be seen. The result is never below that of the first camera.
 *
 * Throws limpid::Error when the scene or the settings cannot be worked with. `progress` as for
 * Solver::Run; when it stops the work, what has been reached is returned.
 */
ConcurrentResult OptimizeConcurrently(const SceneFields& scene, const Camera& camera,
  const Light& light, const Settings& settings, Guide guide, const Progress& progress);
}

#endif
