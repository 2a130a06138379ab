// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "optimize/Engine.h"

#include "energy/TransmittanceVolume.h"
#include "optimize/Adam.h"
#include "optimize/Permuted.h"
#include "optimize/Policy.h"
#include "optimize/PolicySweep.h"
#include "scene/LargePages.h"

#include <algorithm>

namespace limpid
{
namespace
{
class ProcessorSweeps : public EyeSweeps
{
public:
  ProcessorSweeps(const Problem& problem, const RaySource& eye)
    : Task(problem)
    , Term(problem.grid, *problem.occupancy, eye, problem.settings.rayDensity)
  {
  }

  Visible Score(const float* extinction) override
  {
    return this->Term.Forward(extinction, this->Task.importance);
  }

  void Pass(double weight, std::vector<float>& found) override
  {
    PolicyTask task = TaskOf(this->Task, weight, 0.0);
    task.fields.extinction = this->Task.baseExtinction; // not read
    task.fields.next = found.data();
    task.trust = Trust::Clear;
    for (std::size_t index = 0; index < this->Term.FrustumCount(); ++index)
    {
      SweepPolicy(this->Term.FrustumAt(index), task, this->Term.ImagesAt(index));
    }
  }

private:
  const Problem& Task;
  VisibilityTerm Term;
};

class ProcessorEngine : public Engine
{
public:
  std::unique_ptr<Minimizer> MakeMinimizer(
    const Problem& problem, std::vector<float>&& start, bool warm) override
  {
    return MakePermuted(problem, std::move(start),
      [warm](const Problem& task, std::vector<float>&& first)
      {
        if (task.settings.solver == SolverKind::Policy)
        {
          return MakePolicy(task, std::move(first), warm);
        }
        StartFromBase(task, first);
        return MakeAdam(task, std::move(first));
      });
  }

  std::unique_ptr<EyeSweeps> Look(const Problem& problem, const RaySource& eye) override
  {
    return std::make_unique<ProcessorSweeps>(problem, eye);
  }

  void Transmittance(const Problem& problem, const RaySource& eye, double rayDensity,
    const float* extinction, float* transmittance) override
  {
    FillTransmittance(problem.grid, extinction, eye, rayDensity, transmittance);
  }
};
}

std::shared_ptr<Engine> CpuEngine()
{
  return std::make_shared<ProcessorEngine>();
}

void EngineChoice::Choose(const Settings& settings, const Grid& grid)
{
  if (this->Chosen && this->OnGpu && settings.backend != BackendKind::Cpu)
  {
    return;
  }
  const BackendChoice choice = ChooseBackend(settings.backend, CudaBytes(grid, settings));
  this->Chosen = choice.cuda ? CudaEngine() : CpuEngine();
  this->Line = choice.name;
  this->OnGpu = choice.cuda;
}

void StartFromBase(const Problem& problem, std::vector<float>& start)
{
  if (start.empty())
  {
    start = RoomFor(problem.grid.NodeCount());
    start.assign(problem.baseExtinction, problem.baseExtinction + problem.grid.NodeCount());
  }
}

std::size_t CudaBytes(const Grid& grid, const Settings& settings)
{
  // Fields: base, importance and that of nodes; policy: three iterates and the light's derivative;
  // Adam: extinction, best, derivative and its two means.
  const double fields = settings.solver == SolverKind::Policy ? 7 : 8;
  const double nodes = double(grid.NodeCount());
  // Rays of two eyes, with images of them on a slab of slices.
  const double across =
    settings.rayDensity * std::max({ grid.nodes.x, grid.nodes.y, grid.nodes.z });
  const double rays = 4 * across * across;
  return static_cast<std::size_t>(4 * fields * nodes + 300 * rays + 64e6);
}
}
