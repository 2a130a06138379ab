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
/// The quantity that guides the movement of the camera, Section 3.4.
enum class Guide
{
  Proxy,      ///< majorant times importance, ignoring occlusion: stable
  Extinction, ///< the extinction optimised so far
  Attainable  ///< the ceiling: the most that any extinction could show from each view
};

/// The result of a concurrent optimisation on a sphere of cameras.
struct ConcurrentResult
{
  std::unique_ptr<Solver> solver; ///< at the last camera; null if stopped before that of the first
  Camera camera;                  ///< the last one
  std::vector<Vec3> path;         ///< positions of all accepted cameras, starting with the first

  /// Score of the optimised extinction at the first camera. Empty if the ceiling of that camera is
  /// below the result, so that no run was needed.
  std::optional<Score> startScore;

  /// The highest ceiling of the fraction among all evaluated views, and their number; 0 for other
  /// guides.
  double highestCeiling = 0;
  Index views = 0;

  /// One sentence on what was proved; empty for other guides.
  std::string Proof() const;
};

/**
 * Optimises extinction and viewpoint together. The camera moves on the sphere around its focal
 * point, and a move is accepted if the extinction optimised for the new camera shows more. The
 * result is never worse than that of the first camera.
 *
 * With Guide::Attainable the camera goes to the highest ceiling found by sampling views from all
 * sides and climbing from the best of them. The extinction is optimised once, there.
 *
 * Throws limpid::Error if the scene or the settings are invalid. `progress` is used as in
 * Solver::Run; if it stops the work, the result so far is returned.
 */
ConcurrentResult OptimizeConcurrently(const SceneFields& scene, const Camera& camera,
  const Light& light, const Settings& settings, Guide guide, const Progress& progress);
}

#endif
