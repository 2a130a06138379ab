// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/ComputeBackend.h"
#include "optimize/DistributedBackend.h"
#include "optimize/PreparedScene.h"

#include <algorithm>
#include <utility>

namespace limpid
{
namespace
{
/// Estimates the GPU memory that an optimisation needs.
GpuNeed NeedOf(const Grid& grid, const Settings& settings)
{
  // Fields: base, importance, node importance. Policy: three iterates, the light's derivative, and
  // in thick media the derivative and the step lengths. Adam: extinction, best iterate, derivative
  // and its two means.
  const double fields = settings.solver == SolverKind::Policy ? 9 : 8;
  const double nodes = double(grid.NodeCount());
  // Rays of the light and all cameras, their images on a few slices, and the plans.
  const double across =
    settings.rayDensity * std::max({ grid.nodes.x, grid.nodes.y, grid.nodes.z });
  const double sources = 2.0 + double(settings.otherCameras.size());
  const double rays = 2 * sources * across * across;
  return { grid.NodeCount(), static_cast<std::size_t>(4 * fields * nodes + 300 * rays + 64e6) };
}
}

void ChosenBackend::Choose(const Settings& wanted, const PreparedScene& scene)
{
  const Settings settings = AdaptedTo(scene, wanted);
  this->GpuFailed = this->GpuFailed && settings.backend == this->Wish;
  this->Wish = settings.backend;
  if (this->GpuFailed || (this->Solvers && this->OnGpu && settings.backend != BackendKind::Cpu))
  {
    return;
  }
  const BackendChoice choice = ChooseBackend(settings.backend, NeedOf(scene.Nodes(), settings));
  this->Solvers = BackendFor(scene, BackendOf(choice.cuda).MakeSolverBackend());
  this->Line = this->Solvers->Describe(choice.name);
  this->OnGpu = choice.cuda;
}

bool ChosenBackend::GiveUpGpu(const std::string& reason)
{
  if (!this->OnGpu || this->Wish != BackendKind::Auto)
  {
    return false;
  }
  this->Solvers = ProcessorBackend().MakeSolverBackend();
  this->Line = CpuWithoutCuda(reason);
  this->OnGpu = false;
  this->GpuFailed = true;
  return true;
}
}
