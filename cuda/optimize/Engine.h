// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_Engine_h
#define limpid_optimize_Engine_h

#include "energy/VisibilityTerm.h"
#include "optimize/Problem.h"

#include <memory>
#include <string>
#include <vector>

namespace limpid
{
/// What runs the iterations: the processor or a GPU.
class Engine
{
public:
  virtual ~Engine() = default;

  /// A method for a problem, which stays with the caller, from a first iterate [1/length]. `warm`
  /// tells that it is near the optimum.
  virtual std::unique_ptr<Minimizer> MakeMinimizer(
    const Problem& problem, std::vector<float>&& start, bool warm) = 0;

  /// What the camera of a problem sees of an extinction, grid.NodeCount() values [1/length].
  virtual Visible Score(const Problem& problem, const float* extinction) = 0;
};

std::shared_ptr<Engine> CpuEngine();

/// Throws limpid::Error if there is none.
std::shared_ptr<Engine> CudaEngine();

/// Bytes that an optimisation on the GPU needs, about.
std::size_t CudaBytes(const Grid& grid, const Settings& settings);
}

#endif
