// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Sweeps.h"

#include "../Timing.h"

#include "backend/Backend.h"
#include "energy/NodeImportance.h"
#include "energy/TransmittanceVolume.h"
#include "energy/VisibilityTerm.h"

#include <memory>

namespace limpid::benchmark
{
namespace
{
/// A scene as the sweeps take it.
struct Swept
{
  explicit Swept(const Scene& scene)
    : source(scene)
    , nodeImportance(NodeImportanceOfFilled(
        scene.grid, scene.file.extinction.data(), scene.file.importance.data()))
    , needed(scene.grid, scene.file.extinction.data(), this->nodeImportance.data(), true)
    , everything(scene.grid, scene.file.extinction.data(), this->nodeImportance.data(), false)
    , camera(SourceOfCamera(scene.camera, scene.grid, false))
    , light(SourceOfLight(scene.light, scene.grid))
    , gradient(scene.file.extinction.size())
  {
  }

  const Scene& source;
  std::vector<float> nodeImportance;
  Occupancy needed;
  Occupancy everything;
  RaySource camera;
  RaySource light;
  std::vector<float> gradient; // scratch, one value per node
};

/// Transmittance at voxels as a sweep back to front has it in an iteration. Without importance
/// along the rays and with 1 at the nodes, the derivative of a term is -T.
SampledTransmittance TransmittanceOf(
  Swept& swept, const Truth& truth, const RaySource& eye, double rayDensity)
{
  VisibilityTerm term(swept.source.grid, swept.everything, eye, rayDensity);
  const std::vector<float> none(swept.gradient.size(), 0.0f);
  const std::vector<float> ones(swept.gradient.size(), 1.0f);
  SampledTransmittance sampled;
  for (int which = 0; which < 2; ++which)
  {
    const float* extinction = truth.Extinction(which).data();
    std::fill(swept.gradient.begin(), swept.gradient.end(), 0.0f);
    term.AddGradient(
      { extinction, none.data(), ones.data() }, Derivative::Volume, -1.0f, swept.gradient.data());
    for (const std::size_t voxel : truth.Voxels())
    {
      sampled[std::size_t(which)].push_back(swept.gradient[voxel]);
    }
  }
  return sampled;
}

double SlopeError(Swept& swept, const Truth& truth, VisibilityTerm& camera, Derivative derivative)
{
  const Scene& scene = swept.source;
  const TermFields fields{ scene.file.extinction.data(), scene.file.importance.data(),
    swept.nodeImportance.data() };
  std::fill(swept.gradient.begin(), swept.gradient.end(), 0.0f);
  camera.AddGradient(fields, derivative, -1.0f, swept.gradient.data()); // F_q is -q S
  std::array<double, directionCount> slopes{};
  for (int which = 0; which < directionCount; ++which)
  {
    slopes[std::size_t(which)] = AlongDirection(scene, swept.gradient, Direction(scene, which));
  }
  return truth.ErrorOf(slopes);
}

SweepAccuracy AccuracyAt(Swept& swept, const Truth& truth, double rayDensity)
{
  const Scene& scene = swept.source;
  VisibilityTerm camera(scene.grid, swept.needed, swept.camera, rayDensity);
  const auto score = [&](int which)
  { return camera.Forward(truth.Extinction(which).data(), scene.file.importance.data()).visible; };
  SweepAccuracy accuracy;
  accuracy.rayDensity = rayDensity;
  accuracy.score = truth.ErrorsOf(score(0), score(1));
  accuracy.slope = SlopeError(swept, truth, camera, Derivative::Volume);
  accuracy.raySlope = SlopeError(swept, truth, camera, Derivative::Ray);
  accuracy.transmittance = truth.ErrorsOf(TransmittanceOf(swept, truth, swept.camera, rayDensity),
    TransmittanceOf(swept, truth, swept.light, rayDensity));
  return accuracy;
}

/// A solver whose iterations are timed one by one.
class TimedSolver
{
public:
  TimedSolver(const Scene& scene, const IterationTime& what)
    : What(what)
    , Scenery(scene)
  {
  }

  const IterationTime& Result()
  {
    this->What.seconds = Median(this->Times);
    this->What.timed = static_cast<int>(this->Times.size());
    return this->What;
  }

  /// One more timed iteration, unless enough time is spent.
  void Iterate(double secondsAtMost)
  {
    if (this->Times.size() > 2 && this->Spent > secondsAtMost)
    {
      return;
    }
    const ThreadLimit limit(this->What.threads);
    if (!this->Running || this->Running->Done())
    {
      this->Running = std::make_unique<Solver>(this->Scenery.MakeSolver(this->Wanted()));
      this->Running->Step(1); // knows no light, and warms up
    }
    Stopwatch watch;
    this->Running->Step(1);
    this->Times.push_back(watch.Lap());
    this->Spent += this->Times.back();
  }

  void Stop() { this->Running.reset(); }

private:
  Settings Wanted() const
  {
    Settings settings;
    settings.backend = BackendKind::Cpu;
    settings.solver = this->What.solver;
    settings.rayDensity = this->What.rayDensity;
    settings.skipUnneeded = this->What.skip;
    settings.tolerance = 0;
    settings.iterationsPerLevel = { { 0, 0, 1000 } };
    return settings;
  }

  IterationTime What;
  const Scene& Scenery;
  std::unique_ptr<Solver> Running;
  std::vector<double> Times;
  double Spent = 0;
};
}

std::vector<SweepAccuracy> MeasureSweeps(const Truth& truth, const Effort& effort)
{
  Swept swept(truth.Source());
  std::vector<SweepAccuracy> results;
  for (const double rayDensity : effort.rayDensities)
  {
    results.push_back(AccuracyAt(swept, truth, rayDensity));
  }
  return results;
}

std::vector<ShadowAccuracy> MeasureShadows(const Truth& truth, const Effort& effort)
{
  const Scene& scene = truth.Source();
  const RaySource eyes[2] = { SourceOfCamera(scene.camera, scene.grid, false),
    SourceOfLight(scene.light, scene.grid) };
  std::vector<float> transmittance(scene.file.extinction.size());
  std::vector<ShadowAccuracy> results;
  for (const double rayDensity : effort.rayDensities)
  {
    SampledTransmittance sampled[2];
    std::vector<double> times;
    for (int eye = 0; eye < 2; ++eye)
    {
      for (int which = 0; which < 2; ++which)
      {
        Stopwatch watch;
        FillTransmittance(
          scene.grid, truth.Extinction(which).data(), eyes[eye], rayDensity, transmittance.data());
        times.push_back(watch.Lap());
        for (const std::size_t voxel : truth.Voxels())
        {
          sampled[eye][std::size_t(which)].push_back(transmittance[voxel]);
        }
      }
    }
    const TransmittanceErrors errors = truth.ErrorsOf(sampled[0], sampled[1]);
    results.push_back({ rayDensity, errors, Median(times) });
  }
  return results;
}

std::vector<IterationTime> TimeIterations(const Scene& scene, const Effort& effort)
{
  std::vector<TimedSolver> solvers;
  const int all = ThreadCount();
  for (const SolverKind kind : { SolverKind::Policy, SolverKind::Adam })
  {
    for (const double rayDensity : effort.rayDensities)
    {
      solvers.emplace_back(scene, IterationTime{ kind, rayDensity, true, all, 0, 0 });
    }
    solvers.emplace_back(scene, IterationTime{ kind, 1, false, all, 0, 0 });
    solvers.emplace_back(scene, IterationTime{ kind, 1, true, 1, 0, 0 });
  }
  const int timesPerTurn = 3; // of one solver, while its data is in the caches
  for (int turn = 0; turn < effort.repeats; ++turn)
  {
    for (TimedSolver& solver : solvers)
    {
      for (int n = 0; n < timesPerTurn; ++n)
      {
        solver.Iterate(effort.secondsPerSetting / 4);
      }
      solver.Stop();
    }
  }
  std::vector<IterationTime> results;
  for (TimedSolver& solver : solvers)
  {
    results.push_back(solver.Result());
  }
  return results;
}
}
