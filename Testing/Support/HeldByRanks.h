// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What memory ranks have for the fields of a problem that they share.

#ifndef limpid_testing_HeldByRanks_h
#define limpid_testing_HeldByRanks_h

#include "ThreadRanks.h"

#include "optimize/FieldDistribution.h"
#include "optimize/Permuted.h"

#include <algorithm>
#include <mutex>
#include <vector>

namespace limpid
{
/// A problem in the order of axes in which it is swept.
struct ProblemInOrder
{
  Problem problem;
  Occupancy occupancy;

  explicit ProblemInOrder(const Problem& given)
    : problem(Reordered(given, OrderFor(given)))
    , occupancy(OccupancyOf(given))
  {
  }

private:
  static Occupancy OccupancyOf(const Problem& given)
  {
    const AxisPermutation order = OrderFor(given);
    std::vector<float> base(std::size_t(given.grid.NodeCount()));
    std::vector<float> importance(base.size());
    Permute(given.grid, order, given.baseExtinction, base.data());
    Permute(given.grid, order, given.nodeImportance, importance.data());
    return { order.Of(given.grid), base.data(), importance.data(), given.settings.skipUnneeded };
  }
};

/// Nodes of a field that the rank has memory for that has most.
inline Index MostNodesHeld(const ProblemInOrder& scene, int ranks)
{
  const Problem& problem = scene.problem;
  Index most = 0;
  std::mutex access;
  ThreadRanks::Run(ranks,
    [&](const std::shared_ptr<const Communicator>& all)
    {
      const auto raysOf = [&](const RaySource& source)
      {
        return PlanRays(HostDevice::Shared(), problem.grid, scene.occupancy, source,
          { problem.settings.rayDensity });
      };
      FieldDistribution::Frusta camera = raysOf(problem.Camera());
      FieldDistribution::Frusta light = raysOf(problem.Light());
      const FieldDistribution terms(*all, problem.grid.nodes,
        { { &camera, &problem.Camera() }, { &light, &problem.Light() } }, scene.occupancy, false,
        FieldPlaces::Chosen);
      const std::lock_guard<std::mutex> lock(access);
      most = std::max(most, terms.NodesHeld());
    });
  return most;
}
}

#endif
