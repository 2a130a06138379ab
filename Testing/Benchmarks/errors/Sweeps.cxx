// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Errors.h"

#include "backend/Backend.h"
#include "energy/NodeImportance.h"
#include "energy/ScoreKernel.h"
#include "energy/TransmittanceSweep.h"
#include "energy/VisibilityTerm.h"
#include "optimize/PolicyKernel.h"
#include "sweep/Sweeps.h"

#include <numeric>

namespace limpid::benchmark
{
namespace
{
/// A scene as the sweeps take it.
struct Swept
{
  explicit Swept(const SceneOfFile& scene)
    : source(scene)
    , nodeImportance(
        NodeImportanceOfFilled(scene.grid, scene.extinction.data(), scene.importance.data()))
    , needed(scene.grid, scene.extinction.data(), this->nodeImportance.data(), true)
    , everything(scene.grid, scene.extinction.data(), this->nodeImportance.data(), false)
    , camera(SourceOfCamera(scene.camera, scene.grid, false))
    , light(SourceOfLight(scene.light, scene.grid))
    , gradient(scene.extinction.size())
  {
  }

  const SceneOfFile& source;
  std::vector<float> nodeImportance;
  Occupancy needed;
  Occupancy everything;
  RaySource camera;
  RaySource light;
  std::vector<float> gradient; // scratch, one value per node
};

/// Transmittance at voxels as a policy sweep has it. Without importance along the rays and with 1
/// at the nodes, the next iterate of an empty volume is T, for a gain and a majorant of 1.
SampledTransmittance TransmittanceOf(
  Swept& swept, const Truth& truth, const RaySource& source, double rayDensity)
{
  const auto device = HostDevice::Shared();
  std::vector<FrustumRays<HostDevice>> frusta = PlanRays(device, swept.source.grid,
    swept.everything, source, { rayDensity, RayPlacement::ForIntegrals });
  const std::vector<float> zeros(swept.gradient.size(), 0.0f);
  const std::vector<float> ones(swept.gradient.size(), 1.0f);
  PolicyKernel<const float*, float*> kernel{};
  kernel.base = kernel.importance = zeros.data();
  kernel.nodeImportance = ones.data();
  kernel.next = swept.gradient.data();
  kernel.policy = { 1, 1, {}, { 0, 1, 1 } };
  kernel.transmittance = Transmittance::OfLastIterate;
  kernel.areaWeighted = true;
  kernel.kept = Kept::Ignored;
  SampledTransmittance sampled;
  for (int which = 0; which < 2; ++which)
  {
    kernel.last = truth.Extinction(which).data();
    for (FrustumRays<HostDevice>& rays : frusta)
    {
      SweepForward(*device, rays, swept.everything, DepthKernel<const float*>{ kernel.last });
      SweepBackwardByPhases(
        *device, rays, swept.everything, kernel, [](const VoxelRow&, const auto&, int) {});
    }
    sampled[std::size_t(which)] = truth.AtVoxels(swept.gradient);
  }
  return sampled;
}

double SlopeError(
  Swept& swept, const Truth& truth, VisibilityTerm<HostDevice>& camera, Derivative derivative)
{
  const SceneOfFile& scene = swept.source;
  const TermFields fields{ scene.extinction.data(), scene.importance.data(),
    swept.nodeImportance.data() };
  std::fill(swept.gradient.begin(), swept.gradient.end(), 0.0f);
  Seen seen;
  camera.Differentiate( // F_q is -q S
    fields, derivative, { 1.0f, -1.0f }, swept.gradient.data(), &seen);
  return truth.SlopeError(swept.gradient);
}

Json AccuracyAt(Swept& swept, const Truth& truth, double rayDensity)
{
  const SceneOfFile& scene = swept.source;
  VisibilityTerm<HostDevice> camera(
    HostDevice::Shared(), scene.grid, swept.needed, swept.camera, rayDensity);
  const auto score = [&](int which)
  {
    Seen seen;
    camera.Forward({ truth.Extinction(which).data(), scene.importance.data() }, &seen);
    return seen.all.visible;
  };
  Json accuracy{ { "ray_density", rayDensity } };
  const double base = score(0);
  truth.AddErrors(accuracy, base, score(1));
  accuracy["error_slope"] = SlopeError(swept, truth, camera, Derivative::Volume);
  accuracy["error_slope_ray"] = SlopeError(swept, truth, camera, Derivative::Ray);
  truth.AddErrors(accuracy, TransmittanceOf(swept, truth, swept.camera, rayDensity),
    TransmittanceOf(swept, truth, swept.light, rayDensity));
  return accuracy;
}

/// A solver whose iterations are timed, several in a row.
struct TimedSolver
{
  Settings settings;
  int threads;
  std::vector<double> times;

  void Iterate(const SceneOfFile& scene, double secondsAtMost)
  {
    const ThreadLimit limit(this->threads);
    Solver solver = scene.MakeSolver(this->settings);
    solver.Step(1);             // knows no light, and warms up
    const int timesPerTurn = 3; // while its data is in the caches
    for (int n = 0; n < timesPerTurn; ++n)
    {
      const double spent = std::accumulate(this->times.begin(), this->times.end(), 0.0);
      if (this->times.size() <= 2 || spent <= secondsAtMost)
      {
        Stopwatch watch;
        solver.Step(1);
        this->times.push_back(watch.Lap());
      }
    }
  }
};
}

Json MeasureSweeps(const Truth& truth, const Effort& effort)
{
  Swept swept(truth.Source());
  Json results;
  for (const double rayDensity : effort.rayDensities)
  {
    results.push_back(AccuracyAt(swept, truth, rayDensity));
  }
  return results;
}

Json MeasureShadows(const Truth& truth, const Effort& effort)
{
  const SceneOfFile& scene = truth.Source();
  const RaySource sources[2] = { SourceOfCamera(scene.camera, scene.grid, false),
    SourceOfLight(scene.light, scene.grid) };
  std::vector<float> transmittance(scene.extinction.size());
  Json results;
  for (const double rayDensity : effort.rayDensities)
  {
    SampledTransmittance sampled[2];
    std::vector<double> times;
    for (int i = 0; i < 2; ++i)
    {
      for (int which = 0; which < 2; ++which)
      {
        Stopwatch watch;
        FillTransmittance(
          scene.grid, truth.Extinction(which).data(), sources[i], rayDensity, transmittance.data());
        times.push_back(watch.Lap());
        sampled[i][std::size_t(which)] = truth.AtVoxels(transmittance);
      }
    }
    Json result{ { "ray_density", rayDensity }, { "seconds", Median(times) } };
    truth.AddErrors(result, sampled[0], sampled[1]);
    results.push_back(result);
  }
  return results;
}

Json TimeIterations(const SceneOfFile& scene, const Effort& effort)
{
  std::vector<TimedSolver> solvers;
  const int all = ThreadCount();
  for (const SolverKind kind : { SolverKind::Policy, SolverKind::Adam })
  {
    Settings settings;
    settings.solver = kind;
    settings.backend = BackendKind::Cpu;
    settings.tolerance = 0;
    settings.iterationsPerLevel = { { 0, 0, 1000 } };
    for (const double rayDensity : effort.rayDensities)
    {
      settings.rayDensity = rayDensity;
      solvers.push_back({ settings, all, {} });
    }
    settings.rayDensity = 1;
    solvers.push_back({ settings, 1, {} });
    settings.skipUnneeded = false;
    solvers.insert(solvers.end() - 1, { settings, all, {} });
  }
  for (int turn = 0; turn < effort.repeats; ++turn)
  {
    for (TimedSolver& solver : solvers)
    {
      solver.Iterate(scene, effort.secondsPerSetting / 4);
    }
  }
  Json results;
  for (const auto& [settings, threads, times] : solvers)
  {
    results.push_back({ { "solver", settings.solver == SolverKind::Policy ? "policy" : "Adam" },
      { "ray_density", settings.rayDensity }, { "skip", settings.skipUnneeded },
      { "threads", threads }, { "seconds", Median(times) }, { "timed", times.size() } });
  }
  return results;
}
}
