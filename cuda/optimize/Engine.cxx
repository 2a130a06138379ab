// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Engine.h"

#include "optimize/Adam.h"
#include "optimize/Policy.h"

#include <algorithm>
#include <cmath>

namespace limpid
{
namespace
{
class ProcessorEngine : public Engine
{
public:
  std::unique_ptr<Minimizer> MakeMinimizer(
    const Problem& problem, std::vector<float>&& start, bool warm) override
  {
    return problem.settings.solver == SolverKind::Adam
      ? MakeAdam(problem, std::move(start))
      : MakePolicy(problem, std::move(start), warm);
  }

  Visible Score(const Problem& problem, const float* extinction) override
  {
    VisibilityTerm term(
      problem.grid, *problem.occupancy, problem.camera, problem.settings.rayDensity);
    return term.Forward(extinction, problem.importance);
  }
};
}

std::shared_ptr<Engine> CpuEngine()
{
  return std::make_shared<ProcessorEngine>();
}

std::size_t CudaBytes(const Grid& grid, const Settings& settings)
{
  // Fields: base, importance and that of nodes; policy: three iterates and the light's derivative;
  // Adam: extinction, last, best, derivative and its two means.
  const double fields = settings.solver == SolverKind::Policy ? 7 : 9;
  const double nodes = double(grid.NodeCount());
  // Rays of two eyes, with images of them on a slab of slices.
  const double across =
    settings.rayDensity * std::max({ grid.nodes.x, grid.nodes.y, grid.nodes.z });
  const double rays = 4 * across * across;
  return static_cast<std::size_t>(4 * fields * nodes + 300 * rays + 64e6);
}
}
